/**
 * HANDLEBODY_body as it stands in a file, format version 2, and the checks that turn what a file says into data to be trusted. Needs
 * neither glTF-Transform nor three.js: both readers use it.
 *
 *   "extensions": { "HANDLEBODY_body": {
 *     "version": 2,
 *     "distance": "fast-marching",
 *     "positionsHash": "0123456789abcdef",
 *     "normalization": { "center": [x, y, z], "diagonal": d },
 *     "grid": { "origin": [x, y, z], "spacing": h, "dimensions": [nx, ny, nz] },
 *     "distanceScale": s,
 *     "smoothLength": l,
 *     "handles": [ { "name": "Nose", "vertex": 120 }, { "name": "Chest", "at": [x, y, z] }, … ],    optional: where it wants to be held
 *     "reading": { "skipped": [part, …], "morphs": { part: [weight, …] }, "skins": { part: [16 numbers] }, "origin": [x, y, z] },    optional: see `MeshReading`
 *     "arraysHash": "0123456789abcdef",      of the arrays below in this order, distances decompressed
 *     "voxels": accessor,      unsigned int SCALAR: the inside voxels as runs, see `voxel-runs.ts`
 *     "centers": accessor,     unsigned int SCALAR: vertices
 *     "order": accessor,       unsigned int SCALAR: the center that the k-th stored row of distances is of
 *     "distances": accessor,   unsigned byte SCALAR: compressed, see `predict-distances.ts`
 *     "spheres": accessor,     float VEC4: center xyz, radius
 *     "sphereAxes": accessor,  float VEC3, optional: half the long axis of one that is an ellipsoid, or 0
 *     "skeletonNodes": accessor, "skeletonBranches": accessor, "sphereBranches": accessor    optional: see `body-skeleton.ts`
 *   } }
 *
 * Solver space is scene space after node transforms, scaled to a unit diagonal; vertices are numbered through the triangle primitives of
 * the default scene in order, or through its points when it has no triangles. Version 1 had neither smooth length nor skeleton, and is
 * still read, and written again as it was. The extension is optional: viewers that do not know it
 * show the model as it is.
 *
 * Functions here throw a `Fault`, by the name of the code that it has in words.
 */
import { hashPositions } from '../../wasm/ts/hash.ts';
import type { BodyData, DistanceMethod, Mesh, MeshReading, NamedHandle } from '../../wasm/ts/types.ts';
import { checkSkeleton } from './body-skeleton.ts';
import { Fault } from './fault.ts';
import { asObject, isNumber } from './gltf-json.ts';
import { countInRuns } from './voxel-runs.ts';

/** Root extension: the baked interior of the default scene. */
export const HANDLEBODY_BODY = 'HANDLEBODY_body';
/** Mesh extension: places of morph-target weights in a pose space. */
export const HANDLEBODY_POSE_SPACE = 'HANDLEBODY_pose_space';

/** The format that is written; all up to it are read. */
export const BODY_VERSION = 2;

const METHODS = ['fast-marching', 'euclidean', 'heat', 'mean-value'];

/** What a body says besides its arrays. Lengths of `grid` and `distanceScale` are in solver space, see `BodyData`. */
type BodyHeader = Pick<
  BodyData,
  'version' | 'distance' | 'positionsHash' | 'normalization' | 'grid' | 'distanceScale' | 'smoothLength' | 'handles'
> &
  Pick<Mesh, 'reading'>;

/** The same in a file. */
export interface StoredHeader extends BodyHeader {
  readonly arraysHash: string;
}

/** The arrays of a body, as its accessors hold them. */
export interface StoredArrays {
  readonly voxels: Uint32Array;
  readonly centers: Uint32Array;
  readonly order: Uint32Array;
  readonly distances: Uint8Array;
  readonly spheres: Float32Array;
  readonly sphereAxes?: Float32Array;
  readonly skeletonNodes?: Float32Array;
  readonly skeletonBranches?: Uint32Array;
  readonly sphereBranches?: Uint32Array;
}

