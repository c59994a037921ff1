import {
  checkRoom,
  list,
  named,
  numbers,
  options,
  positive,
  type Read,
  type Readers,
  row,
  text,
  type Vector,
  whole,
} from './arguments.ts';
import { HandlebodyError } from './errors.ts';
import type { Heap } from './heap.ts';
import type { Owned } from './owned.ts';
import type { TypedArray } from './types.ts';

/** `cardinal`: radial basis functions with a polynomial tail. `normalized`: weights closer to [0, 1], but favors isolated examples. */
export type PoseSpaceMethod = 'cardinal' | 'normalized';

export type PoseSpaceKernel =
  | 'linear'
  | 'cubic'
  | 'thin-plate'
  | 'gaussian'
  | 'multiquadric'
  | 'inverse-multiquadric'
  | 'inverse-quadratic';

/** A shape and the place in the pose space where it belongs. */
export interface PoseExample {
  readonly name: string;
  /** One coordinate per dimension. */
  readonly at: ArrayLike<number>;
  /** A row of numbers, as long as every other example's: displacements (3 per vertex), parameters of a rig, anything that blends. */
  readonly shape: ArrayLike<number>;
}

/** A dimension of a pose space. */
export interface PoseDimension {
  readonly name: string;
  /** What counts as 1 in distances, finite and above 0 (default 1): they are those of coordinate / scale. */
  readonly scale?: number;
}

export interface PoseSpaceOptions {
  /** The dimensions, 1 to 64: a name each, or a name and a scale. */
  readonly dimensions: readonly (string | PoseDimension)[];
  readonly examples: readonly PoseExample[];
  readonly method?: PoseSpaceMethod;
  /** `'auto'`: multiquadric for cardinal, inverse-multiquadric for normalized. The normalized method takes no kernel that is 0 at r = 0. */
  readonly kernel?: PoseSpaceKernel | 'auto';
  /** In units of the dimensions' scales. `'auto'`: for each example a fixed part of the distance to its nearest neighbor. */
  readonly width?: number | 'auto';
  /** Polynomial tail. 1 makes weights reproduce linear functions, Σ wₖ(x) xₖ = x. `'auto'`: the lowest that the kernel allows. */
  readonly degree?: -1 | 0 | 1 | 'auto';
}

/**
 * Chosen so that weights stay close to [0, 1]: on Russell's plane with 16 to 22 expressions within −0.32 … 1.15 between the examples and
 * within −0.62 … 1.26 on the rest of the pad. Figures for the alternatives are in `core/posespace/pose_space.hpp`.
 */
export const POSE_SPACE_DEFAULTS = { method: 'cardinal', kernel: 'auto', width: 'auto', degree: 'auto' } as const;

/** By the solver's numbers. */
const METHODS: readonly PoseSpaceMethod[] = ['cardinal', 'normalized'];
const KERNELS: readonly PoseSpaceKernel[] = [
  'linear',
  'cubic',
  'thin-plate',
  'gaussian',
  'multiquadric',
  'inverse-multiquadric',
  'inverse-quadratic',
];
const NEEDS_LINEAR_TAIL: readonly PoseSpaceKernel[] = ['cubic', 'thin-plate'];

/** Places closer than this part of their extent on every axis count as one: the solver's own rule. */
const COINCIDENT = 1e-9;

/**
 * Examples in a pose space (2014 course, §2.2 and §3.4): at any point every example has a weight, 1 at its own place and 0 at the
 * others', smooth in between and summing to 1 everywhere; the shape there is the weighted sum of the examples' shapes.
 *
 * Distances are Euclidean, of coordinate / scale, but a dimension in which the examples span less than a thousandth of the widest counts as
 * spanning a thousandth: dimensions in units that have nothing in common are kept apart without scales too.
 *
 * ```ts
 * const space = hb.poseSpace({
 *   dimensions: ['valence', 'arousal'],
 *   examples: [
 *     { name: 'neutral', at: [0, 0], shape: neutral },
 *     { name: 'happy', at: [0.83, 0.53], shape: happy },
 *     { name: 'sad', at: [-0.65, -0.27], shape: sad },
 *   ],
 * });
 * space.evaluate([0.4, 0.2], positions);
 * ```
 */
export class PoseSpace {
  /** Names of the examples, in the order of the weights. */
  readonly names: readonly string[];
  readonly dimensions: readonly string[];
  /** Numbers in a shape. */
  readonly shapeLength: number;
  /** Examples left out because an earlier one has the same place and the same shape. */
  readonly merged: readonly { readonly name: string; readonly into: string }[];

  readonly #heap: Heap;
  readonly #query: number;
  readonly #weightsAt: number;
  readonly #weights: Float64Array;
  /** shapeLength × examples: all that one number of the result needs is contiguous. */
  readonly #shapes: Float64Array;
  readonly #scales: readonly number[];
  readonly #owned: Owned;

