import { LAYOUT } from './abi.generated.ts';
import { named, notNegative, options, positive, type Readers, whole } from './arguments.ts';
import type { Heap } from './heap.ts';
import { Interpolant, SCATTERED, type ScatteredData } from './interpolant.ts';

/** `inverse-distance`: (r + ε)⁻ᵖ. `gaussian`: exp(−(r/h)²). `wendland`: (1 − r/h)⁴₊ (4r/h + 1), nothing beyond h. */
export type MovingWeight = 'inverse-distance' | 'gaussian' | 'wendland';

export interface MovingLeastSquaresOptions extends ScatteredData {
  /** Degree of the polynomial that is fitted at every place; such polynomials are reproduced. */
  readonly degree?: 0 | 1 | 2;
  /** `'inverse-distance'` interpolates where `epsilon` is 0; the others approximate. */
  readonly weight?: MovingWeight;
  /** p > 0 of `'inverse-distance'`: smooth above 1, cusps at the points up to 1. */
  readonly power?: number;
  /** ε ≥ 0 of `'inverse-distance'`, in units of the points; above 0 the points are approximated only. */
  readonly epsilon?: number;
  /**
   * h of the other weights, in units of the points. `'auto'`: 2 + degree mean distances to the nearest neighbor for `'gaussian'`, twice
   * that for `'wendland'`.
   */
  readonly width?: number | 'auto';
}

export const MOVING_LEAST_SQUARES_DEFAULTS = {
  degree: 1,
  weight: 'inverse-distance',
  power: 4,
  epsilon: 0,
  width: 'auto',
} as const;

const WEIGHTS: readonly MovingWeight[] = ['inverse-distance', 'gaussian', 'wendland'];

const READERS = {
  ...SCATTERED,
  degree: whole(0, 2),
  weight: named(WEIGHTS),
  power: positive,
  epsilon: notNegative,
  width: named(['auto'], positive, 'a positive number'),
} satisfies Readers<MovingLeastSquaresOptions>;

/**
 * Moving least squares (Lancaster and Salkauskas 1981): the value at x is that of a polynomial fitted to all points by weights that fall
 * with their distance from x. Of degree 0 with inverse distances it is Shepard's method; higher degrees have no flat spots.
 *
 * Where the points near by do not determine the polynomial, `'wendland'` widens to 2q points (q polynomials), and the degree falls to one
 * that they do determine.
 *
 * ```ts
 * const f = hb.movingLeastSquares({ dimension: 1, points: [0, 1, 3, 4], values: [2, 0, 1, 1], degree: 1 });
 * f.evaluate([0.5, 2]);
 * ```
 */
export class MovingLeastSquares extends Interpolant {
  /** h as given or chosen; 0 for `'inverse-distance'`. */
  readonly width: number;

  /** @internal Use `Handlebody.movingLeastSquares`. */
  constructor(heap: Heap, given: MovingLeastSquaresOptions) {
    const { degree, weight, power, epsilon, width, ...data } = options(given, READERS, MOVING_LEAST_SQUARES_DEFAULTS);
    const layout = LAYOUT.hb_moving_least_squares_options;
    let used = 0;
    super(
      heap,
      data,
      (e, { points, values, count, dimension, outputs, out }, how) => {
        const usedAt = how + layout.sizeof;
        const status = e.hb_moving_least_squares_create(points, values, count, dimension, outputs, how, usedAt, out);
        used = heap.f64(usedAt, 1)[0] ?? 0;
        return status;
      },
      (scratch) => {
        const at = scratch.reserve(layout.sizeof + 8); // and room for the width that was used
        const doubles = heap.f64(at, layout.degree / 8);
        doubles[layout.power / 8] = power;
        doubles[layout.epsilon / 8] = epsilon;
        doubles[layout.width / 8] = width === 'auto' ? 0 : width;
        const words = heap.u32(at, layout.sizeof / 4);
        words[layout.degree / 4] = degree;
        words[layout.weight / 4] = WEIGHTS.indexOf(weight);
        return at;
      },
    );
    this.width = used;
  }
}