/** Accessor names in the extension's JSON, their types and component types. */
export const BODY_ACCESSORS = {
  voxels: { type: 'SCALAR', array: Uint32Array },
  centers: { type: 'SCALAR', array: Uint32Array },
  order: { type: 'SCALAR', array: Uint32Array },
  distances: { type: 'SCALAR', array: Uint8Array },
  spheres: { type: 'VEC4', array: Float32Array },
  sphereAxes: { type: 'VEC3', array: Float32Array, optional: 'alone' },
  skeletonNodes: { type: 'VEC4', array: Float32Array, optional: 'skeleton' },
  skeletonBranches: { type: 'SCALAR', array: Uint32Array, optional: 'skeleton' },
  sphereBranches: { type: 'SCALAR', array: Uint32Array, optional: 'skeleton' },
} as const;

/** Bodies of more voxels or codes (an eighth and a quarter of a gigabyte) are neither written nor read. */
const MAX_VOXELS = 1 << 25;
const MAX_CODES = 1 << 27;
/** meshoptimizer's codec writes a byte at least for 256 vertices, which are 512 codes: no sound stream holds more. */
const CODES_PER_BYTE = 512;

/**
 * Reads a body's numbers from the extension's JSON.
 *
 * Throws 'body-version' for a format that this release does not know, 'body-invalid' for anything else.
 */
export function parseBodyHeader(json: unknown): BodyHeader {
  const body = asObject(json) ?? {};
  const { version } = body;
  if (version !== 1 && version !== BODY_VERSION) throw new Fault('body-version', [version, BODY_VERSION]);
  const normalization = asObject(body.normalization) ?? {};
  const grid = asObject(body.grid) ?? {};
  const header = {
    version: version as 1 | typeof BODY_VERSION,
    distance: body.distance as DistanceMethod,
    positionsHash: body.positionsHash as string,
    normalization: {
      center: triple(normalization.center, 'normalization.center'),
      diagonal: positive(normalization.diagonal, 'normalization.diagonal'),
    },
    grid: {
      origin: triple(grid.origin, 'grid.origin'),
      spacing: positive(grid.spacing, 'grid.spacing'),
      dimensions: triple(grid.dimensions, 'grid.dimensions'),
    },
    distanceScale: body.distanceScale as number,
    ...(version !== 1 && { smoothLength: (body.smoothLength ?? 0) as number }),
    ...(body.handles !== undefined && { handles: namedHandles(body.handles) }),
    // Who reads the scene again looks into it.
    ...(body.reading !== undefined && { reading: body.reading as MeshReading }),
  };
  if (!METHODS.includes(header.distance)) throw new Fault('method', [body.distance]);
  if (typeof header.positionsHash !== 'string' || header.positionsHash === '') throw new Fault('hash');
  if (!isNumber(header.distanceScale) || header.distanceScale < 0) throw new Fault('scale');
  if (header.smoothLength !== undefined && !(isNumber(header.smoothLength) && header.smoothLength >= 0))
    throw new Fault('smooth-length');
  const cells = header.grid.dimensions.reduce((product, n) => product * (Number.isInteger(n) && n > 0 ? n : 0), 1);
  if (cells < 1 || cells > 0xffff_ffff) throw new Fault('grid', [header.grid.dimensions]);
  return header;
}

/** What a body says besides its arrays, checked: what both writers put into a file. Throws as `parseBodyHeader` does. */
export function headerOf(body: BodyData): BodyHeader {
  const { version, distance, positionsHash, normalization, grid, distanceScale, smoothLength, handles } = body;
  const { reading } = body.mesh;
  return parseBodyHeader({ version, distance, positionsHash, normalization, grid, distanceScale, smoothLength, handles, reading });
}

/** More than these cannot be told apart. */
const MAX_HANDLES = 1000;

function namedHandles(json: unknown): NamedHandle[] {
  if (!Array.isArray(json) || json.length > MAX_HANDLES) throw new Fault('handles', [MAX_HANDLES]);
  return json.map((entry, i) => {
    const { name, vertex, at } = asObject(entry) ?? {};
    if (typeof name !== 'string') throw new Fault('handle-name', [i]);
    if (vertex === undefined) return { name, at: triple(at, `handles[${i}].at`) };
    if (isNumber(vertex) && Number.isInteger(vertex) && vertex >= 0) return { name, vertex };
    throw new Fault('handle-vertex', [i, vertex]);
  });
}

/** The same out of a file, with the hash of the arrays. */
export function parseStoredHeader(json: unknown): StoredHeader {
  const header = parseBodyHeader(json);
  const { arraysHash } = asObject(json) ?? {};
  if (typeof arraysHash !== 'string') throw new Fault('arrays-hash');
  return { ...header, arraysHash };
}

