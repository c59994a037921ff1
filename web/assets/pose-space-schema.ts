/**
 * HANDLEBODY_pose_space as it stands in a file, on a mesh: where in a pose space its morph targets' weights lie. Format version 1:
 *
 *   "extensions": { "HANDLEBODY_pose_space": {
 *     "version": 1,
 *     "dimensions": [ { "name": "valence", "min": -1, "max": 1 }, … ],       and "scale": what counts as 1 in distances; 1 where left out
 *     "examples": [
 *       { "name": "happy", "at": [0.83, 0.53], "weights": [one a morph target] },
 *       { "name": "sad", "at": [-0.65, -0.27], "target": 4 }, …           a morph target of its own, the other weights being 0
 *     ]
 *   } }
 *
 * The extension is optional: viewers that do not know it show the mesh with its own weights.
 */
import { Fault } from './fault.ts';
import { asObject, isNumber } from './gltf-json.ts';

/** The format that is written and read. */
export const POSE_SPACE_VERSION = 1;

/** An example that names a target takes a row of weights all the same: of more than these a small file would make a large one. */
const MOST_WEIGHTS = 1 << 20;

/** A pose space as files have it. */
export interface StoredPoseSpace<Example> {
  readonly version: typeof POSE_SPACE_VERSION;
  readonly dimensions: readonly {
    readonly name: string;
    readonly min: number;
    readonly max: number;
    /** What counts as 1 in distances, finite and above 0; 1 where it is left out. */
    readonly scale?: number;
  }[];
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
 * Throws a `Fault`: in words 'file-unsupported' for an unknown version, otherwise 'file-invalid' or, naming an example,
 * 'example-shape-mismatch' or 'example-not-finite'.
 */
export function parsePoseSpace(json: unknown, { targetCount }: { targetCount: number }): PoseSpaceData {
  const space = asObject(json) ?? {};
  if (space.version !== POSE_SPACE_VERSION) {
    throw new Fault('pose-version', [space.version, POSE_SPACE_VERSION]);
  }
  if (!Array.isArray(space.dimensions) || space.dimensions.length === 0) throw new Fault('pose-lists', ['dimensions']);
  if (!Array.isArray(space.examples)) throw new Fault('pose-lists', ['examples']);
  const dimensions = space.dimensions.map((entry, i) => {
    const { name, min, max, scale } = asObject(entry) ?? {};
    if (typeof name !== 'string' || !isNumber(min) || !isNumber(max) || min >= max) {
      throw new Fault('pose-dimension', [`dimensions[${i}]`]);
    }
    if (scale === undefined) return { name, min, max };
    if (!isNumber(scale) || scale <= 0) throw new Fault('pose-scale', [scale, `dimensions[${i}].scale`]);
    return { name, min, max, scale };
  });
  if (new Set(dimensions.map((d) => d.name)).size < dimensions.length) throw new Fault('pose-names', ['dimensions']);
  const targets = space.examples.filter((entry) => asObject(entry)?.target !== undefined).length;
  if (targets * targetCount > MOST_WEIGHTS) throw new Fault('pose-many', [targets, targetCount, MOST_WEIGHTS]);
  const examples = space.examples.map((entry, index) => {
    const { name, at: place, weights, target } = asObject(entry) ?? {};
    if (typeof name !== 'string') throw new Fault('pose-example', [`examples[${index}].name`]);
    const at = exampleNumbers(place, { index, name, what: 'place', key: 'at', expected: dimensions.length });
    if (target === undefined) {
      return {
        name,
        at,
        weights: exampleNumbers(weights, { index, name, what: 'row of weights', key: 'weights', expected: targetCount }),
      };
    }
    if (weights !== undefined) throw new Fault('pose-both', [`examples[${index}]`]);
    if (!Number.isInteger(target) || (target as number) < 0 || (target as number) >= targetCount) {
      throw new Fault('pose-target', [name, target, targetCount, `examples[${index}].target`], { example: index });
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

function exampleNumbers(
  value: unknown,
  of: { index: number; name: string; what: string; key: string; expected: number },
): number[] {
  const where = `examples[${of.index}].${of.key}`;
  if (!Array.isArray(value) || value.length !== of.expected) {
    throw new Fault('pose-count', [of.what, of.name, of.expected, value, where], { example: of.index });
  }
  if (!value.every(isNumber)) {
    throw new Fault('pose-numbers', [of.what, of.name, where], { example: of.index });
  }
  return [...value];
}
