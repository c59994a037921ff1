/** The plain data that crosses the library's boundaries: no classes, all of it can be posted between threads. */

import type { WarningCode } from './abi.generated.ts';
import type { Culprit } from './errors.ts';
import type { KernelFunction, KernelName } from './kernels.ts';

export type { WarningCode } from './abi.generated.ts';

/** Numbers in an array of any kind, three.js' own among them. */
export type TypedArray =
  | Int8Array
  | Uint8Array
  | Uint8ClampedArray
  | Int16Array
  | Uint16Array
  | Int32Array
  | Uint32Array
  | Float32Array
  | Float64Array;

/** A triangle mesh in scene space, Y up. `positions` n×3; `triangles` m×3 indices, counter-clockwise seen from outside. */
export interface Mesh {
  readonly positions: TypedArray;
  readonly triangles: TypedArray;
  /**
   * What the positions are relative to, in the model's units, where the model lies so far from the origin that floats could not hold its
   * shape; each number is exact as a float. Handles, targets, `evaluate` and all that is told stay in the model's units; `positions`,
   * `deform` and `positionsHash` are relative to it.
   */
  readonly origin?: Vec3 | undefined;
  /** How a scene was read, where it could be read in several ways; a body keeps it. */
  readonly reading?: MeshReading | undefined;
}

/** How a scene was read: what is needed to find the same vertices in it again, whatever moved or was hidden since. Parts are numbered in the scene's order. */
export interface MeshReading {
  /** Hidden parts that were left out. */
  readonly skipped?: readonly number[];
  /** By part: the weights of morph targets whose displacements are in the positions. */
  readonly morphs?: Readonly<Record<number, readonly number[]>>;
  /** By part: the matrix that a skin was read through, 16 numbers, column-major. */
  readonly skins?: Readonly<Record<number, readonly number[]>>;
  /** The mesh's `origin`: another part of it may be drawn by now. */
  readonly origin?: Vec3 | undefined;
}

/** A solid of tetrahedra (m×4 indices, in either order of corners). All of its vertices deform; they are shared by number. */
export interface TetrahedralMesh extends Pick<Mesh, 'origin' | 'reading'> {
  readonly positions: TypedArray;
  readonly tetrahedra: TypedArray;
}

/** A dense sample of a surface or of a solid, without triangles: dense enough that a voxel grid over it shows no wide gaps. */
export interface PointCloud extends Pick<Mesh, 'origin' | 'reading'> {
  readonly positions: TypedArray;
}

/** A solid of cubes: voxel (i, j, k), whose center is origin + spacing·(i, j, k), is inside where `inside[i + nx·(j + ny·k)]` is not 0. */
export interface VoxelVolume {
  readonly dimensions: readonly [number, number, number];
  readonly spacing: number;
  readonly origin: readonly [number, number, number];
  readonly inside: TypedArray;
}

/**
 * What can be baked. Only what is used counts: vertices that no triangle (of a solid: no tetrahedron) with an extent uses set neither box nor
 * grid, and move as the nearest inside does; of these, one whose coordinates no float holds (NaN, 1e39) is put in the middle of the others.
 * Triangles without area, and copies of a triangle, leave no trace. Warnings count them.
 */
export type BakeShape = Mesh | TetrahedralMesh | PointCloud | VoxelVolume;

/**
 * A mesh with its interior distances and spheres, as `Handlebody.bake` makes it and a baked GLB carries it. Lengths from `grid` on are in
 * solver space: (position − normalization.center) / normalization.diagonal.
 */
export interface BodyData {
  /** 1: read from a file of the first format, which knew neither `smoothLength` nor `skeleton`. */
  readonly version: 1 | 2;
  /** A copy of the mesh that was baked; of tetrahedra and voxels the surface with all vertices, of a point cloud the points and no triangles. */
  readonly mesh: Mesh;
  /** How the distances were measured. */
  readonly distance: DistanceMethod;
  /** Hash of the positions that the distances were computed for; see `hashPositions`. */
  readonly positionsHash: string;
  readonly normalization: { readonly center: readonly [number, number, number]; readonly diagonal: number };
  readonly grid: {
    /** Center of voxel (0, 0, 0). */
    readonly origin: readonly [number, number, number];
    readonly spacing: number;
    readonly dimensions: readonly [number, number, number];
  };
  /** Linear indices i + nx·(j + ny·k) of the inside voxels, ascending. */
  readonly voxels: Uint32Array;
  /** Vertex numbers of the IRBF centers. */
  readonly centers: Uint32Array;
  /** centers × voxels codes; the interior distance is code × distanceScale. */
  readonly distances: Uint16Array;
  readonly distanceScale: number;
  /** spheres × 4: center xyz, radius. */
  readonly spheres: Float64Array;
  /** spheres × 3: half the long axis of one that is an ellipsoid, a bone, which is `radius` thick about it; 0 for others. Left out without. */
  readonly sphereAxes?: Float64Array;
  /**
   * Over which length one smooth function may deform the body, which `relativeWidth: 'auto'` makes its kernels as wide as: half of a limb
   * where limbs meet, all of a body where none do. 0 or left out where it is not known.
   */
  readonly smoothLength?: number;
  /** Left out for a sheet, which has no inside. */
  readonly skeleton?: Skeleton;
  /** Where the model wants to be held, by name; `bake` names none. */
  readonly handles?: readonly NamedHandle[];
}

