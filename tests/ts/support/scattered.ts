import fc from 'fast-check';
import { HandlebodyError } from '../../../wasm/ts/index.ts';

export function errorOf(run: () => unknown): HandlebodyError {
  try {
    run();
  } catch (error) {
    if (error instanceof HandlebodyError) return error;
    throw error;
  }
  throw new Error('expected a HandlebodyError');
}

/** NaN where a number is missing or is NaN, which no bound lets through. */
export function largestDifference(a: ArrayLike<number>, b: ArrayLike<number>): number {
  if (a.length !== b.length) return Number.NaN;
  let most = 0;
  for (let i = 0; i < a.length; i++) {
    const apart = Math.abs((a[i] ?? Number.NaN) - (b[i] ?? Number.NaN));
    if (!(apart <= most)) most = apart;
  }
  return most;
}

export interface PointSet {
  readonly dimension: number;
  readonly points: number[];
  readonly values: number[];
  readonly queries: number[];
}

/** Distinct points on a lattice, one value each, and a few queries in and around them. */
export function pointSet({ dimensions = [1, 2, 3], least = (_dimension: number) => 1 } = {}): fc.Arbitrary<PointSet> {
  return fc
    .constantFrom(...dimensions)
    .chain((dimension) => {
      const place = fc.array(fc.integer({ min: -20, max: 20 }), { minLength: dimension, maxLength: dimension });
      return fc.record({
        dimension: fc.constant(dimension),
        points: fc.uniqueArray(place, { minLength: least(dimension), maxLength: 30, selector: String }),
        queries: fc.array(fc.double({ min: -30, max: 30, noNaN: true }), { minLength: 4 * dimension, maxLength: 4 * dimension }),
        values: fc.array(fc.integer({ min: -100, max: 100 }), { minLength: 30, maxLength: 30 }),
      });
    })
    .map(({ dimension, points, queries, values }) => ({
      dimension,
      points: points.flat(),
      values: values.slice(0, points.length),
      queries,
    }));
}