/**
 * Checks arrays out of a file as far as can be without the mesh, above all the sizes that they ask to be allocated.
 *
 * Throws 'body-invalid'.
 */
export function checkStored(arrays: { readonly [name in keyof StoredArrays]?: unknown }, { grid }: BodyHeader): StoredArrays {
  const skeleton = arrays.skeletonNodes !== undefined;
  for (const [name, { array, ...rest }] of Object.entries(BODY_ACCESSORS)) {
    const given = arrays[name as keyof StoredArrays];
    const optional = 'optional' in rest && (rest.optional === 'alone' || !skeleton);
    if (given instanceof array || (given === undefined && optional)) continue;
    throw new Fault('array', [name]);
  }
  const stored = arrays as StoredArrays;
  const { centers, order, distances } = stored;
  const voxels = countInRuns(stored.voxels, gridSize(grid));
  if (Number.isNaN(voxels)) throw new Fault('runs');
  checkCount(voxels, centers.length);
  if (voxels * centers.length > CODES_PER_BYTE * distances.length) {
    throw new Fault('few', [distances.length, centers.length, voxels]);
  }
  const seen = new Uint8Array(centers.length);
  for (const center of order) {
    if (center >= seen.length || seen[center] === 1) throw new Fault('twice');
    seen[center] = 1;
  }
  if (order.length !== centers.length) throw new Fault('lacking');
  return stored;
}

/**
 * Checks that the arrays of a body fit each other and its mesh.
 *
 * Throws 'body-invalid' when they contradict each other, 'body-mismatch' when the body was baked for another mesh.
 */
export function checkBody(body: Omit<BodyData, 'distances'> & { readonly distances?: Uint16Array }): void {
  const { voxels, centers, distances, spheres, grid, mesh } = body;
  for (const [name, array] of Object.entries({ voxels: Uint32Array, centers: Uint32Array, spheres: Float64Array })) {
    if (!(body[name as 'voxels'] instanceof array)) throw new Fault('array', [name]);
  }
  checkCount(voxels.length, centers.length);
  if ('distances' in body && (!(distances instanceof Uint16Array) || distances.length !== centers.length * voxels.length)) {
    throw new Fault('distances', [distances?.length, centers.length, voxels.length]);
  }
  const end = gridSize(grid);
  for (let i = 0, previous = -1; i < voxels.length; i++) {
    const voxel = voxels[i] as number;
    if (voxel <= previous || voxel >= end) throw new Fault('voxel', [voxel]);
    previous = voxel;
  }
  // Before the centers: a body of another mesh is likely to name vertices that this one has not, and that is the better story.
  if (hashPositions(mesh.positions) !== body.positionsHash) {
    throw new Fault('body-other');
  }
  const vertices = mesh.positions.length / 3;
  const stray = centers.find((vertex) => vertex >= vertices);
  if (stray !== undefined) throw new Fault('center', [stray, vertices]);
  const lost = body.handles?.find((handle) => 'vertex' in handle && handle.vertex >= vertices);
  if (lost) throw new Fault('handle-lost', [lost.name]);
  if (spheres.length % 4 !== 0 || spheres.some((x, i) => !Number.isFinite(x) || (i % 4 === 3 && x < 0))) {
    throw new Fault('spheres');
  }
  const { sphereAxes } = body;
  if (sphereAxes && (4 * sphereAxes.length !== 3 * spheres.length || sphereAxes.some((x) => !Number.isFinite(x))))
    throw new Fault('sphere-axes', [spheres.length / 4]);
  if (body.skeleton) checkSkeleton(body.skeleton, spheres.length / 4);
}

function gridSize({ dimensions: [nx, ny, nz] }: BodyData['grid']): number {
  return nx * ny * nz;
}

function checkCount(voxels: number, centers: number): void {
  if (voxels === 0 || centers === 0) throw new Fault('empty');
  if (voxels > MAX_VOXELS || voxels * centers > MAX_CODES) {
    throw new Fault('most', [centers, voxels, MAX_VOXELS, MAX_CODES]);
  }
}

function triple(value: unknown, name: string): [number, number, number] {
  if (!Array.isArray(value) || value.length !== 3 || !value.every(isNumber)) throw new Fault('triple', [name]);
  return [value[0] as number, value[1] as number, value[2] as number];
}

function positive(value: unknown, name: string): number {
  if (!isNumber(value) || value <= 0) throw new Fault('positive', [name]);
  return value;
}
