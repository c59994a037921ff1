import type { Exports } from './abi.generated.ts';
import { checkRoom, indices, type Numbers, named, numbers, options, type Reader, type Readers, whole } from './arguments.ts';
import { HandlebodyError } from './errors.ts';
import type { Heap } from './heap.ts';
import type { Owned } from './owned.ts';
import type { TypedArray } from './types.ts';

/** What lies beyond the ends: nothing, zeros, the ends' own values (no slope), or the other end. */
export type GridBoundary = 'free' | 'dirichlet' | 'neumann' | 'periodic';

export interface DiscreteGreenOptions {
  /** Samples of the grid, N: order + 1 to 1024. */
  readonly size: number;
  /** Order of the differences D. */
  readonly order?: 1 | 2 | 3;
  readonly boundary?: GridBoundary;
  /** Where values are known: different numbers from 0 to size − 1. */
  readonly samples: Numbers;
  /** One per sample. */
  readonly values: Numbers;
}

export const DISCRETE_GREEN_DEFAULTS = { order: 2, boundary: 'free' } as const;

/** A matrix to look at, row-major. */
export interface GridMatrix {
  readonly rows: number;
  readonly columns: number;
  readonly values: Float64Array;
}

const BOUNDARIES: readonly GridBoundary[] = ['free', 'dirichlet', 'neumann', 'periodic'];
const MATRICES = { operator: 0, squared: 1, nullSpace: 2, green: 3 } as const;

const READERS = {
  size: whole(1, 2 ** 31 - 1),
  order: whole(1, 3) as Reader<1 | 2 | 3>,
  boundary: named(BOUNDARIES),
  samples: (value, name, { size } = {}) => indices(value, name, { kind: 'point', code: 'invalid-option' }, size as number),
  values: (value, name) => numbers(value, name, { kind: 'point', code: 'value-not-finite' }),
} satisfies Readers<DiscreteGreenOptions>;

/**
 * Where kernels come from (2014 course, §5.4–5.6): the curve through given samples of a grid that minimizes ‖Df‖², D a difference
 * operator, found on the grid and by radial functions, which are columns of (DᵀD)⁻¹.
 *
 * ```ts
 * const lesson = hb.discreteGreen({ size: 100, order: 2, samples: [10, 40, 70], values: [0, 1, 0.5] });
 * lesson.green;         // 100×100: its columns are the kernel, here a cubic spline's
 * lesson.nullSpace;     // 100×2: straight lines, which D cannot see: the polynomial of §5.2
 * lesson.solveGrid();   // 100 values …
 * lesson.solveRadial(); // … and the same again from 3 weights and 2 coefficients
 * ```
 */
export class DiscreteGreen {
  readonly size: number;
  readonly order: 1 | 2 | 3;
  readonly boundary: GridBoundary;
  /** Number of samples given. */
  readonly sampleCount: number;
  /** Dimension of the null space of DᵀD: 0 where it is regular. */
  readonly nullity: number;

  readonly #heap: Heap<Exports>;
  readonly #rows: number;
  readonly #matrices = new Map<number, GridMatrix>();
  readonly #owned: Owned;

  /** @internal Use `Handlebody.discreteGreen`. */
  constructor(heap: Heap<Exports>, given: DiscreteGreenOptions) {
    const { size, order, boundary, samples, values } = options(given, READERS, DISCRETE_GREEN_DEFAULTS);
    if (samples.length !== values.length) {
      throw new HandlebodyError('invalid-shape', {
        message: `There are ${values.length} values for ${samples.length} samples.`,
        remedy: 'Give each sample one value.',
      });
    }
    const made = heap.scope((scratch) => {
      const from = scratch.putU32(samples);
      const at = scratch.putF64(values);
      const out = scratch.reserve(8);
      heap.check((e) => e.hb_discrete_green_create(size, order, BOUNDARIES.indexOf(boundary), from, at, samples.length, out));
      const handle = heap.u32(out, 1)[0] ?? 0;
      heap.check((e) => e.hb_discrete_green_shape(handle, out, out + 4));
      const [rows = 0, nullity = 0] = heap.u32(out, 2);
      return { handle, rows, nullity };
    });
    this.size = size;
    this.order = order;
    this.boundary = boundary;
    this.sampleCount = samples.length;
    this.nullity = made.nullity;
    this.#heap = heap;
    this.#rows = made.rows;
    this.#owned = heap.own(this, 'hb_discrete_green_free', made.handle);
  }