/**
 * A curve skeleton (§4.2): a graph of branches through the middle of a body, one into every limb, which share the nodes where they meet.
 * The deformation does not need it. Lengths are in solver space.
 */
export interface Skeleton {
  /** nodes × 4: place xyz, distance to the surface. */
  readonly nodes: Float64Array;
  /** Node numbers of all branches, one branch after another, each from the end that is nearer to the root. */
  readonly steps: Uint32Array;
  /** How many steps each branch has. */
  readonly lengths: Uint32Array;
  /** The branch that each goes on from, which comes before it, or −1. */
  readonly parents: Int32Array;
  /** The branch of each of the body's spheres, or −1 beside the skeleton. */
  readonly sphereBranches: Int32Array;
}

/** A handle and what it is called. */
export type NamedHandle = Handle & { readonly name: string };

/**
 * Distances inside the body: by fast marching; by heat, smoother and quicker on coarse grids; by mean value coordinates, which extend
 * distances along the surface to the inside; or in a straight line, for convex shapes and open sheets.
 *
 * Places outside have distances too. A point outside reads the nearest voxels inside, extrapolated over 1.5 of them at most, and so do
 * parts without volume ('part-outside' tells which). Surfaces that touch, or come closer than a voxel, merge for fast marching and heat
 * ('limbs-merged' tells where), and stay apart for mean values unless they share vertices' positions.
 */
export type DistanceMethod = 'fast-marching' | 'heat' | 'mean-value' | 'euclidean';

export interface BakeOptions {
  /**
   * How many IRBF centers to sample, farthest first. 'auto', the default: 80 and five for each branch of the skeleton, then as many more as
   * give every sphere four within three of its radii, measured inside (§4.3), 300 at most.
   */
  readonly centers?: number | 'auto';
  readonly distance?: DistanceMethod;
  /**
   * Voxels along the longest side of the bounding box. 'auto', the default, is as fine as the quality's number of voxels inside allows, so
   * that thin models get finer voxels than fat ones, and finer where that keeps limbs apart. A voxel volume brings its own.
   */
  readonly resolution?: number | 'auto';
  /**
   * How many bytes the interior distances may take: 5,000 voxels inside and distances in 4,096 steps for a 'draft', 16,000 and 8,192 for
   * 'normal', 64,000 and 65,536 for 'fine'.
   */
  readonly quality?: 'draft' | 'normal' | 'fine';
  /** Most spheres to fill the volume with. 'auto', the default: 40 and six for each branch of the skeleton, 200 at most. */
  readonly spheres?: number | 'auto';
  /**
   * Spheres along a curve skeleton, at least three along each branch that is thicker than two voxels, and beside it where there is room;
   * from an octree, spread over the volume, more alike; or near the medial axis, larger first, wherever that is.
   */
  readonly packing?: 'skeleton' | 'tree' | 'medial';
  /** Of the octree (`packing: 'tree'`), from 1, its whole, to 10; 'auto', the default, is the deepest that gives no more than `spheres`. */
  readonly level?: number | 'auto';
  /** How much two spheres may overlap, in parts of the smaller radius: -4 to 1, by default 0. A negative number keeps them apart. */
  readonly overlap?: number;
  /** Radius of the smallest spheres in diagonals. 'auto', the default, goes by the voxels. Limbs and parts keep some spheres in any case. */
  readonly smallestRadius?: number | 'auto';
  /**
   * Ellipsoids in the place of spheres, which keep their whole length straight, as bones do (§2.4): 'straight' where the skeleton's branches
   * are, or between pairs of ends inside the model, each as thick as there is room.
   */
  readonly bones?: 'none' | 'straight' | readonly (readonly [Vec3, Vec3])[];
  /** For each vertex the density of centers around it, relative to 1: higher where detail will be moved. */
  readonly density?: ArrayLike<number>;
  readonly signal?: AbortSignal;
  /** Called with the part done, 0 to 1. */
  readonly onProgress?: (part: number) => void;
  /** Called for each warning: something worked, but perhaps not as meant. */
  readonly onWarning?: (warning: BakeWarning) => void;
}

/** `message` and `remedy` are written to be shown to people, `code` is stable and made for programs. */
export interface BakeWarning {
  readonly code: WarningCode;
  readonly message: string;
  readonly remedy: string;
  readonly culprit?: Culprit | undefined;
  /** Where it is worst, in the model's units. */
  readonly at?: Vec3 | undefined;
}

export type Vec3 = readonly [number, number, number];

/** Where a handle sits (a vertex, or any point inside) and what it sets: its position, or its rotation and scale as well. */
export type Handle = ({ readonly vertex: number } | { readonly at: Vec3 }) & { readonly kind?: 'position' | 'rotation' };

