/* Handlebody: the C interface of the solver.
 *
 * This header is the whole contract between the solver and its callers: TypeScript's declarations, the offsets of the structs
 * and the wasm export list are generated from it (scripts/generate.mjs), so keep one function a line, each behind HB_API.
 *
 * Conventions
 *   - Every function that can fail returns an hb_status; hb_last_error() then tells the whole story. On failure out-parameters
 *     are untouched and the object is as it was: the last good solution stays readable.
 *   - Objects are opaque. The caller frees what a *_create or *_begin function returned by the matching *_free; NULL is allowed.
 *   - Arrays are row-major and tightly packed. Input arrays are copied; pointers that a function returns belong to the object and
 *     are valid until its next non-const call.
 *   - Doubles to solve, floats for the frame. Lengths are in the model's own units unless "solver space" is said, which is the
 *     model scaled to a unit bounding-box diagonal and centered on its box.
 *   - Nothing here is thread-safe; use one instance a thread.
 */
#ifndef HANDLEBODY_H
#define HANDLEBODY_H

#include <stdint.h>

#include "core/numerics/status.h"

#define HB_API

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

/* ---- baking: interior distances and spheres of a mesh ------------------------------------------------------------------ */

/* A mesh with all that IRBF needs to know of its interior. All lengths from `origin` on are in solver space. */
typedef struct hb_body {
  double center[3];           /* solver space = (model − center) / diagonal */
  double diagonal;            /* length of the bounding box's diagonal, model units */
  double origin[3];           /* center of voxel (0, 0, 0) */
  double spacing;             /* voxel edge */
  double distance_scale;      /* interior distance = distance_scale · code */
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
} hb_body;

typedef struct hb_bake hb_bake;

/* Checks a mesh and begins to bake it. `method` is 0 (interior distances by fast marching) or 1 (Euclidean, for comparison);
 * `resolution` counts voxels along the longest side of the box, 8 to 512; `center_count` 1 to 5000 (at most the number of distinct
 * vertices is used), sampled farthest-first by interior distance; `max_spheres` 1 to 2000.
 * Fails with MESH_* codes, INVALID_OPTION or OUT_OF_MEMORY. */
HB_API int32_t hb_bake_begin(const double* positions, uint32_t vertex_count, const uint32_t* triangles, uint32_t triangle_count, uint32_t center_count, uint32_t resolution, uint32_t method, uint32_t max_spheres, hb_bake** bake);

/* One bounded step (a slab of voxels or one center). `progress` grows from 0 to 1; the bake is done when it is 1. */
HB_API int32_t hb_bake_step(hb_bake* bake, double* progress);

/* The finished body, owned by the bake. */
HB_API int32_t hb_bake_body(hb_bake* bake, hb_body* body);

HB_API void hb_bake_free(hb_bake* bake);

/* ---- IRBF: the deformation -------------------------------------------------------------------------------------------- */

typedef struct hb_irbf hb_irbf;

/* What the last hb_irbf_solve did. */
typedef struct hb_irbf_report {
  double energy;         /* eq. (10): sphere distortion + λ‖a‖², solver space */
  double anchor_error;   /* largest distance between a handle's image and its target, model units */
  double change;         /* largest movement of a sphere edge in the last iteration, solver space */
  uint32_t iterations;
  uint32_t converged;    /* 1 when `change` fell below the tolerance */
} hb_irbf_report;

/* Prepares a baked body: basis functions at the spheres and at every vertex (float). `kernel` as in the kernel list, `relative_width`
 * h in mean center spacings, `smoothness` λ of eq. (10), `anchor_weight` μ, `edge_exponent` α of eq. (8).
 * Fails with BODY_INVALID, INVALID_OPTION or OUT_OF_MEMORY. */
HB_API int32_t hb_irbf_create(const hb_body* body, uint32_t kernel, double relative_width, double smoothness, double anchor_weight, double edge_exponent, hb_irbf** irbf);

