import { options, type Readers } from './arguments.ts';
import type { Heap } from './heap.ts';
import { Interpolant, SCATTERED, type ScatteredData } from './interpolant.ts';
import { OUTSIDE, type OutsideHull, outsideHull } from './outside-hull.ts';

export interface NaturalNeighborOptions extends ScatteredData {
  /** Outside the convex hull: the value at the nearest point of the hull, or NaN. */
  readonly outside?: OutsideHull;
}

export const NATURAL_NEIGHBOR_DEFAULTS = { outside: 'nearest' } as const satisfies Partial<NaturalNeighborOptions>;

const READERS = { ...SCATTERED, outside: outsideHull } satisfies Readers<NaturalNeighborOptions>;

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
  constructor(heap: Heap, given: NaturalNeighborOptions) {
    const { outside, ...data } = options(given, READERS, NATURAL_NEIGHBOR_DEFAULTS);
    const rule = OUTSIDE.indexOf(outside);
    super(heap, data, (e, { points, values, count, dimension, outputs, out }) =>
      e.hb_natural_neighbor_create(points, values, count, dimension, outputs, rule, out),
    );
  }
}
