import type { RuntimeExports } from './abi.generated.ts';
import {
  callback,
  checkRoom,
  flag,
  type Numbers,
  numbers,
  optional,
  type Read,
  type Reader,
  type Readers,
  whole,
} from './arguments.ts';
import { HandlebodyError } from './errors.ts';
import type { Heap, Scratch } from './heap.ts';
import type { Owned } from './owned.ts';
import { printWarning } from './rbf-report.ts';
import { type SkinWarning, withSumsOfOne } from './skin-weights.ts';
import type { TypedArray } from './types.ts';

/** A shape that moves by blending: rest positions, and the weight of each handle at each of them. */
export interface SkinOptions {
  /** n × dimension, row-major; or n rows. */
  readonly positions: Numbers;
  /** 2 in the plane, 3 (the default) in space. */
  readonly dimension?: 2 | 3;
  /** n × h, row-major: for every vertex one number per handle; or n rows. */
  readonly weights: Numbers;
  /**
   * Divides each vertex's weights by their sum, so that the shape rests where all transforms are the identity. A vertex whose weights have no
   * positive sum is refused by 'weights-missing'. With `false` they are taken as they are.
   */
  readonly normalize?: boolean;
  /**
   * Told where weights summed to something else than 1, by more than rounding explains, and of the worst vertex. Without it the warning is
   * printed.
   */
  readonly onWarning?: (warning: SkinWarning) => void;
}

export const SKIN_DEFAULTS = { dimension: 3, normalize: true } as const;

/** @internal How the options of blended skins are read. The solver names numbers that are not finite. */
export const SKIN_READERS = {
  dimension: whole(2, 3, 'invalid-shape') as Reader<2 | 3>,
  positions: (value, name, { dimension } = {}) =>
    numbers(value, name, { code: 'mesh-not-finite', kind: 'vertex', width: dimension as number }),
  weights: (value, name, { dimension, positions } = {}) => {
    const count = (positions as ArrayLike<number>).length / (dimension as number);
    const width = ((value as ArrayLike<unknown> | undefined)?.length ?? 0) / count;
    return numbers(value, name, { code: 'value-not-finite', kind: 'vertex', width });
  },
  normalize: flag,
  onWarning: optional(callback),
} satisfies Readers<SkinOptions>;

/**
 * A shape under h handles: write their `transforms`, then `deform`. A frame allocates nothing when it is given `out`.
 *
 * ```ts
 * const skin: Skin = hb.linearBlend({ dimension: 2, positions: [0, 0, 1, 0], weights: [1, 0, 0, 1] });
 * skin.transforms.set([1, 0, 3, 0, 1, 0], 6); // shifts handle 1 by 3
 * skin.dispose();
 * ```
 */
export abstract class Skin {
  /** Coordinates of a vertex, 2 or 3. */
  readonly dimension: 2 | 3;
  readonly vertexCount: number;
  readonly handleCount: number;
  /**
   * Where the handles take the shape: h × dimension × (dimension + 1), row-major, one matrix T per handle, which takes v to T [v; 1]. The
   * identity at first. Write it in place.
   */
  readonly transforms: Float64Array;

  /** @internal */
  protected readonly heap: Heap;
  /** @internal */
  protected readonly owned: Owned;
  readonly #out: number;

  /** @internal */
  protected constructor(
    heap: Heap,
    shape: { readonly dimension: 2 | 3; readonly vertexCount: number; readonly handleCount: number },
    /** Makes the object from what `put` returned, and writes its address to `out`. */
    create: (out: number, given: readonly number[]) => void,
    /** Copies the arguments of `create` in and returns their addresses. */
    put: (scratch: Scratch) => readonly number[],
  ) {
    const { dimension, vertexCount, handleCount } = shape;
    this.heap = heap;
    this.dimension = dimension;
    this.vertexCount = vertexCount;
    this.handleCount = handleCount;
    const handle = heap.scope((scratch) => {
      const given = put(scratch);
      const out = scratch.reserve(4);
      create(out, given);
      return heap.u32(out, 1)[0] ?? 0;
    });
    this.owned = heap.own(this, 'hb_skin_free', handle);
    // Allocated once, so that a frame allocates nothing.
    this.#out = this.owned.alloc(vertexCount * dimension * 4);
    const transforms = heap.call((e) => e.hb_skin_transforms(handle));
    this.transforms = heap.f64(transforms, handleCount * dimension * (dimension + 1)).slice();
  }

