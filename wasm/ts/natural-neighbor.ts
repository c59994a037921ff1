import type { Heap } from './heap.ts';
import { Interpolant, type ScatteredData } from './interpolant.ts';
import { type OutsideHull, outsideNumber } from './outside-hull.ts';

export interface NaturalNeighborOptions extends ScatteredData {
  /** Outside the convex hull: the value at the nearest point of the hull, or NaN. */
  readonly outside?: OutsideHull;
}

export const NATURAL_NEIGHBOR_DEFAULTS = { outside: 'nearest' } as const satisfies Partial<NaturalNeighborOptions>;

/**
 * Natural neighbor interpolation in the plane (Sibson 1981): a query weighs every point by the area that the query's Voronoi cell would
 * take from the point's. It never leaves the range of the values, reproduces linear functions inside the convex hull, and is smooth but for
 * the points themselves, where it has no gradient (NaN).
 *
 * ```ts
 * const f = hb.naturalNeighbor({ dimension: 2, points: [0, 0, 1, 0, 1, 1, 0, 1], values: [0, 1, 0, 1] });
 * f.evaluate([0.5, 0.5]);
 * ```
 */
export class NaturalNeighbor extends Interpolant {
  /** @internal Use `Handlebody.naturalNeighbor`. */
  constructor(heap: Heap, options: NaturalNeighborOptions) {
    const { outside } = { ...NATURAL_NEIGHBOR_DEFAULTS, ...options };
    const rule = outsideNumber(outside);
    super(heap, options, (e, { points, values, count, dimension, outputs, out }) =>
      e.hb_natural_neighbor_create(points, values, count, dimension, outputs, rule, out),
    );
  }
}
