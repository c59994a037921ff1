import type { RuntimeExports } from './abi.generated.ts';
import { callback, checkRoom, type Numbers, notNumber, numbers, optional, type Readers, whole } from './arguments.ts';
import { HandlebodyError } from './errors.ts';
import type { Heap, Scratch } from './heap.ts';
import type { Owned } from './owned.ts';
import type { RbfWarning } from './rbf-report.ts';
import type { TypedArray } from './types.ts';

/** Points with values, as every scattered interpolant takes them. */
export interface ScatteredData {
  /** Number of coordinates of a point, 1 to 64. */
  readonly dimension: number;
  /** n × dimension, row-major; or n rows. */
  readonly points: Numbers;
  /** n × m, row-major: m numbers per point, which share all the work; or n rows. */
  readonly values: Numbers;
  /** Called for each warning when the interpolant is made. By default they go to the console; methods with a `report()` have them there too. */
  readonly onWarning?: (warning: RbfWarning) => void;
}

/** Points with values as they were read. @internal */
export interface ReadData {
  readonly dimension: number;
  readonly points: ArrayLike<number>;
  readonly values: ArrayLike<number>;
}

/** @internal How every interpolant reads its points and values. */
export const SCATTERED = {
  dimension: whole(1, 64, 'invalid-shape'),
  points: (value, name, { dimension } = {}) =>
    numbers(value, name, { code: 'point-not-finite', kind: 'point', width: dimension as number }),
  values: (value, name, { dimension, points } = {}) => {
    const count = (points as ArrayLike<number>).length / (dimension as number);
    const width = ((value as ArrayLike<unknown> | undefined)?.length ?? 0) / count;
    return numbers(value, name, { code: 'value-not-finite', kind: 'point', width });
  },
  onWarning: optional(callback),
} satisfies Readers<ScatteredData>;

/** The arguments that every *_create function of the C interface begins with, and its last. */
interface CreateArguments {
  readonly points: number;
  readonly values: number;
  readonly count: number;
  readonly dimension: number;
  readonly outputs: number;
  /** Where the new object's address goes. */
  readonly out: number;
}

/** Queries that are passed to the solver at a time: its scratch memory stays bounded, however many are asked. */
const BATCH = 4096;

const QUERY = { code: 'query-not-finite', kind: 'query' } as const;

/**
 * A function made of scattered data: f(x) = Σ wₖ(x) fₖ, one weight for each point. Arrays are row-major; `out` may be handed over to
 * be filled, so that a call allocates nothing.
 *
 * ```ts
 * const out = new Float64Array(2);
 * const some: Interpolant[] = [hb.shepard({ dimension: 1, points: [0, 1], values: [2, 3] })];
 * for (const f of some) f.evaluate([0.25, 0.5], out); // allocates nothing
 * ```
 */
export abstract class Interpolant {
  /** Points, as given. */
  readonly size: number;
  readonly dimension: number;
  /** Values per point. */
  readonly outputs: number;
  /** Points left out because an earlier one has the same place and values. */
  readonly merged: readonly { readonly point: number; readonly into: number }[];

  /** @internal */
  protected readonly heap: Heap;
  /** How queries are read: whether they are finite is looked at as they are copied. Made once, so that a call allocates nothing. */
  readonly #queries: { readonly code: 'query-not-finite'; readonly kind: 'query'; readonly finite: false; readonly width: number };
  /** @internal Its block is scratch memory. */
  protected readonly owned: Owned;
  #scratchBytes = 0;

  /** @internal */
  protected constructor(
    heap: Heap,
    data: ReadData,
    create: (exports: RuntimeExports, given: CreateArguments, options: number) => number,
    /** Puts further arguments into memory and returns their address. */
    writeOptions: (scratch: Scratch) => number = () => 0,
  ) {
    const { count, outputs } = checkShapes(data);
    this.heap = heap;
    this.size = count;
    this.dimension = data.dimension;
    this.#queries = { ...QUERY, finite: false, width: data.dimension };
    this.outputs = outputs;
    const made = heap.scope((scratch) => {
      const points = scratch.putF64(data.points);
      const values = scratch.putF64(data.values);
      const out = scratch.reserve(4);
      const twins = scratch.reserve(4 * count);
      const given = { points, values, count, dimension: data.dimension, outputs, out };
      const options = writeOptions(scratch);
      heap.check((exports) => create(exports, given, options));
      const handle = heap.u32(out, 1)[0] ?? 0;
      heap.check((exports) => exports.hb_interpolant_twins(handle, twins));
      const merged = [...heap.u32(twins, count)]
        .map((into, point) => ({ point, into }))
        .filter(({ point, into }) => point !== into);
      return { handle, merged };
    });
    this.owned = heap.own(this, 'hb_interpolant_free', made.handle);
    this.merged = made.merged;
  }