  /** Gives the memory back. Calling it again does nothing; calling anything else afterwards throws 'disposed'. */
  dispose(): void {
    this.owned.release();
  }

  [Symbol.dispose](): void {
    this.dispose();
  }

  /** @internal Moves the vertices by what `transforms` says now: `run` gets the object and where positions go. */
  protected move<T extends TypedArray>(given: T | undefined, run: (handle: number, out: number) => void): T {
    const { heap, transforms } = this;
    const handle = this.owned.pointer;
    if (handle === 0) {
      throw new HandlebodyError('disposed', {
        message: 'This skin was disposed of and cannot be used any more.',
        remedy: 'Make a new one of the same shape.',
      });
    }
    const length = this.vertexCount * this.dimension;
    if (given !== undefined) checkRoom(given, 'out', length);
    const out: TypedArray = given ?? new Float32Array(length);
    const at = heap.call((e) => e.hb_skin_transforms(handle));
    heap.f64(at, transforms.length).set(transforms);
    run(handle, this.#out);
    out.set(heap.f32(this.#out, length));
    return out as T;
  }
}

/**
 * A skin that weights make: `deform` blends the transforms at every vertex.
 *
 * ```ts
 * const skin: BlendedSkin = hb.linearBlend({ positions: [0, 0, 0, 1, 0, 0], weights: [1, 0, 0, 1] });
 * skin.deform(new Float32Array(6));
 * ```
 */
export abstract class BlendedSkin extends Skin {
  /** @internal */
  protected constructor(
    heap: Heap,
    options: Read<typeof SKIN_READERS>,
    create: (exports: RuntimeExports, out: number, given: BlendArguments) => number,
  ) {
    const { positions, dimension, weights, normalize, onWarning } = options;
    const vertexCount = countRows(positions, dimension);
    const handleCount = weights.length / vertexCount;
    if (!Number.isInteger(handleCount) || handleCount === 0) {
      throw new HandlebodyError('invalid-shape', {
        message: `There are ${weights.length} weights for ${vertexCount} vertices.`,
        remedy: 'Give every vertex the same number of weights, one a handle.',
      });
    }
    super(
      heap,
      { dimension, vertexCount, handleCount },
      (out, [at = 0, weightsAt = 0]) => {
        const given = { positions: at, count: vertexCount, dimension, weights: weightsAt, handleCount };
        heap.check((e) => create(e, out, given));
      },
      (scratch) => [
        scratch.putF64(positions),
        scratch.putF64(normalize ? withSumsOfOne(weights, handleCount, onWarning ?? printWarning) : weights),
      ],
    );
  }

  /** Writes the deformed positions, n × dimension, and returns them. */
  deform<T extends TypedArray = Float32Array>(out?: T): T {
    return this.move(out, (skin, to) => this.heap.check((e) => e.hb_skin_deform(skin, to)));
  }
}

/** What the *_create functions of blended skins begin with. */
interface BlendArguments {
  readonly positions: number;
  readonly count: number;
  readonly dimension: number;
  readonly weights: number;
  readonly handleCount: number;
}

/** Number of vertices that have these positions. */
function countRows(positions: ArrayLike<number>, dimension: number): number {
  const count = positions.length / dimension;
  if (Number.isInteger(count) && count > 0) return count;
  throw new HandlebodyError('invalid-shape', {
    message: `The ${positions.length} numbers of the positions are not one or more vertices of ${dimension}.`,
    remedy: `Give ${dimension} coordinates for each vertex, or another dimension.`,
  });
}
