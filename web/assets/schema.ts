/**
 * The two extensions of Handlebody as they stand in a file's JSON, and the checks that turn what a file says into data to be trusted.
 * Needs neither glTF-Transform nor three.js: both readers use it.
 */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { hashPositions } from '../../wasm/ts/hash.ts';
import type { BodyData, Mesh } from '../../wasm/ts/types.ts';
import { type GltfJson, isObject } from './gltf-json.ts';

/** Root extension: the baked interior of the default scene. */
export const HANDLEBODY_BODY = 'HANDLEBODY_body';
/** Mesh extension: places of morph-target weights in a pose space. */
export const HANDLEBODY_POSE_SPACE = 'HANDLEBODY_pose_space';

/** What a body says besides its arrays. Lengths of `grid` and `distanceScale` are in solver space, see `BodyData`. */
export type BodyHeader = Pick<BodyData, 'version' | 'positionsHash' | 'normalization' | 'grid' | 'distanceScale'>;

/** The arrays of a body, as its accessors hold them. */
export interface BodyArrays {
  readonly voxels: Uint32Array;
  readonly centers: Uint32Array;
  readonly distances: Uint16Array;
  /** spheres × 4: center xyz, radius. */
  readonly spheres: Float32Array | Float64Array;
}

/** Accessor names in the extension's JSON, their types and component types: unsigned int, unsigned short, float. */
export const BODY_ACCESSORS = {
  voxels: { type: 'SCALAR', array: Uint32Array },
  centers: { type: 'SCALAR', array: Uint32Array },
  distances: { type: 'SCALAR', array: Uint16Array },
  spheres: { type: 'VEC4', array: Float32Array },
} as const;

/** Examples of a pose space over a mesh's morph targets. */
export interface PoseSpaceData {
  readonly version: 0;
  readonly dimensions: readonly { readonly name: string; readonly min: number; readonly max: number }[];
  /** `at`: one number a dimension; `weights`: one a morph target. */
  readonly examples: readonly { readonly name: string; readonly at: readonly number[]; readonly weights: readonly number[] }[];
}

/**
 * Reads a body's numbers from the extension's JSON.
 *
 * Throws 'body-version' for a format that this release does not know, 'body-invalid' for anything else.
 */
export function parseBodyHeader(json: unknown): BodyHeader {
  const body = asObject(json) ?? {};
  if (body.version !== 0) {
    throw new HandlebodyError('body-version', {
      message: `The baked body has format version ${JSON.stringify(body.version)}; this release reads version 0.`,
      remedy: 'Bake the model again with this release, or update Handlebody.',
    });
  }
  const normalization = asObject(body.normalization) ?? {};
  const grid = asObject(body.grid) ?? {};
  const header = {
    version: 0 as const,
    positionsHash: body.positionsHash as string,
    normalization: { center: triple(normalization.center, 'center'), diagonal: positive(normalization.diagonal, 'diagonal') },
    grid: {
      origin: triple(grid.origin, 'origin'),
      spacing: positive(grid.spacing, 'spacing'),
      dimensions: triple(grid.dimensions, 'dimensions'),
    },
    distanceScale: body.distanceScale as number,
  };
  if (typeof header.positionsHash !== 'string' || header.positionsHash === '') throw bodyInvalid('has no hash of its positions');
  if (!isNumber(header.distanceScale) || header.distanceScale < 0) throw bodyInvalid('has no distance scale');
  const voxels = header.grid.dimensions.reduce((product, n) => product * (Number.isInteger(n) && n > 0 ? n : 0), 1);
  if (voxels < 1 || voxels > 0xffff_ffff) throw bodyInvalid(`has a grid of ${header.grid.dimensions.join('×')} voxels`);
  return header;
}

/**
 * Puts a body together and checks that its arrays fit each other and the mesh.
 *
 * Throws 'body-invalid' when they contradict each other, 'body-mismatch' when the body was baked for another mesh.
 */