  /** @internal Use `Handlebody.poseSpace`. */
  constructor(heap: Heap, given: PoseSpaceOptions) {
    const { dimensions: axes, examples, ...how } = options(given, READERS, POSE_SPACE_DEFAULTS);
    const { method, kernel, width, degree } = resolve(how);
    const dimensions = axes.map(({ name }) => name);
    this.#scales = axes.map(({ scale }) => scale);
    checkShapes(examples);
    const { kept, merged } = mergeDuplicates(examples, dimensions.length);
    const count = kept.length;

    this.dimensions = dimensions;
    this.names = kept.map((index) => exampleAt(examples, index).name);
    this.merged = merged;
    this.shapeLength = examples[0]?.shape.length ?? 0;
    this.#shapes = new Float64Array(this.shapeLength * count);
    this.#weights = new Float64Array(count);
    const places = new Float64Array(count * dimensions.length);
    kept.forEach((index, k) => {
      const { at, shape } = exampleAt(examples, index);
      this.#scales.forEach((scale, axis) => {
        places[k * dimensions.length + axis] = (at[axis] ?? 0) / scale;
      });
      for (let i = 0; i < shape.length; i++) this.#shapes[i * count + k] = shape[i] ?? 0;
    });

    this.#heap = heap;
    const space = heap.scope((scratch) => {
      const from = scratch.putF64(places);
      const out = scratch.reserve(4);
      try {
        heap.check((e) => e.hb_pose_space_create(from, count, dimensions.length, method, kernel, width, degree, out));
      } catch (error) {
        throw nameCulprit(error, examples, kept);
      }
      return heap.u32(out, 1)[0] ?? 0;
    });
    this.#owned = heap.own(this, 'hb_pose_space_free', space);
    // Allocated once, so that a frame allocates nothing.
    this.#query = this.#owned.alloc(dimensions.length * 8);
    this.#weightsAt = this.#owned.alloc(count * 8);
  }

  /** The examples' weights at a point of the pose space, in the order of `names`. They sum to 1 and may be slightly negative. */
  weights<T extends TypedArray = Float64Array>(at: ArrayLike<number> | Vector, out?: T): T {
    this.#solve(at);
    if (out !== undefined) checkRoom(out, 'out', this.names.length);
    const result: TypedArray = out ?? new Float64Array(this.names.length);
    result.set(this.#weights);
    return result as T;
  }

  /** The shape at a point of the pose space: the sum of the examples' shapes by their weights. */
  evaluate<T extends TypedArray = Float64Array>(at: ArrayLike<number> | Vector, out?: T): T {
    this.#solve(at);
    if (out !== undefined) checkRoom(out, 'out', this.shapeLength);
    const result: TypedArray = out ?? new Float64Array(this.shapeLength);
    const weights = this.#weights;
    const shapes = this.#shapes;
    const count = weights.length;
    for (let i = 0, s = 0; i < result.length; i++) {
      let sum = 0;
      for (let k = 0; k < count; k++, s++) sum += (weights[k] as number) * (shapes[s] as number);
      result[i] = sum;
    }
    return result as T;
  }

  /** Gives the memory back. Calling it again does nothing; calling anything else afterwards throws 'disposed'. */
  dispose(): void {
    this.#owned.release();
  }

  [Symbol.dispose](): void {
    this.dispose();
  }

  /** Computes the weights at `at` into `#weights`. */
  #solve(given: ArrayLike<number> | Vector): void {
    const space = this.#owned.pointer;
    if (space === 0) {
      throw new HandlebodyError('disposed', {
        message: 'This pose space was disposed of and cannot be used any more.',
        remedy: 'Make a new one with poseSpace(options).',
      });
    }
    const at = numbers(given, 'at', QUERY);
    if (at.length !== this.dimensions.length) {
      throw new HandlebodyError('invalid-shape', {
        message: `The "at" has ${at.length} coordinates; the pose space has ${this.dimensions.length} (${this.dimensions.join(', ')}).`,
        remedy: 'Give one coordinate a dimension.',
      });
    }
    const query = this.#heap.f64(this.#query, at.length);
    for (let axis = 0; axis < query.length; axis++) query[axis] = (at[axis] as number) / (this.#scales[axis] as number);
    this.#heap.check((e) => e.hb_pose_space_weights(space, this.#query, this.#weightsAt));
    this.#weights.set(this.#heap.f64(this.#weightsAt, this.#weights.length));
  }
}

const QUERY = { code: 'query-not-finite', kind: 'query', index: 0 } as const;

const READERS = {
  dimensions: (value, name) => {
    const dimensions = list(value, name, 'names of dimensions', (each, label) => {
      if (typeof each === 'string') return { name: each, scale: 1 };
      const readers = { name: text, scale: (scale, key) => positive(scale, `${label}.${key}`) } satisfies Readers<PoseDimension>;
      return options(each, readers, { scale: 1 }, label);
    });
    if (dimensions.length > 0) return dimensions;
    throw new HandlebodyError('invalid-shape', {
      message: 'The pose space has no dimensions.',
      remedy: "Name at least one, such as ['valence', 'arousal'].",
    });
  },
  examples: (value, name, { dimensions } = {}) =>
    list(value, name, 'examples, each { name, at, shape }', (example, label, index) =>
      readExample(example, label, index, (dimensions as readonly PoseDimension[]).length),
    ),
  method: named(METHODS),
  kernel: named(['auto', ...KERNELS]),
  // The solver reads 0 as "automatic", which nobody who writes 0 means.
  width: named(['auto'], positive, 'a positive number'),
  degree: named(['auto'], whole(-1, 1), 'a whole number from −1 to 1'),
} satisfies Readers<PoseSpaceOptions>;

