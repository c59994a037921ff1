/* Handlebody: the C interface of the solver.
 *
 * This header is the whole contract between the solver and its callers: TypeScript's declarations, the offsets of the structs and the
 * export lists of both wasm files are made from it (scripts/generate.mjs, CMakeLists.txt), so keep one function per line. HB_API marks what
 * both files export; HB_WHOLE_API marks what handlebody.wasm alone exports: baking, tetrahedra, skinning weights and minimized energies.
 * handlebody.runtime.wasm moves and evaluates what they made.
 *
 * Conventions
 *   - Every function that can fail returns an hb_status; hb_last_error() then has the details. On failure out-parameters
 *     are untouched and the object is as it was: the last good solution stays readable.
 *   - Objects are opaque. The caller frees what a *_create or *_begin function returned by the matching *_free; NULL is allowed.
 *   - Arrays are row-major and tightly packed. Input arrays are copied; pointers that a function returns belong to the object and
 *     are valid until its next non-const call.
 *   - Counts are what they are, unsigned, and so are their products: an array of 4 GiB or more, or of 2³¹ numbers, is INVALID_SHAPE (or
 *     MESH_TOO_LARGE) before anything of it is read, as is NULL for one that is not empty. Whether an array has as many numbers as its
 *     count says, only the caller knows.
 *   - While a host's kernel runs, it may call functions of other objects, and no function of the object that asked for it.
 *   - Doubles for solving, floats for each frame. Lengths are in the model's own units, or where so stated in "solver space": the
 *     model scaled to a unit bounding-box diagonal and centered on its box.
 *   - Nothing here is thread-safe; use one instance per thread.
 */
#ifndef HANDLEBODY_H
#define HANDLEBODY_H

#include <stdint.h>

#include "core/errors/status.h"

#define HB_API
#define HB_WHOLE_API

