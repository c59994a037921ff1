import { notNegative, options, positive, type Readers } from './arguments.ts';
import type { Heap } from './heap.ts';
import { Interpolant, SCATTERED, type ScatteredData } from './interpolant.ts';

export interface ShepardOptions extends ScatteredData {
  /** p > 0: flat spots at the points where it is above 1, cusps where it is below or equal. */
  readonly power?: number;
  /** ε ≥ 0 in units of the points; above 0 the points are approximated only. */
  readonly epsilon?: number;
}

export const SHEPARD_DEFAULTS = { power: 2, epsilon: 0 } as const;

const READERS = { ...SCATTERED, power: positive, epsilon: notNegative } satisfies Readers<ShepardOptions>;

/**
 * Shepard's method (2014 course, §4.3): f(x) = Σ wₖ fₖ / Σ wₖ with wₖ = (‖x − xₖ‖ + ε)⁻ᵖ. It never leaves the range of the values,
 * is flat at every point for p > 1, and becomes their average far away.
 *
 * ```ts
 * const f = hb.shepard({ dimension: 1, points: [0, 1, 3], values: [2, 0, 1], power: 2 });
 * f.evaluate([0.5, 2]);
 * ```
 */
export class Shepard extends Interpolant {
  /** @internal Use `Handlebody.shepard`. */
  constructor(heap: Heap, given: ShepardOptions) {
    const { power, epsilon, ...data } = options(given, READERS, SHEPARD_DEFAULTS);
    super(heap, data, (e, { points, values, count, dimension, outputs, out }) =>
      e.hb_shepard_create(points, values, count, dimension, outputs, power, epsilon, out),
    );
  }
}
