import { options, type Readers } from './arguments.ts';
import type { Heap } from './heap.ts';
import { Interpolant, SCATTERED, type ScatteredData } from './interpolant.ts';
import { OUTSIDE, type OutsideHull, outsideHull } from './outside-hull.ts';

export interface SimplexLinearOptions extends ScatteredData {
  /** What to return outside the convex hull of the points: the value at its nearest point, or NaN. */
  readonly outside?: OutsideHull;
}

export const SIMPLEX_LINEAR_DEFAULTS = { outside: 'nearest' } as const;

const READERS = { ...SCATTERED, outside: outsideHull } satisfies Readers<SimplexLinearOptions>;

/**
 * Linear interpolation on the Delaunay simplices of the points (2014 course, §4.1), in any dimension: f(x) = Σ wₖ fₖ with the
 * barycentric weights of x in the simplex that holds it. It never leaves the range of the values, reproduces linear functions and has
 * kinks, so it has no gradient. Where points are cospherical, as in grids, the weights of least norm are taken: the center of a square
 * is the average of its corners. Points may span less than the space; queries are then projected onto their span.
 *
 * ```ts
 * const f = hb.simplexLinear({ dimension: 2, points: [0, 0, 1, 0, 0, 1], values: [2, 0, 1], outside: 'nan' });
 * f.evaluate([0.2, 0.3]);
 * ```
 */
export class SimplexLinear extends Interpolant {
  /** @internal Use `Handlebody.simplexLinear`. */
  constructor(heap: Heap, given: SimplexLinearOptions) {
    const { outside, ...data } = options(given, READERS, SIMPLEX_LINEAR_DEFAULTS);
    const rule = OUTSIDE.indexOf(outside);
    super(heap, data, (e, { points, values, count, dimension, outputs, out }) =>
      e.hb_simplex_linear_create(points, values, count, dimension, outputs, rule, out),
    );
  }
}