#ifdef __cplusplus
extern "C" {
#endif

/* ---- errors and memory ------------------------------------------------------------------------------------------------- */

/* The last failure. `index` is the number of the culprit (a vertex, a handle, an example …) or -1. UTF-8, NUL-terminated. */
typedef struct hb_error {
  int32_t code;
  int32_t culprit;
  int32_t index;
  char message[320];
  char remedy[320];
} hb_error;

/* Version of this interface; a loader refuses a binary with another. */
HB_API uint32_t hb_abi_version(void);

/* The last failure of this instance; valid for ever, overwritten by the next failure. */
HB_API const hb_error* hb_last_error(void);

/* `bytes` of 16-byte aligned memory, or NULL when there is none; never traps. */
HB_API void* hb_alloc(uint32_t bytes);
HB_API void hb_release(void* memory);

/* Marks where a call of any of the functions below begins: all that is made or changed until the next mark belongs to it. */
HB_API void hb_begin_call(void);

/* After a trap: if memory ran out, gives back what the call made and returns the bytes that could not be had; earlier objects stay whole. 0
 * after any other trap, and where memory does not come from here. */
HB_API uint32_t hb_undo_call(void);

/* ---- baking: interior distances and spheres of a mesh ------------------------------------------------------------------ */

/* A mesh with all that IRBF needs to know about its interior. All lengths from `origin` on are in solver space. */
typedef struct hb_body {
  double center[3];           /* solver space = (model − center) / diagonal */
  double diagonal;            /* length of the bounding box's diagonal, model units */
  double origin[3];           /* center of voxel (0, 0, 0) */
  double spacing;             /* voxel edge */
  double distance_scale;      /* interior distance = distance_scale · code */
  double smooth_length;       /* over which one smooth function may deform the body; 0 where it is not known */
  uint32_t dims[3];           /* voxels along x, y, z */
  uint32_t vertex_count;
  uint32_t triangle_count;
  uint32_t voxel_count;
  uint32_t center_count;
  uint32_t sphere_count;
  const double* positions;    /* vertex_count × 3, model units, as stored: not welded */
  const uint32_t* triangles;  /* triangle_count × 3 */
  const uint32_t* voxels;     /* linear indices i + nx·(j + ny·k) of the inside voxels, ascending */
  const uint32_t* centers;    /* vertex numbers of the IRBF centers */
  const uint16_t* distances;  /* center_count × voxel_count codes */
  const double* spheres;      /* sphere_count × 4: center, radius */
  const double* sphere_axes;  /* sphere_count × 3: half the long axis of one that is an ellipsoid, 0 for others; NULL where there are none */
} hb_body;

typedef struct hb_bake hb_bake;

/* What to bake and how. Pointers may be NULL and are read during hb_bake_begin only. */
typedef struct hb_bake_options {
  uint32_t center_count;   /* 1 to 5000 (at most the number of distinct vertices is used), sampled farthest-first by interior distance; 0
                            * chooses it by the skeleton's branches, and serves every sphere with four */
  uint32_t resolution;     /* voxels along the longest side of the box, 8 to 512; 0 chooses it by how much is inside and by `quality` */
  uint32_t method;         /* interior distances: 0 fast marching, 1 Euclidean, for comparison, 2 heat, 3 mean value */
  uint32_t max_spheres;    /* 1 to 2000; 0 chooses it by the skeleton's branches */
  uint32_t packing;        /* spheres along a curve skeleton and beside it (0), from an octree (1), or greedily near the medial axis (2) */
  uint32_t tree_level;     /* of the octree, 1 to 10; 0 for the deepest that has no more than max_spheres */
  uint32_t straight_bones; /* 1: ellipsoids take the place of spheres where limbs are straight (§2.4) */
  uint32_t bone_count;     /* ellipsoids from end to end of `bones` */
  uint32_t quality;        /* 0 draft, 1 normal, 2 fine: voxels to aim at, and how finely distances are rounded */
  uint32_t cloud;          /* 1: the positions are a dense sample of a surface or a solid, without triangles */
  uint32_t voxel_count;    /* not 0: so many `voxels` of the grid that follows, in model units, are the inside; the mesh is their surface */
  uint32_t dims[3];
  double origin[3];        /* center of voxel (0, 0, 0) */
  double spacing;
  double overlap;          /* of two spheres, in parts of the smaller radius, -4 to 1; negative keeps them apart */
  double smallest_radius;  /* of spheres, in parts of the diagonal, 0 to 1; 0 chooses it by the voxels. A limb or part keeps some in any case */
  const double* bones;     /* bone_count × 6: two ends, model units, between which all is inside */
  const uint32_t* voxels;  /* linear indices i + nx·(j + ny·k), ascending */
  const double* density;   /* vertex_count relative densities of centers, 1e-6 to 1e6, 1 where nothing special is wanted */
  const uint8_t* used;     /* vertex_count: not 0 for the vertices that count, as those of a solid do; those that triangles use count anyway */
} hb_bake_options;

/* A warning about a bake that worked. */
typedef struct hb_bake_warning {
  int32_t code;      /* an hb_warning_code */
  int32_t vertex;    /* its vertex, or -1 */
  uint32_t count;    /* of triangles, open edges, links, vertices or voxels, as the code says */
  uint32_t placed;   /* 1: `place`, model units, is where it is worst */
  double value;      /* LIMBS_MERGED, VOXELS_FEW: a resolution that would do, or 0; PART_OUTSIDE: how far out, model units */
  double place[3];
} hb_bake_warning;

/* Refuses a mesh that is too large by its counts alone, before its arrays are copied in. Fails with MESH_TOO_LARGE. */
HB_WHOLE_API int32_t hb_mesh_check_size(double vertex_count, double triangle_count);

/* Checks a surface, point cloud or volume and begins to bake it. Fails with MESH_* codes, INVALID_SHAPE, INVALID_OPTION. */
HB_WHOLE_API int32_t hb_bake_begin(const double* positions, uint32_t vertex_count, const uint32_t* triangles, uint32_t triangle_count, const hb_bake_options* options, hb_bake** bake);

/* One bounded step (some triangles, a slab of voxels or one center). `progress` grows from 0 to 1; the bake is done when it is 1. Fails
 * with MESH_NO_INTERIOR, CLOUD_TOO_SPARSE, OUT_OF_MEMORY or, with mean value distances, MESH_OPEN or MESH_NOT_CONNECTED; with INVALID_OPTION where
 * a bone is not inside. */
HB_WHOLE_API int32_t hb_bake_step(hb_bake* bake, double* progress);

/* The finished body, owned by the bake. */
HB_WHOLE_API int32_t hb_bake_body(hb_bake* bake, hb_body* body);

/* The curve skeleton of the body (§4.2), owned by the bake: a graph, whose branches share the nodes where they meet. Without nodes for an
 * open sheet. */
typedef struct hb_skeleton {
  uint32_t node_count;
  uint32_t branch_count;
  uint32_t step_count;            /* nodes of all branches, one after another */
  uint32_t sphere_count;          /* of sphere_branches: the body's spheres, or 0 */
  const double* nodes;            /* node_count × 4: place, distance to the surface; solver space */
  const uint32_t* steps;          /* step_count nodes, each branch's from the end that is nearer to the root */
  const uint32_t* lengths;        /* branch_count numbers of steps */
  const int32_t* parents;         /* branch_count: the branch that this one goes on from, before it in the list, or -1 */
  const int32_t* sphere_branches; /* sphere_count: the branch of each sphere, or -1 */
} hb_skeleton;

/* Fails with INTERNAL where the bake is not finished. */
HB_WHOLE_API int32_t hb_bake_skeleton(hb_bake* bake, hb_skeleton* skeleton);

/* The number of warnings so far. Writes warning number `index`, if there is one. */
HB_WHOLE_API uint32_t hb_bake_get_warning(hb_bake* bake, uint32_t index, hb_bake_warning* warning);

HB_WHOLE_API void hb_bake_free(hb_bake* bake);

/* ---- IRBF: the deformation -------------------------------------------------------------------------------------------- */

typedef struct hb_irbf hb_irbf;

/* Options of hb_irbf_create. */
typedef struct hb_irbf_options {
  double relative_width; /* h, in mean center spacings; 0 takes the body's smooth length, two spacings at least */
  double smoothness;     /* λ of eq. (10); 0 chooses it from the body */
  double anchor_weight;  /* μ */
  double edge_exponent;  /* α of eq. (8) */
  double poisson_ratio;  /* 0 to 0.499: how much volume resists (fixed corotated elasticity); 0 is eq. (8). Rigid spheres only */
  double support;        /* where the compact inverse multiquadric ends, in widths */
  uint32_t kernel;       /* as in hb_rbf_options, but for 14 */
  uint32_t host_kernel;  /* of kernel 15 */
  int32_t order;         /* of polyharmonic */
  uint32_t constraints;  /* 0 soft (appendix), 1 hard (§4.6) */
  uint32_t precision;    /* of hb_irbf_deform: 0 for 16-bit fixed point, 1 for float */
  uint32_t sphere_fit;   /* of eq. (8): 0 for each sphere's closest rigid map, 1 for its closest similarity (§4.5), which may grow */
  uint32_t structure;    /* Fig. 7: 0 for six points a sphere, 1 for twelve about its center; an ellipsoid has 32 in any case */
} hb_irbf_options;

/* What the last hb_irbf_solve did. */
typedef struct hb_irbf_report {
  double energy;         /* eq. (10): sphere distortion + λ‖a‖², and the soft constraints' misfit; solver space */
  double anchor_error;   /* largest distance between a handle's image and its target, model units */
  double change;         /* largest movement of a sphere edge in the last iteration, solver space */
  uint32_t iterations;
  uint32_t converged;    /* 1 when `change` fell below the tolerance */
} hb_irbf_report;

/* How the present deformation treats volume and shape, and the condition of the equations. */
typedef struct hb_irbf_quality {
  double volume_ratio;      /* of the deformed shape to that at rest */
  double total_distortion;  /* Σ A min ‖df − R‖² over tetrahedra of volume A, model units³ */
  double max_distortion;
  double maximum_principle; /* the most by which a basis function inside leaves its range on the surface, over that range */
  double condition;         /* estimated 1-norm condition number of the equations; 0 without handles */
  double smoothness;        /* λ, given or chosen */
  double relative_width;    /* h in mean center spacings, given or chosen; 0 for a kernel without a width */
  uint32_t flips;           /* tetrahedra turned inside out */
  uint32_t tetrahedra;
} hb_irbf_quality;

/* Prepares a baked body: basis functions at the spheres and at every vertex. Fails with BODY_INVALID, INVALID_OPTION, KERNEL_FAILED or
 * OUT_OF_MEMORY. */
HB_API int32_t hb_irbf_create(const hb_body* body, const hb_irbf_options* options, hb_irbf** irbf);

/* Another deformation of the body that `irbf` deforms, with the same options; at rest, and without handles. What depends on no handle,
 * most of the memory, is shared by the two and lasts as long as either. */
HB_API int32_t hb_irbf_share(const hb_irbf* irbf, hb_irbf** shared);

/* Sets the handles: `points` count × 3 in model units, `kinds` 0 for a position handle, 1 for one that also sets rotation and scale.
 * Builds and factors the system, and puts every target at rest. Fails with HANDLE_* codes or
 * SYSTEM_SINGULAR and keeps the former handles. */
HB_API int32_t hb_irbf_set_handles(hb_irbf* irbf, const double* points, const uint32_t* kinds, uint32_t count);

/* The body's positions as they were when the object was made, 3 a vertex, model units: where handles on vertices sit. */
HB_API const double* hb_irbf_positions(const hb_irbf* irbf);

/* 10 numbers per handle: position xyz (model units), quaternion xyzw, scale xyz. Write it in place. */
HB_API double* hb_irbf_targets(hb_irbf* irbf);

/* 9 numbers per sphere of the body: the rows of a linear map of the sphere at rest, which it is to have the shape of, up to its own turn
 * (eq. (11)); the identity at first, which keeps it. Write it in place; the next hb_irbf_solve reads it. */
HB_API double* hb_irbf_shapes(hb_irbf* irbf);

/* Local/global iterations from where the last solve stopped, until no sphere edge moves more than `tolerance` (solver space) or
 * `max_iterations` are done; `accelerate` 1 for Anderson acceleration, 0 for plain iterations. Fails with TARGET_NOT_FINITE,
 * HANDLE_CONFLICT, SHAPE_INVERTED (culprit: the sphere) or HANDLES_MISSING and keeps the last solution. */
HB_API int32_t hb_irbf_solve(hb_irbf* irbf, uint32_t max_iterations, double tolerance, uint32_t accelerate, hb_irbf_report* report);

/* Deformed positions (vertex_count × 3, model units) of all vertices as stored, and normals when `normals` is not NULL: `rest_normals`
 * (vertex_count × 3) turned, or where that is NULL, area-weighted ones. */
HB_API int32_t hb_irbf_deform(hb_irbf* irbf, float* positions, const float* rest_normals, float* normals);

/* The deformation at any `count` points of space (model units, in and out count × 3): the double-precision reference. Fails with
 * QUERY_NOT_FINITE (culprit: the point) or KERNEL_FAILED. */
HB_API int32_t hb_irbf_evaluate(hb_irbf* irbf, const double* points, uint32_t count, double* out);

/* Measures the present deformation on `count` tetrahedra of the mesh's own vertices, or with 0 on those that the voxels make. Fails with
 * MESH_INDEX_OUT_OF_RANGE or OUT_OF_MEMORY. */
HB_API int32_t hb_irbf_measure(hb_irbf* irbf, const uint32_t* tetrahedra, uint32_t count, hb_irbf_quality* quality);

HB_API void hb_irbf_free(hb_irbf* irbf);

/* ---- pose space: weights of examples ---------------------------------------------------------------------------------- */

typedef struct hb_pose_space hb_pose_space;

/* `places` count × dimension. `method` 0: cardinal RBF with a polynomial tail of `degree` (0 or 1; 1 makes the weights reproduce
 * linear functions); 1: normalized cardinal RBF, where a `degree` of -1 means no tail. `width` in units of the places, ignored by
 * kernels without one; 0 gives every example its own, a part of the distance to its nearest neighbor. Weights are 1 at their own
 * example and 0 at the others, and sum to 1 everywhere.
 * Fails with EXAMPLE_* and EXAMPLES_* codes; examples closer than 1e-9 of the extent count as one place. */
HB_API int32_t hb_pose_space_create(const double* places, uint32_t count, uint32_t dimension, uint32_t method, uint32_t kernel, double width, int32_t degree, hb_pose_space** space);

/* Weights (count) at `query` (dimension). Fails with QUERY_NOT_FINITE. */
HB_API int32_t hb_pose_space_weights(hb_pose_space* space, const double* query, double* weights);

HB_API void hb_pose_space_free(hb_pose_space* space);

/* ---- scattered interpolation -------------------------------------------------------------------------------------------- */

/* An interpolant of points with values. `points` count × dimension, `values` count × outputs, 1 to 64 dimensions. All *_create functions of
 * this section check them alike: POINTS_TOO_FEW, POINT_NOT_FINITE, VALUE_NOT_FINITE, POINTS_DEGENERATE, and, unless the method smooths,
 * POINT_DUPLICATE where two points at one place (closer than 1e-9 of the extent) have different values; where the values are equal the
 * later point is merged into the earlier one. */
typedef struct hb_interpolant hb_interpolant;

/* For each point (count as given) the one that stands for it: itself, or the earlier point that it was merged into. */
HB_API int32_t hb_interpolant_twins(hb_interpolant* interpolant, uint32_t* twins);

/* Values (count × outputs) at `queries` (count × dimension). Allocates nothing. Fails with QUERY_NOT_FINITE (culprit: the query). */
HB_API int32_t hb_interpolant_evaluate(hb_interpolant* interpolant, const double* queries, uint32_t count, double* out);

/* Gradients (count × outputs × dimension) at `queries`, NaN where there is none. Fails with QUERY_NOT_FINITE, or INVALID_OPTION for a
 * method without gradients. */
HB_API int32_t hb_interpolant_gradient(hb_interpolant* interpolant, const double* queries, uint32_t count, double* out);

/* Weights of the points as given (count × points) at `queries`: the value is the sum of the points' values times their weights. */
HB_API int32_t hb_interpolant_weights(hb_interpolant* interpolant, const double* queries, uint32_t count, double* out);

HB_API void hb_interpolant_free(hb_interpolant* interpolant);

/* Options of hb_tension_spline_create, which minimizes Σ (f − y)²/smoothing + alpha ∫(∇²f)² + beta ∫|∇f|² + gamma ∫f² over all of space, or
 * passes through the points for a smoothing of 0. */
typedef struct hb_tension_spline_options {
  double alpha;     /* ≥ 0, and above 0 except in 1 dimension */
  double beta;      /* ≥ 0 */
  double gamma;     /* ≥ 0 */
  double smoothing; /* ≥ 0 */
  uint32_t ends;    /* 0: as above; 1: in 1 dimension with gamma and smoothing 0, over the points' interval only, with zero slope at both
                       ends and constant beyond */
} hb_tension_spline_options;

/* Splines with tension in 1, 2 or 3 dimensions. hb_rbf_get_report() and the like accept the result for ends 0. Fails with the codes above,
 * INVALID_OPTION, INVALID_SHAPE (another dimension) or, as hb_rbf_create does, OUT_OF_MEMORY or SYSTEM_SINGULAR. */
HB_API int32_t hb_tension_spline_create(const double* points, const double* values, uint32_t count, uint32_t dimension, uint32_t outputs, const hb_tension_spline_options* options, hb_interpolant** interpolant);

/* Shepard's method with weights (r + epsilon)^-power. */
HB_API int32_t hb_shepard_create(const double* points, const double* values, uint32_t count, uint32_t dimension, uint32_t outputs, double power, double epsilon, hb_interpolant** interpolant);

/* Options of hb_moving_least_squares_create. */
typedef struct hb_moving_least_squares_options {
  double power;    /* > 0, of weight 0 */
  double epsilon;  /* ≥ 0, of weight 0, units of the points */
  double width;    /* > 0, of the other weights, units of the points; 0 is chosen from the spacing */
  int32_t degree;  /* of the polynomials, 0 to 2 */
  uint32_t weight; /* 0 (r + epsilon)^-power, 1 exp(-(r/width)²), 2 (1 - r/width)⁴₊ (4r/width + 1) */
} hb_moving_least_squares_options;

/* Moving least squares: at every query a polynomial, fitted to the points by weights that fall with their distance. `used_width`, unless
 * NULL, gets the width that was used (0 for weight 0). Fails with the codes above, of which POINTS_TOO_FEW and POINTS_DEGENERATE also say
 * that the points do not determine a polynomial of the degree, INVALID_OPTION or OUT_OF_MEMORY. */
HB_API int32_t hb_moving_least_squares_create(const double* points, const double* values, uint32_t count, uint32_t dimension, uint32_t outputs, const hb_moving_least_squares_options* options, double* used_width, hb_interpolant** interpolant);

/* Linear interpolation on the Delaunay simplices; for cospherical points (to 1e-9) the weights of least norm. `outside` the convex hull,
 * farther than 1e-12 of the diagonal: 0 for the value at the hull's nearest point, 1 for NaN. Points that span less than the space are
 * interpolated in their span, onto which queries are projected; with 1, NaN farther than 2e-9 of the diagonal from it. No gradients. */
HB_API int32_t hb_simplex_linear_create(const double* points, const double* values, uint32_t count, uint32_t dimension, uint32_t outputs, uint32_t outside, hb_interpolant** interpolant);

/* Options of hb_rbf_create. */
typedef struct hb_rbf_options {
  double width;          /* units of the points; ignored by kernels without one and unless width_choice is 0 */
  double smoothing;      /* λ ≥ 0 of R + λI; -1 in hb_find_outliers chooses it */
  double weight_decay;   /* λ ≥ 0 of min ‖Rw − d‖² + λ‖w‖² */
  double poisson_ratio;  /* 0 to 0.499: how much volume resists (fixed corotated elasticity); 0 is eq. (8). Rigid spheres only */
  double support;        /* where the compact inverse multiquadric ends, in widths */
  const double* widths;  /* one per center, or NULL */
  const double* centers; /* center_count × dimension, or NULL for the points themselves */
  const double* metric;  /* dimension × dimension, symmetric and positive definite, or NULL for Euclidean distances */
  uint32_t center_count; /* of `centers`, and of `widths` */
  uint32_t kernel;       /* 0 linear, 1 cubic, 2 thin plate, 3 Gaussian, 4 multiquadric, 5 inverse multiquadric, 6 inverse quadratic, 7 quintic,
                            8 polyharmonic, 9 10 11 Wendland C0 C2 C4, 12 Buhmann, 13 compact inverse multiquadric, 14 clamped plate, 15 the host's */
  uint32_t host_kernel;  /* of kernel 15: the number that the imported hb_host_kernel(number, derivative, s) is asked for */
  int32_t degree;        /* of the polynomial tail, -1 (none) to 2 */
  int32_t order;         /* of polyharmonic and clamped plate: 2 is biharmonic, 3 triharmonic */
  uint32_t normalized;   /* 1 divides the kernels by their sum */
  uint32_t width_choice; /* 0 as given, 1 from the spacing, 2 least leave-one-out error */
  uint32_t robust;       /* with fewer centers than points: 0 least squares, 1 least absolute misfits, 2 least median of squares */
} hb_rbf_options;

/* How good a fit is; lengths in units of the points. */
typedef struct hb_rbf_report {
  double condition; /* estimated 1-norm condition number of the equations */
  double residual;  /* largest misfit at a point */
  double spacing;   /* mean distance of a point to its nearest neighbor; 0 for a single point */
  double least_width;
  double largest_width;
  double suggested_width; /* where ill conditioned, far off the points or narrow: a width, smoothing and weight decay that help; else 0 */
  double suggested_smoothing;
  double suggested_decay;
  uint32_t center_count;
  uint32_t near_count; /* pairs of points closer than a thousandth of the spacing, at most 8 of them listed */
  uint32_t near_pairs[16];
} hb_rbf_report;

/* Radial basis interpolation. Fails with the codes above, INVALID_OPTION, OUT_OF_MEMORY (before anything is allocated), KERNEL_FAILED or
 * SYSTEM_SINGULAR. */
HB_API int32_t hb_rbf_create(const double* points, const double* values, uint32_t count, uint32_t dimension, uint32_t outputs, const hb_rbf_options* options, hb_interpolant** interpolant);

/* HB_OK where the matrices of an hb_rbf_create with such counts may be allocated (`center_count` 0 for one at each point), else
 * OUT_OF_MEMORY: to be called before the points are copied in. */
HB_API int32_t hb_rbf_check_size(uint32_t count, uint32_t dimension, uint32_t center_count, int32_t degree);

/* These take an interpolant that hb_rbf_create made, and fail with INVALID_OPTION for other methods. Coefficients: center_count × outputs,
 * of the kernels in the caller's units. Leave-one-out: count × outputs errors, value less prediction without the point. Row weights: count,
 * below 1 where a robust fit mistrusts a point. */
HB_API int32_t hb_rbf_get_report(hb_interpolant* interpolant, hb_rbf_report* report);
HB_API int32_t hb_rbf_coefficients(hb_interpolant* interpolant, double* out);
HB_API int32_t hb_rbf_leave_one_out(hb_interpolant* interpolant, double* out);
HB_API int32_t hb_rbf_row_weights(hb_interpolant* interpolant, double* out);

/* The first three say what to look for; into the others hb_find_outliers writes what it finds. */
typedef struct hb_outlier_search {
  double threshold;       /* robust standard deviations above the median score */
  uint32_t method;        /* scores: 0 row sums of the function norm, 1 what the norm loses without the point, 2 distance from the smoothed
                             interpolant */
  uint32_t most;          /* most outliers to take out; `outliers` and `heights` have room for as many */
  double* scores;         /* one per point, before any is taken out */
  uint32_t* outliers;     /* points, as they were found */
  double* heights;        /* the score of each when it was found, in robust standard deviations above the median */
  double smoothing;       /* the one used */
  uint32_t outlier_count; /* of `outliers` and `heights` */
} hb_outlier_search;

/* Looks for bad data by the RBF of `options`: takes out one point after another, while the highest score is above the threshold. Fails as
 * hb_rbf_create does, and then leaves `search` as it was. */
HB_API int32_t hb_find_outliers(const double* points, const double* values, uint32_t count, uint32_t dimension, uint32_t outputs, const hb_rbf_options* options, hb_outlier_search* search);

/* ---- discrete Green's functions: where kernels come from ----------------------------------------------------------------- */

/* A line of `size` samples (order + 1 to 1024), differences D of an order 1 to 3 and a boundary: 0 free ends, 1 Dirichlet (0 beyond), 2
 * Neumann (no slope), 3 periodic. See core/interpolation/discrete_green.hpp for the matrices. */
typedef struct hb_discrete_green hb_discrete_green;

/* The curve through `samples` (sample_count different numbers below size) with `values` that is the smoothest in terms of D. Fails with
 * INVALID_OPTION, INVALID_SHAPE, POINTS_TOO_FEW, POINT_DUPLICATE or VALUE_NOT_FINITE (culprit: which of the samples). */
HB_WHOLE_API int32_t hb_discrete_green_create(uint32_t size, uint32_t order, uint32_t boundary, const uint32_t* samples, const double* values, uint32_t sample_count, hb_discrete_green** green);

/* Rows of D, and the dimension of the null space of DᵀD. */
HB_WHOLE_API int32_t hb_discrete_green_shape(hb_discrete_green* green, uint32_t* rows, uint32_t* nullity);

/* `which` 0: D (rows × size); 1: DᵀD; 2: its orthonormal null space (size × nullity); 3: Green's matrix, its (generalized) inverse. */
HB_WHOLE_API int32_t hb_discrete_green_matrix(hb_discrete_green* green, uint32_t which, double* out);

/* The curve (size), by elimination on the grid. */
HB_WHOLE_API int32_t hb_discrete_green_solve_grid(hb_discrete_green* green, double* out);

/* The curve (size) by radial functions, and unless NULL their `weights` (sample_count + nullity), Green's functions first. */
HB_WHOLE_API int32_t hb_discrete_green_solve_radial(hb_discrete_green* green, double* out, double* weights);

HB_WHOLE_API void hb_discrete_green_free(hb_discrete_green* green);

/* Natural neighbor interpolation (Sibson) of points in the plane: INVALID_SHAPE for another dimension than 2. `outside` the convex hull
 * 0 gives the value at the nearest point of the hull, 1 NaN. Gradients are NaN at the points. */
HB_API int32_t hb_natural_neighbor_create(const double* points, const double* values, uint32_t count, uint32_t dimension, uint32_t outputs, uint32_t outside, hb_interpolant** interpolant);

/* ---- tetrahedra ------------------------------------------------------------------------------------------------------------ */

/* Tetrahedra that fill a surface. */
typedef struct hb_tetrahedra hb_tetrahedra;

typedef struct hb_tetrahedra_view {
  uint32_t vertex_count;
  uint32_t tetrahedron_count;
  const double* positions;     /* vertex_count × 3 */
  const uint32_t* tetrahedra;  /* tetrahedron_count × 4, positively oriented */
  const uint32_t* corners;     /* for each vertex of the surface, the 4 corners of its tetrahedron */
  const double* coordinates;   /* and its 4 barycentric coordinates */
} hb_tetrahedra_view;

/* The voxels that a surface touches or encloses, `resolution` (4 to 256) along its longest side, as six tetrahedra each. Fails with MESH_* or
 * INVALID_OPTION. */
HB_WHOLE_API int32_t hb_tetrahedra_create(const double* positions, uint32_t vertex_count, const uint32_t* triangles, uint32_t triangle_count, uint32_t resolution, hb_tetrahedra** tetrahedra);

HB_WHOLE_API void hb_tetrahedra_arrays(hb_tetrahedra* tetrahedra, hb_tetrahedra_view* view);

HB_WHOLE_API void hb_tetrahedra_free(hb_tetrahedra* tetrahedra);

/* ---- skinning weights ------------------------------------------------------------------------------------------------------ */

/* A mesh that weights and deformations are defined on: triangles (3 corners) in 2 or 3 dimensions, tetrahedra (4) in 3. */
typedef struct hb_simplex_mesh {
  const double* positions;   /* vertex_count × dimension */
  const uint32_t* simplices; /* simplex_count × corners vertex numbers */
  uint32_t vertex_count;
  uint32_t dimension;
  uint32_t simplex_count;
  uint32_t corners;
} hb_simplex_mesh;

/* A mesh as the functions below want it, made from one as it comes. */
typedef struct hb_sound_mesh hb_sound_mesh;

/* A vertex that only flat simplices use: Σ parts[k] · corners[k], the nearest point of the sound ones. */
typedef struct hb_flat_vertex {
  uint32_t vertex; /* of the mesh as it came */
  uint32_t corners[3];
  double parts[3]; /* not negative; their sum is 1 */
} hb_flat_vertex;

typedef struct hb_sound_mesh_view {
  const double* positions;             /* vertex_count × dimension: one vertex for each place */
  const uint32_t* simplices;           /* simplex_count × corners: the sound ones */
  uint32_t vertex_count;
  uint32_t simplex_count;
  const uint32_t* first;               /* for each of these vertices the first vertex there of the mesh as it came */
  const uint32_t* vertex_of;           /* for each vertex of the mesh as it came its vertex here; for a flat one the nearest corner */
  const uint32_t* place_of;            /* for each vertex of the mesh as it came the first one at its place */
  const hb_flat_vertex* flat_vertices; /* flat_vertex_count */
  const uint32_t* doubled;             /* doubled_count simplices with the corners of one before them, which were left out */
  uint32_t flat_vertex_count;
  uint32_t doubled_count;
  uint32_t flat_count;                 /* simplices without area or volume, which were left out, and the first of them */
  uint32_t flat_first;
  uint32_t unused_count;               /* vertices that no simplex uses, and the first of them */
  uint32_t unused_first;
} hb_sound_mesh_view;

/* Joins the vertices at one place unless `weld` is 0, and leaves out flat and repeated simplices, or refuses them where `strict` is 1: see
 * core/mesh/sound_mesh.hpp. Fails with MESH_*, INVALID_SHAPE or INVALID_OPTION. */
HB_WHOLE_API int32_t hb_sound_mesh_create(const hb_simplex_mesh* mesh, uint32_t weld, uint32_t strict, hb_sound_mesh** sound);

/* Pointers are valid until the mesh is freed. */
HB_WHOLE_API void hb_sound_mesh_get(hb_sound_mesh* sound, hb_sound_mesh_view* view);

HB_WHOLE_API void hb_sound_mesh_free(hb_sound_mesh* sound);

/* Which vertices handles hold: handle owners[k] holds vertices[k]. */
typedef struct hb_held_vertices {
  const uint32_t* vertices;
  const uint32_t* owners; /* below handle_count */
  uint32_t count;         /* of both lists */
  uint32_t handle_count;
} hb_held_vertices;

/* Weights of handles on a mesh: 1 at the handle's own vertices, 0 at the others', smoothest in between. */
typedef struct hb_skinning_weights hb_skinning_weights;

/* A connected part of a mesh that no handle touches: its first vertex, its number of vertices, and the nearest handle, which it follows. */
typedef struct hb_island {
  uint32_t first;
  uint32_t count;
  uint32_t handle;
} hb_island;

/* A square matrix by rows: entries starts[i] to starts[i + 1] of row i, in ascending columns. */
typedef struct hb_sparse_matrix {
  const uint32_t* starts;
  const uint32_t* columns;
  const double* values;
} hb_sparse_matrix;

/* The operators of a mesh. `order` 1 harmonic (least ∫|∇w|²), 2 biharmonic (∫(Δw)²), 3 triharmonic (∫|∇Δw|²); `mass` 0 Voronoi, mixed where
 * obtuse, 1 barycentric. Fails with MESH_*, INVALID_SHAPE, INVALID_OPTION or OUT_OF_MEMORY. */
HB_WHOLE_API int32_t hb_skinning_weights_create(const hb_simplex_mesh* mesh, uint32_t order, uint32_t mass, hb_skinning_weights** weights);

/* Each handle holds one vertex or more. Solves, the first time by factoring, later by small updates where that is less work. Fails with
 * HANDLES_MISSING, HANDLE_OUT_OF_RANGE, HANDLE_CONFLICT (two on one vertex), OUT_OF_MEMORY or SYSTEM_SINGULAR, and keeps the former weights. */
HB_WHOLE_API int32_t hb_skinning_weights_set_handles(hb_skinning_weights* weights, const hb_held_vertices* handles);

/* vertex_count × handle_count; rows sum to 1. */
HB_WHOLE_API const double* hb_skinning_weights_values(hb_skinning_weights* weights);

/* 1 where the last set_handles factored anew, 0 where it was an update. */
HB_WHOLE_API uint32_t hb_skinning_weights_factored(hb_skinning_weights* weights);

/* The parts without a handle of their own, and their number. */
HB_WHOLE_API uint32_t hb_skinning_weights_islands(hb_skinning_weights* weights, const hb_island** islands);

/* The diagonal mass matrix (vertex_count), and the matrix Q of the energy wᵀQw with the number of its entries: for order 1 the negative of
 * libigl's `cotmatrix`, for order 2 the bi-Laplacian C M⁻¹ C. */
HB_WHOLE_API const double* hb_skinning_weights_mass(hb_skinning_weights* weights);
HB_WHOLE_API uint32_t hb_skinning_weights_energy(hb_skinning_weights* weights, hb_sparse_matrix* energy);

/* The result of bounding the weights. */
typedef struct hb_bounded_report {
  double energy;         /* ½ Σ wᵀQw */
  double gap;            /* the least energy is not below energy − gap */
  uint32_t sweeps;       /* of the alternating direction method */
  uint32_t newton_steps;
} hb_bounded_report;

/* Begins to bring the weights into [0, 1]: minimizes ½ Σⱼ wⱼᵀQwⱼ of all handles together with w ≥ 0 and rows that sum to 1, to `tolerance`
 * of the energy. Then step until `progress` is 1; hb_skinning_weights_values() are the bounded ones from then on, until other handles are
 * set. Fails as hb_skinning_weights_set_handles does. */
HB_WHOLE_API int32_t hb_skinning_weights_bound_begin(hb_skinning_weights* weights, double tolerance);
HB_WHOLE_API int32_t hb_skinning_weights_bound_step(hb_skinning_weights* weights, double* progress, hb_bounded_report* report);

HB_WHOLE_API void hb_skinning_weights_free(hb_skinning_weights* weights);

/* How well weights meet the requirements, each the worst number over the mesh: see core/skinning/measure_weights.hpp. */
typedef struct hb_weight_measures {
  double gradient_jump; /* from one simplex to the next, over the weight's largest gradient */
  double far_weight;    /* where another handle is less than half as far inside the shape */
  double leaked_weight; /* of the handle that is nearest in a straight line, but around a bend and not nearest inside; NaN: no such place */
  double sum_error;     /* |Σⱼ wⱼ − 1| */
  double least;
  double largest;
} hb_weight_measures;

/* Measures any `weights` (vertex_count × handle_count); handles may share vertices here. `support` (handle_count) becomes the part of the area or
 * volume where each weight counts. Fails with MESH_*, INVALID_SHAPE, HANDLES_MISSING, HANDLE_OUT_OF_RANGE, VALUE_NOT_FINITE (culprit: the
 * vertex) or OUT_OF_MEMORY. */
HB_WHOLE_API int32_t hb_measure_weights(const hb_simplex_mesh* mesh, const hb_held_vertices* handles, const double* weights, double* support, hb_weight_measures* measures);

/* ---- skinning: a shape under a few moving handles ----------------------------------------------------------------------- */

/* Rest positions (count × dimension, 2 or 3), and for each of `handle_count` handles an affine transform. */
typedef struct hb_skin hb_skin;

/* Linear blending of the transforms by `weights` (count × handle_count, any finite numbers), `compiled` into one matrix where it is 1: the
 * same result. Fails with INVALID_SHAPE, MESH_NOT_FINITE or VALUE_NOT_FINITE (culprit: the vertex), or OUT_OF_MEMORY. */
HB_API int32_t hb_linear_blend_create(const double* positions, uint32_t count, uint32_t dimension, const double* weights, uint32_t handle_count, uint32_t compiled, hb_skin** skin);

/* Dual quaternion blending of the transforms' rigid parts: every vertex moves rigidly. Fails likewise, or with WEIGHTS_MISSING where a
 * vertex has no weight at all. */
HB_API int32_t hb_dual_quaternion_create(const double* positions, uint32_t count, uint32_t dimension, const double* weights, uint32_t handle_count, hb_skin** skin);

/* handle_count × dimension × (dimension + 1) numbers: T with the image T [v; 1] for each handle, the identity at first. Write it in place. */
HB_API double* hb_skin_transforms(hb_skin* skin);

/* Deformed positions (count × dimension). Allocates nothing. Fails with TARGET_NOT_FINITE (culprit: the handle) and writes nothing. */
HB_API int32_t hb_skin_deform(hb_skin* skin, float* positions);

/* Instead minimizes an energy of triangles in the plane while each handle holds its vertices, and a handle of one vertex also those around
 * it. `energy` 0 Dirichlet, 1 Laplacian, 2 conformal (as similar as possible), 3 as rigid as possible. Fails with MESH_*, INVALID_SHAPE,
 * HANDLES_MISSING, HANDLE_OUT_OF_RANGE, HANDLE_CONFLICT, INVALID_OPTION, OUT_OF_MEMORY or SYSTEM_SINGULAR. */
HB_WHOLE_API int32_t hb_minimizer_create(const hb_simplex_mesh* mesh, const hb_held_vertices* handles, uint32_t energy, hb_skin** skin);

typedef struct hb_minimizer_report {
  double energy;
  uint32_t iterations; /* local/global rounds that were taken; 1 for a quadratic energy */
  uint32_t flips;      /* triangles turned over */
} hb_minimizer_report;

/* hb_skin_deform() for an object of hb_minimizer_create, with up to `iterations` rounds (as rigid as possible) from where the last call
 * stopped. Fails likewise, or with INVALID_OPTION. */
HB_WHOLE_API int32_t hb_minimizer_deform(hb_skin* skin, uint32_t iterations, float* positions, hb_minimizer_report* report);

HB_API void hb_skin_free(hb_skin* skin);

#ifdef __cplusplus
}
#endif

#endif
