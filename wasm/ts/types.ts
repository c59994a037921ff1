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
  readonly version: 1;
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
  /** Where the model wants to be held, by name; `bake` names none. */
  readonly handles?: readonly NamedHandle[];
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
  /** How many IRBF centers to sample, farthest first. */
  readonly centers?: number;
  readonly distance?: DistanceMethod;
  /** Voxels along the longest side of the bounding box. A voxel volume brings its own. */
  readonly resolution?: number;
  /** Most spheres to fill the volume with. */
  readonly spheres?: number;
  /** Spheres along the skeleton, or from an octree: spread over the volume, more alike. */
  readonly packing?: 'skeleton' | 'tree';
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
  /** The kernel's width h, in mean spacings of the centers. Smaller is more local. */
  readonly relativeWidth?: number;
  /**
   * λ of eq. (10): larger is smoother, smaller follows the spheres' shapes more closely. 'auto' chooses it from the body: coefficients as large
   * as the model cost a fixed part of what collapsing every sphere would, whatever the number of spheres and centers and the model's size.
   */
  readonly smoothness?: number | 'auto';
  /** 'soft' weighs the handles' misses by μ (appendix); 'hard' meets every target exactly (§4.6). */
  readonly constraints?: 'soft' | 'hard';
  /** μ: the weight of an anchor relative to a sphere's edge. */
  readonly anchorWeight?: number;
  /** α of eq. (8), the exponent of the edge length in a sphere's weight: −1 lets small spheres count as much as large ones. */
  readonly edgeExponent?: number;
  /** Of 'compact-inverse-multiquadric': where it ends, in widths. */
  readonly support?: number;
  /** Of 'polyharmonic': the order of the Laplacian that it solves, 2 or more. */
  readonly order?: number;
  /** Arithmetic of `deform`: 16-bit fixed point, to some 1e-5 of the diagonal, or float, the reference, which takes twice as long. */
  readonly precision?: 'fixed' | 'float';
  /** What spheres keep: 'rigid' their size and shape (eq. (8)), 'similarity' their shape only (§4.5), so that handles may scale the model. */
  readonly sphereFit?: 'rigid' | 'similarity';
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