export function assembleBody({ header, arrays, mesh }: { header: BodyHeader; arrays: BodyArrays; mesh: Mesh }): BodyData {
  const { voxels, centers, distances } = arrays;
  for (const [name, { array }] of Object.entries(BODY_ACCESSORS)) {
    const given: unknown = arrays[name as keyof BodyArrays];
    if (given instanceof array || (name === 'spheres' && given instanceof Float64Array)) continue;
    throw bodyInvalid(`has no ${name}, or not as numbers of the right type`);
  }
  if (voxels.length === 0 || centers.length === 0) throw bodyInvalid('is empty');
  if (distances.length !== centers.length * voxels.length) {
    throw bodyInvalid(`has ${distances.length} distances for ${centers.length} centers × ${voxels.length} voxels`);
  }
  const end = header.grid.dimensions.reduce((product, n) => product * n, 1);
  for (let i = 0, previous = -1; i < voxels.length; i++) {
    const voxel = voxels[i] as number;
    if (voxel <= previous || voxel >= end) throw bodyInvalid(`has voxel ${voxel} out of order or outside its grid`);
    previous = voxel;
  }
  // Before the centers: a body of another mesh is likely to name vertices that this one has not, and that is the better story.
  if (hashPositions(mesh.positions) !== header.positionsHash) {
    throw new HandlebodyError('body-mismatch', {
      message: 'The interior distances were baked for other vertex positions than this model has.',
      remedy: 'Bake the model again after its last change: bake last.',
    });
  }
  const vertices = mesh.positions.length / 3;
  const stray = centers.find((vertex) => vertex >= vertices);
  if (stray !== undefined) throw bodyInvalid(`has a center on vertex ${stray} of ${vertices}`);
  const spheres = Float64Array.from(arrays.spheres);
  if (spheres.length % 4 !== 0 || spheres.some((x, i) => !Number.isFinite(x) || (i % 4 === 3 && x < 0))) {
    throw bodyInvalid('has spheres that are not four finite numbers each');
  }
  return { ...header, mesh, voxels, centers, distances, spheres };
}

/**
 * Reads a pose space from the extension's JSON. `targetCount` is how many morph targets the mesh has.
 *
 * Throws 'file-unsupported' for an unknown version, otherwise 'file-invalid' or, naming an example, 'example-shape-mismatch' or
 * 'example-not-finite'.
 */
export function parsePoseSpace(json: unknown, { targetCount }: { targetCount: number }): PoseSpaceData {
  const space = asObject(json) ?? {};
  if (space.version !== 0) {
    throw new HandlebodyError('file-unsupported', {
      message: `The pose space has format version ${JSON.stringify(space.version)}; this release reads version 0.`,
      remedy: 'Update Handlebody, or export the pose space again with this release.',
    });
  }
  if (!Array.isArray(space.dimensions) || space.dimensions.length === 0 || !Array.isArray(space.examples)) {
    throw poseInvalid('lists no dimensions or no examples');
  }
  const dimensions = space.dimensions.map((entry) => {
    const { name, min, max } = asObject(entry) ?? {};
    if (typeof name !== 'string' || !isNumber(min) || !isNumber(max) || min >= max) {
      throw poseInvalid('has a dimension without a name, or whose minimum is not below its maximum');
    }
    return { name, min, max };
  });
  if (new Set(dimensions.map((d) => d.name)).size < dimensions.length) throw poseInvalid('uses one name for two dimensions');
  const examples = space.examples.map((entry, index) => {
    const { name, at, weights } = asObject(entry) ?? {};
    if (typeof name !== 'string') throw poseInvalid(`has no name for example ${index}`);
    return {
      name,
      at: exampleNumbers(at, { index, name, what: 'place', expected: dimensions.length }),
      weights: exampleNumbers(weights, { index, name, what: 'row of weights', expected: targetCount }),
    };
  });
  return { version: 0, dimensions, examples };
}

function exampleNumbers(value: unknown, of: { index: number; name: string; what: string; expected: number }): number[] {
  const culprit = { kind: 'example', index: of.index } as const;
  if (!Array.isArray(value) || value.length !== of.expected) {
    throw new HandlebodyError('example-shape-mismatch', {
      message: `The ${of.what} of example "${of.name}" needs ${of.expected} numbers and has ${Array.isArray(value) ? value.length : 'none'}.`,
      remedy: 'Give one number a dimension for its place, and one weight for each morph target of the mesh.',
      culprit,
    });
  }
  if (!value.every(isNumber)) {
    throw new HandlebodyError('example-not-finite', {
      message: `The ${of.what} of example "${of.name}" is not made of finite numbers.`,
      remedy: 'Export the pose space again.',
      culprit,
    });
  }
  return [...value];
}

function asObject(value: unknown): GltfJson | undefined {
  return isObject(value) ? value : undefined;
}

function isNumber(value: unknown): value is number {
  return typeof value === 'number' && Number.isFinite(value);
}

function triple(value: unknown, name: string): [number, number, number] {
  if (!Array.isArray(value) || value.length !== 3 || !value.every(isNumber)) throw bodyInvalid(`has no ${name} of three numbers`);
  return [value[0] as number, value[1] as number, value[2] as number];
}

function positive(value: unknown, name: string): number {
  if (!isNumber(value) || value <= 0) throw bodyInvalid(`has no ${name} above zero`);
  return value;
}

function bodyInvalid(what: string): HandlebodyError {
  return new HandlebodyError('body-invalid', {
    message: `The baked body ${what}.`,
    remedy: 'The file is damaged or was edited: bake the model again.',
  });
}

function poseInvalid(what: string): HandlebodyError {
  return new HandlebodyError('file-invalid', {
    message: `The pose space ${what}.`,
    remedy: 'The file is damaged or was edited: export the pose space again.',
  });
}
