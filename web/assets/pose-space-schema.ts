/**
 * HANDLEBODY_pose_space as it stands in a file, on a mesh: where in a pose space its morph targets' weights lie. Format version 1:
 *
 *   "extensions": { "HANDLEBODY_pose_space": {
 *     "version": 1,
 *     "dimensions": [ { "name": "valence", "min": -1, "max": 1 }, … ],
 *     "examples": [
 *       { "name": "happy", "at": [0.83, 0.53], "weights": [one a morph target] },
 *       { "name": "sad", "at": [-0.65, -0.27], "target": 4 }, …           a morph target of its own, the other weights being 0
 *     ]
 *   } }
 *
 * The extension is optional: viewers that do not know it show the mesh with its own weights.
 */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { asObject, isNumber, show } from './gltf-json.ts';

/** The format that is written and read. */
export const POSE_SPACE_VERSION = 1;

/** A pose space as files have it. */
export interface StoredPoseSpace<Example> {
  readonly version: typeof POSE_SPACE_VERSION;
  readonly dimensions: readonly { readonly name: string; readonly min: number; readonly max: number }[];
  readonly examples: readonly (Example & {
    readonly name: string;
    /** One number a dimension. */
    readonly at: readonly number[];
  })[];
}

/** Examples of a pose space over a mesh's morph targets; `weights`: one a morph target. `target`: the one that the example is. */
export type PoseSpaceData = StoredPoseSpace<{ readonly weights: readonly number[]; readonly target?: number }>;

/** A pose space to be stored: for each example, weights or a target, which counts when there are both. */
export type PoseSpaceInput = StoredPoseSpace<{ readonly weights?: readonly number[]; readonly target?: number }>;

/**
 * Checks a pose space from the extension's JSON. `targetCount` is how many morph targets the mesh has.
 *
 * Throws 'file-unsupported' for an unknown version, otherwise 'file-invalid' or, naming an example, 'example-shape-mismatch' or
 * 'example-not-finite'.
 */
export function parsePoseSpace(json: unknown, { targetCount }: { targetCount: number }): PoseSpaceData {
  const space = asObject(json) ?? {};
  if (space.version !== POSE_SPACE_VERSION) {
    throw new HandlebodyError('file-unsupported', {
      message: `The pose space has format version ${show(space.version)}; this release reads version ${POSE_SPACE_VERSION}.`,
      remedy: 'Export the pose space again with this release, or update Handlebody.',
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
    const { name, at: place, weights, target } = asObject(entry) ?? {};
    if (typeof name !== 'string') throw poseInvalid(`has no name for example ${index}`);
    const at = exampleNumbers(place, { index, name, what: 'place', expected: dimensions.length });
    if (target === undefined) {
      return { name, at, weights: exampleNumbers(weights, { index, name, what: 'row of weights', expected: targetCount }) };
    }
    if (weights !== undefined) throw poseInvalid(`gives example ${index} both weights and a target`);
    if (!Number.isInteger(target) || (target as number) < 0 || (target as number) >= targetCount) {
      throw new HandlebodyError('example-shape-mismatch', {
        message: `Example "${name}" is morph target ${show(target)} of a mesh that has ${targetCount}.`,
        remedy: 'Name a morph target of the mesh by its number, from 0.',
        culprit: { kind: 'example', index },
      });
    }
    const row = Array.from({ length: targetCount }, (_, i) => (i === target ? 1 : 0));
    return { name, at, weights: row, target: target as number };
  });
  return { version: POSE_SPACE_VERSION, dimensions, examples };
}

/** What the file is to have. */
export function poseSpaceDefinition({ version, dimensions, examples }: PoseSpaceInput): PoseSpaceInput {
  return {
    version,
    dimensions,
    examples: examples.map(({ name, at, weights, target }) => ({
      name,
      at,
      ...(target !== undefined ? { target } : weights && { weights }),
    })),
  };
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

function poseInvalid(what: string): HandlebodyError {
  return new HandlebodyError('file-invalid', {
    message: `The pose space ${what}.`,
    remedy: 'The file is damaged or was edited: export the pose space again.',
  });
}