/* Sets the handles: `points` count × 3 in model units, `kinds` 0 for a position handle, 1 for one that also sets rotation and scale.
 * Builds and factors the system, and puts every target at rest. Fails with HANDLE_* codes and keeps the former handles. */
HB_API int32_t hb_irbf_set_handles(hb_irbf* irbf, const double* points, const uint32_t* kinds, uint32_t count);

/* 10 numbers a handle: position xyz (model units), quaternion xyzw, scale xyz. Write it in place. */
HB_API double* hb_irbf_targets(hb_irbf* irbf);

/* Local/global iterations from where the last solve stopped, until no sphere edge moves more than `tolerance` (solver space) or
 * `max_iterations` are done. Fails with TARGET_NOT_FINITE, HANDLE_CONFLICT or HANDLES_MISSING and keeps the last solution. */
HB_API int32_t hb_irbf_solve(hb_irbf* irbf, uint32_t max_iterations, double tolerance, hb_irbf_report* report);

/* Deformed positions (vertex_count × 3, model units) of all vertices as stored, and normals when `normals` is not NULL: on entry
 * `rest_normals` (vertex_count × 3) or NULL for area-weighted ones. */
HB_API int32_t hb_irbf_deform(hb_irbf* irbf, float* positions, const float* rest_normals, float* normals);

/* The deformation at any `count` points of space (model units, in and out count × 3): the double-precision reference. */
HB_API int32_t hb_irbf_evaluate(hb_irbf* irbf, const double* points, uint32_t count, double* out);

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

/* Points with values, and what makes a function of them. `points` count × dimension, `values` count × outputs, 1 to 64 dimensions. All
 * *_create functions of this section check them alike: POINTS_TOO_FEW, POINT_NOT_FINITE, VALUE_NOT_FINITE, POINTS_DEGENERATE, and,
 * unless the method smooths, POINT_DUPLICATE where two points at one place (closer than 1e-9 of the extent) have different values;
 * where the values are equal the later point is merged into the earlier one. */
typedef struct hb_interpolant hb_interpolant;

/* The point that stands for each (count as given): its own number, or that of the earlier point that it was merged into. */
HB_API int32_t hb_interpolant_twins(hb_interpolant* interpolant, uint32_t* twins);

/* Values (count × outputs) at `queries` (count × dimension). Allocates nothing. Fails with QUERY_NOT_FINITE (culprit: the query). */
HB_API int32_t hb_interpolant_evaluate(hb_interpolant* interpolant, const double* queries, uint32_t count, double* out);

/* Gradients (count × outputs × dimension) at `queries`, NaN where there is none. Fails with QUERY_NOT_FINITE, or INVALID_OPTION for a
 * method without gradients. */
HB_API int32_t hb_interpolant_gradient(hb_interpolant* interpolant, const double* queries, uint32_t count, double* out);

/* Weights of the points as given (count × points) at `queries`: the value is their sum over the points' values. */
HB_API int32_t hb_interpolant_weights(hb_interpolant* interpolant, const double* queries, uint32_t count, double* out);

HB_API void hb_interpolant_free(hb_interpolant* interpolant);

/* Shepard's method with weights (r + epsilon)^-power. */
HB_API int32_t hb_shepard_create(const double* points, const double* values, uint32_t count, uint32_t dimension, uint32_t outputs, double power, double epsilon, hb_interpolant** interpolant);

/* Natural neighbor interpolation (Sibson) of points in the plane: INVALID_SHAPE for another dimension than 2. `outside` the convex hull
 * 0 gives the value at the nearest point of the hull, 1 NaN. Gradients are NaN at the points. */
HB_API int32_t hb_natural_neighbor_create(const double* points, const double* values, uint32_t count, uint32_t dimension, uint32_t outputs, uint32_t outside, hb_interpolant** interpolant);

#ifdef __cplusplus
}
#endif

#endif