  /** D. */
  get operator(): GridMatrix {
    return this.#matrix('operator', this.#rows, this.size);
  }

  /** DᵀD, size × size. */
  get squared(): GridMatrix {
    return this.#matrix('squared', this.size, this.size);
  }

  /** Orthonormal columns that D takes to zero, size × nullity: the polynomials of §5.2. */
  get nullSpace(): GridMatrix {
    return this.#matrix('nullSpace', this.size, this.nullity);
  }

  /** Green's matrix G, size × size: (DᵀD)⁻¹, or where that is singular the corner of the inverse of [DᵀD N; Nᵀ 0], N the null space. */
  get green(): GridMatrix {
    return this.#matrix('green', this.size, this.size);
  }

  /** The curve (size numbers) by eliminating everything that is not a sample. */
  solveGrid<T extends TypedArray = Float64Array>(out?: T): T {
    return this.#solve(out, undefined);
  }

  /** The curve by radial functions: G's columns at the samples and the null space, times `weights` (sampleCount + nullity). */
  solveRadial(out?: undefined, weights?: TypedArray): Float64Array;
  solveRadial<T extends TypedArray>(out: T, weights?: TypedArray): T;
  solveRadial(out?: TypedArray, weights: TypedArray = new Float64Array(this.sampleCount + this.nullity)): TypedArray {
    return this.#solve(out, weights);
  }

  /** Gives the memory back. Calling it again does nothing; calling anything else afterwards throws 'disposed'. */
  dispose(): void {
    this.#owned.release();
    this.#matrices.clear();
  }

  [Symbol.dispose](): void {
    this.dispose();
  }

  #alive(): number {
    const { pointer } = this.#owned;
    if (pointer !== 0) return pointer;
    throw new HandlebodyError('disposed', {
      message: 'This grid was disposed of and cannot be used any more.',
      remedy: 'Make a new one with discreteGreen(options).',
    });
  }

  #matrix(name: keyof typeof MATRICES, rows: number, columns: number): GridMatrix {
    const handle = this.#alive();
    const which = MATRICES[name];
    const known = this.#matrices.get(which);
    if (known) return known;
    const values = this.#heap.scope((scratch) => {
      const at = scratch.reserve(8 * rows * columns);
      this.#heap.check((e) => e.hb_discrete_green_matrix(handle, which, at));
      return this.#heap.f64(at, rows * columns).slice();
    });
    const matrix = { rows, columns, values };
    this.#matrices.set(which, matrix);
    return matrix;
  }

  #solve<T extends TypedArray>(given: T | undefined, weights: TypedArray | undefined): T {
    const handle = this.#alive();
    if (given !== undefined) checkRoom(given, 'out', this.size);
    if (weights !== undefined) checkRoom(weights, 'weights', this.sampleCount + this.nullity);
    const out: TypedArray = given ?? new Float64Array(this.size);
    this.#heap.scope((scratch) => {
      const curve = scratch.reserve(8 * this.size);
      const at = scratch.reserve(8 * (weights?.length ?? 0));
      this.#heap.check((e) =>
        weights ? e.hb_discrete_green_solve_radial(handle, curve, at) : e.hb_discrete_green_solve_grid(handle, curve),
      );
      out.set(this.#heap.f64(curve, this.size));
      weights?.set(this.#heap.f64(at, weights.length));
    });
    return out as T;
  }
}