export interface IrbfOptions {
  /**
   * Any radial kernel of scattered interpolation, or a function of s = d/width. Kernels are divided by their sum over the centers, so
   * kernels that change sign may be refused.
   */
  readonly kernel?: IrbfKernel | KernelFunction;
  /**
   * The kernel's width h, in mean spacings of the centers. Smaller is more local. 'auto', the default, is the body's `smoothLength`, and two
   * spacings at least: kernels about one limb hardly reach the next, and a body without limbs bends as one.
   */
  readonly relativeWidth?: number | 'auto';
  /**
   * λ of eq. (10): larger is smoother, smaller follows the spheres' shapes more closely. 'auto', the default, is 3e-4 Σ w‖Δφ‖² over all
   * centers and spheres' edges, so that a function costs the same part of the spheres' energy however many centers make it up.
   */
  readonly smoothness?: number | 'auto';
  /** 'soft' weighs the handles' misses by μ (appendix); 'hard' meets every target exactly (§4.6). */
  readonly constraints?: 'soft' | 'hard';
  /** μ: the weight of an anchor relative to a sphere's edge. */
  readonly anchorWeight?: number;
  /**
   * α of eq. (8), the exponent of the edge length in a sphere's weight. The paper's −1 lets small spheres resist as much as large ones. With
   * 1 a row of spheres resists being stretched as the limb that they fill does, by its section, and with 3 being bent, by the fourth power
   * of its radius; the default, 2, lies between.
   */
  readonly edgeExponent?: number;
  /**
   * How much rigid spheres resist a change of volume, as the Poisson ratio of an elastic body: 0, the paper's eq. (8), to 0.499. The energy is
   * that of fixed corotated elasticity (Stomakhin et al. 2012): Σ w (‖F − R‖² + ν/(1 − 2ν) (det F − 1)²).
   */
  readonly poissonRatio?: number;
  /** Of 'compact-inverse-multiquadric': where it ends, in widths. */
  readonly support?: number;
  /** Of 'polyharmonic': the order of the Laplacian that it solves, 2 or more. */
  readonly order?: number;
  /** Arithmetic of `deform`: 16-bit fixed point, to some 1e-5 of the diagonal, or float, the reference, which takes twice as long. */
  readonly precision?: 'fixed' | 'float';
  /** What spheres keep: 'rigid' their size and shape (eq. (8)), 'similarity' their shape only (§4.5), so that handles may scale the model. */
  readonly sphereFit?: 'rigid' | 'similarity';
  /**
   * The points by which a sphere feels how it is deformed (Fig. 7): the paper's six, 'octahedron', feel what is linear; twelve about the
   * center, 'icosahedron', also what bends it, and so keep large spheres better in shape. Ellipsoids have 32 in any case.
   */
  readonly structure?: 'octahedron' | 'icosahedron';
  /** Called by `setHandles` where handles leave something free. By default it goes to the console. */
  readonly onWarning?: (warning: IrbfWarning) => void;
}

/** What a deformation does all the same, and its user should know. */
export interface IrbfWarning {
  /** Three or more handles, none of which turns, stand on one line: turning about it is free. */
  readonly code: 'twist-free';
  readonly message: string;
  readonly remedy: string;
}

export type IrbfKernel = Exclude<KernelName, 'clamped-plate'>;

export interface SolveOptions {
  readonly maxIterations?: number;
  /** Stop when no sphere edge moves more than this part of the model's diagonal in one iteration. */
  readonly tolerance?: number;
  /** False for plain local/global iterations, to compare with: some hundred times as many are needed. */
  readonly accelerate?: boolean;
}

export interface SolveReport {
  /** Eq. (10) in solver space, with the misfit of soft constraints. */
  readonly energy: number;
  /** Largest distance between a handle's image and its target, model units. */
  readonly anchorError: number;
  readonly change: number;
  readonly iterations: number;
  readonly converged: boolean;
}

/** How a deformation treats volume and shape (paper 001, §5), and the condition of the equations. */
export interface IrbfReport extends SolveReport {
  /** λ, as given or as chosen. */
  readonly smoothness: number;
  /** The kernel's width in mean spacings of the centers, as given or as chosen; 0 for a kernel without a width. */
  readonly relativeWidth: number;
  /** Of the body, as given or as chosen when it was baked. */
  readonly centers: number;
  readonly spheres: number;
  readonly voxels: number;
  /** Estimated 1-norm condition number of the equations. With interior distances no theorem bounds it. */
  readonly condition: number;
  /**
   * The most by which a basis function inside the body leaves the range that it has on the surface, over that range; 0 where the maximum
   * principle holds.
   */
  readonly maximumPrinciple: number;
  /** Volume of the deformed shape over that at rest. */
  readonly volumeRatio: number;
  /** Σ and largest of A min ‖df − R‖² over the tetrahedra, A their volumes: model units cubed. */
  readonly distortion: { readonly total: number; readonly max: number };
  /** Tetrahedra turned inside out. */
  readonly flips: number;
  /** How many were measured: those given, or six per voxel. */
  readonly tetrahedra: number;
}