/** The options as the solver's numbers. */
function resolve({ method, kernel, width, degree }: Omit<Read<typeof READERS>, 'dimensions' | 'examples'>) {
  const chosen = kernel !== 'auto' ? kernel : method === 'cardinal' ? 'multiquadric' : 'inverse-multiquadric';
  const lowest = method === 'normalized' ? -1 : NEEDS_LINEAR_TAIL.includes(chosen) ? 1 : 0;
  return {
    method: METHODS.indexOf(method),
    kernel: KERNELS.indexOf(chosen),
    width: width === 'auto' ? 0 : width,
    degree: degree === 'auto' ? lowest : degree,
  };
}

/** An example with its numbers checked, as they are used. */
type ReadExample = ReturnType<typeof readExample>;

function readExample(given: unknown, label: string, index: number, dimension: number) {
  const rule = { code: 'example-not-finite', kind: 'example', index } as const;
  const readers = {
    name: text,
    at: (value, key, read) => row(value, `${label}.${key}`, dimension, { ...rule, called: read?.name as string }),
    shape: (value, key, read) => numbers(value, `${label}.${key}`, { ...rule, called: read?.name as string }),
  } satisfies Readers<PoseExample>;
  return options(given, readers, {}, label);
}

function checkShapes(examples: readonly ReadExample[]): void {
  const first = examples[0];
  if (!first) {
    throw new HandlebodyError('examples-too-few', {
      message: 'The pose space has no examples.',
      remedy: 'Give one or more, each with a name, a place and a shape.',
    });
  }
  examples.forEach(({ name, shape }, index) => {
    if (shape.length === first.shape.length) return;
    throw new HandlebodyError('example-shape-mismatch', {
      message: `The shape of "${name}" has ${shape.length} numbers, that of "${first.name}" ${first.shape.length}.`,
      remedy: 'Give every example a shape of the same length, in the same order.',
      culprit: { kind: 'example', index },
    });
  });
}

/** Which examples to keep: of several at one place the first, if their shapes are equal; it is an error otherwise. */
function mergeDuplicates(examples: readonly ReadExample[], dimension: number) {
  const tolerances = placeTolerances(examples, dimension);
  const kept: number[] = [];
  const merged: { name: string; into: string }[] = [];
  examples.forEach((example, index) => {
    const twin = kept.find((other) => atOnePlace(example.at, exampleAt(examples, other).at, tolerances));
    if (twin === undefined) {
      kept.push(index);
      return;
    }
    const earlier = exampleAt(examples, twin);
    if (!equal(example.shape, earlier.shape)) {
      throw new HandlebodyError('example-duplicate', {
        message: `"${example.name}" is at the same place as "${earlier.name}" but has another shape.`,
        remedy: 'Move one of the two, or remove it.',
        culprit: { kind: 'example', index },
      });
    }
    merged.push({ name: example.name, into: earlier.name });
  });
  return { kept, merged };
}

function placeTolerances(examples: readonly ReadExample[], dimension: number): number[] {
  return Array.from({ length: dimension }, (_, axis) => {
    const coordinates = examples.map(({ at }) => at[axis] ?? 0);
    // No spread into Math.max: it overflows the stack for long lists.
    const extent = coordinates.reduce((a, b) => Math.max(a, b)) - coordinates.reduce((a, b) => Math.min(a, b));
    return COINCIDENT * Math.sqrt(dimension) * extent;
  });
}

function atOnePlace(a: ArrayLike<number>, b: ArrayLike<number>, tolerances: readonly number[]): boolean {
  let apart = 0;
  for (let axis = 0; axis < tolerances.length && apart <= 1; axis++) {
    const offset = (a[axis] as number) - (b[axis] as number);
    if (offset !== 0) apart = Math.hypot(apart, offset / (tolerances[axis] as number));
  }
  return apart <= 1;
}

function equal(a: ArrayLike<number>, b: ArrayLike<number>): boolean {
  for (let i = 0; i < a.length; i++) if (a[i] !== b[i]) return false;
  return true;
}

function exampleAt(examples: readonly ReadExample[], index: number): ReadExample {
  return examples[index] as ReadExample;
}

/** The solver numbers only the examples that it was given: translates the culprit's number into the caller's, and adds its name. */
function nameCulprit(error: unknown, examples: readonly ReadExample[], kept: readonly number[]): unknown {
  if (!(error instanceof HandlebodyError) || error.culprit?.kind !== 'example') return error;
  const index = kept[error.culprit.index];
  if (index === undefined) return error;
  return new HandlebodyError(error.code, {
    message: `At example "${exampleAt(examples, index).name}": ${error.message}`,
    remedy: error.remedy,
    culprit: { kind: 'example', index },
    cause: error,
  });
}