  /** Values (q × outputs) at queries (q × dimension). */
  evaluate<T extends TypedArray = Float64Array>(queries: Numbers, out?: T): T {
    return this.#ask('evaluate', queries, this.outputs, out);
  }

  /** Gradients (q × outputs × dimension) at queries (q × dimension); NaN where there is none. */
  gradient<T extends TypedArray = Float64Array>(queries: Numbers, out?: T): T {
    return this.#ask('gradient', queries, this.outputs * this.dimension, out);
  }

  /** The points' weights (q × size) at queries (q × dimension): a value is the sum of the points' values times their weights. */
  weights<T extends TypedArray = Float64Array>(queries: Numbers, out?: T): T {
    return this.#ask('weights', queries, this.size, out);
  }

  /** Gives the memory back. Calling it again does nothing; calling anything else afterwards throws 'disposed'. */
  dispose(): void {
    this.owned.release();
  }

  [Symbol.dispose](): void {
    this.dispose();
  }

  /** @internal The object in the solver's memory. */
  protected get handle(): number {
    const { pointer } = this.owned;
    if (pointer !== 0) return pointer;
    throw new HandlebodyError('disposed', {
      message: 'This interpolant was disposed of and cannot be used any more.',
      remedy: 'Make a new one of the same data.',
    });
  }

  #ask<T extends TypedArray>(what: 'evaluate' | 'gradient' | 'weights', given: Numbers, width: number, room: T | undefined): T {
    const { handle, heap, dimension } = this;
    const queries = numbers(given, 'queries', this.#queries);
    const count = queries.length / dimension;
    if (!Number.isInteger(count)) throw notRows('queries', queries.length, dimension);
    if (room !== undefined) checkRoom(room, 'out', count * width);
    const out: TypedArray = room ?? new Float64Array(count * width);
    for (let first = 0; first < count; first += BATCH) {
      const batch = Math.min(BATCH, count - first);
      this.#reserve(8 * batch * (dimension + width));
      const from = this.owned.blocks[0] as number;
      const to = from + 8 * batch * dimension;
      const input = heap.f64(from, batch * dimension);
      for (let i = 0, at = first * dimension; i < input.length; i++, at++) {
        const x = queries[at] as number;
        if (!Number.isFinite(x)) throw notNumber(`queries[${at}]`, x, at / dimension, QUERY);
        input[i] = x;
      }
      heap.check((e) => e[`hb_interpolant_${what}`](handle, from, batch, to));
      heap.kernels.throwFailure();
      out.set(heap.f64(to, batch * width), first * width);
    }
    return out as T;
  }

  #reserve(bytes: number): void {
    if (bytes <= this.#scratchBytes) return;
    const { blocks } = this.owned;
    this.heap.free(blocks.pop() ?? 0);
    this.#scratchBytes = 0;
    blocks.push(this.heap.alloc(bytes));
    this.#scratchBytes = bytes;
  }
}

/** The counts that the lengths of the arrays imply. */
export function checkShapes({ dimension, points, values }: ReadData): { count: number; outputs: number } {
  const count = points.length / dimension;
  if (!Number.isInteger(count)) throw notRows('points', points.length, dimension);
  if (count === 0) {
    throw new HandlebodyError('points-too-few', {
      message: 'There are no points.',
      remedy: 'Give at least one point with a value.',
    });
  }
  const outputs = values.length / count;
  if (!Number.isInteger(outputs) || outputs === 0) {
    throw new HandlebodyError('invalid-shape', {
      message: `There are ${values.length} values for ${count} points.`,
      remedy: 'Give every point the same number of values, one or more.',
    });
  }
  return { count, outputs };
}

function notRows(what: string, length: number, dimension: number): HandlebodyError {
  return new HandlebodyError('invalid-shape', {
    message: `The ${length} numbers of the ${what} are no whole number of rows of ${dimension}.`,
    remedy: `Give ${dimension} coordinates for each, or another dimension.`,
  });
}
