/* Every status code that the solver returns. The TypeScript names are generated from this list: HB_ERROR_MESH_NOT_FINITE becomes
 * 'mesh-not-finite'. Errors that only TypeScript throws have a name and no number: see wasm/ts/errors.ts, and error-codes.ts in
 * web/assets, web/models and web/cli. Codes are stable, and no number is used again: 5 to 8, 41, 42, 84 and 100 to 144 once stood
 * for errors of TypeScript. */
#ifndef HANDLEBODY_STATUS_H
#define HANDLEBODY_STATUS_H

typedef enum hb_status {
  HB_OK = 0,

  /* general */
  HB_ERROR_INTERNAL = 1,       /* a defect of ours; the message says where */
  HB_ERROR_OUT_OF_MEMORY = 2,  /* a size was refused before it was allocated, or memory ran out */
  HB_ERROR_INVALID_OPTION = 3, /* an option outside its documented range */
  HB_ERROR_INVALID_SHAPE = 4,  /* an array whose length does not fit the others */

  /* meshes */
  HB_ERROR_MESH_TOO_FEW_VERTICES = 20,
  HB_ERROR_MESH_NO_TRIANGLES = 21,
  HB_ERROR_MESH_NOT_FINITE = 22,
  HB_ERROR_MESH_INDEX_OUT_OF_RANGE = 23,
  HB_ERROR_MESH_ZERO_EXTENT = 24, /* all vertices coincide */
  HB_ERROR_MESH_NO_INTERIOR = 25, /* no voxel lies inside: an open sheet, or a grid too coarse */
  HB_ERROR_MESH_TOO_LARGE = 26,
  HB_ERROR_MESH_DEGENERATE = 27,    /* a triangle without area, a tetrahedron without volume */
  HB_ERROR_MESH_OPEN = 28,          /* an edge without a triangle on its other side, where a method needs a closed surface */
  HB_ERROR_MESH_NOT_CONNECTED = 29, /* several parts where a method needs one */
  HB_ERROR_CLOUD_TOO_SPARSE = 30,   /* a point cloud whose gaps are wider than the grid can close */

  /* baked bodies */
  HB_ERROR_BODY_INVALID = 40, /* arrays of a baked body contradict each other */

  /* handles */
  HB_ERROR_HANDLE_OUT_OF_RANGE = 60, /* its vertex is not in the mesh */
  HB_ERROR_HANDLE_OUTSIDE = 61,      /* its point is outside the model */
  HB_ERROR_HANDLE_CONFLICT = 62,     /* two handles at one place want different targets */
  HB_ERROR_HANDLE_NOT_FINITE = 63,
  HB_ERROR_TARGET_NOT_FINITE = 64,
  HB_ERROR_HANDLES_MISSING = 65, /* solve() before any handle was set */
  HB_ERROR_WEIGHTS_MISSING = 66, /* a vertex whose weights are all 0 */
  HB_ERROR_SHAPE_INVERTED = 67,  /* a sphere's target shape turns it inside out */

  /* pose spaces and scattered data */
  HB_ERROR_EXAMPLE_DUPLICATE = 80, /* two examples at one place with different shapes */
  HB_ERROR_EXAMPLE_NOT_FINITE = 81,
  HB_ERROR_EXAMPLES_TOO_FEW = 82,
  HB_ERROR_EXAMPLES_DEGENERATE = 83, /* places that do not span the polynomial tail, e.g. on one line */
  HB_ERROR_QUERY_NOT_FINITE = 85,
  HB_ERROR_POINT_DUPLICATE = 86, /* two points at one place with different values */
  HB_ERROR_POINT_NOT_FINITE = 87,
  HB_ERROR_VALUE_NOT_FINITE = 88,
  HB_ERROR_POINTS_TOO_FEW = 89,
  HB_ERROR_POINTS_DEGENERATE = 90, /* points that do not span what the method needs, e.g. on one line */
  HB_ERROR_SYSTEM_SINGULAR = 91,   /* the interpolation equations have no answer in double precision */
  HB_ERROR_KERNEL_FAILED = 92      /* a kernel of the caller's threw, or gave a number that is not finite */
} hb_status;

/* What a bake may report besides its body: it worked, perhaps not as meant. Names and numbers are as stable as those of errors. */
typedef enum hb_warning_code {
  HB_WARNING_SURFACE_OPEN = 1,      /* nothing lies inside: Euclidean distances over the surface's own voxels */
  HB_WARNING_MESH_INSIDE_OUT = 2,   /* the surface encloses a negative volume: triangles face inward */
  HB_WARNING_LIMBS_MERGED = 3,      /* the grid is too coarse to separate parts: distances leap across a gap */
  HB_WARNING_PART_OUTSIDE = 4,      /* vertices far from all voxels inside: parts without volume, or thinner than a voxel */
  HB_WARNING_ORIENTATION_MIXED = 5, /* neighboring triangles face opposite ways */
  HB_WARNING_SURFACE_FILLED = 6,    /* triangles do not tell inside from outside: what a shell of voxels encloses was used */
  HB_WARNING_VERTICES_UNUSED = 7,   /* vertices that no triangle with an area uses: they set neither box nor grid */
  HB_WARNING_TRIANGLES_FLAT = 8,    /* triangles without area, which are no surface: passed over */
  HB_WARNING_TRIANGLES_DOUBLED = 9, /* copies of a triangle, as it is or turned round: passed over */
  HB_WARNING_VOXELS_FEW = 10        /* the inside is a handful of voxels: too few to measure distances by */
} hb_warning_code;

/* What an error's index points at. */
typedef enum hb_culprit {
  HB_CULPRIT_NONE = 0,
  HB_CULPRIT_VERTEX = 1,
  HB_CULPRIT_TRIANGLE = 2,
  HB_CULPRIT_HANDLE = 3,
  HB_CULPRIT_EXAMPLE = 4,
  HB_CULPRIT_OPTION = 5,
  HB_CULPRIT_CENTER = 6,
  HB_CULPRIT_BYTE = 7,
  HB_CULPRIT_POINT = 8,
  HB_CULPRIT_QUERY = 9,
  HB_CULPRIT_TETRAHEDRON = 10,
  HB_CULPRIT_SPHERE = 11
} hb_culprit;

#endif
