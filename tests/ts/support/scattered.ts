// What the tests of scattered interpolation share.
import fc from 'fast-check';
import { expect } from 'vitest';
import { HandlebodyError } from '../../../wasm/ts/index.ts';

/** Numbers in [−1, 1] and permutations from a seed (mulberry32). */
export function random(seed: number) {
  let state = seed >>> 0;
  const unit = () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = state;
    t = Math.imul(t ^ (t >>> 15), t | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
  const number = () => 2 * unit() - 1;
  return {
    number,
    numbers: (count: number) => Array.from({ length: count }, number),
    permutation: (count: number) => {
      const order = Array.from({ length: count }, (_, i) => i);
      for (let i = count - 1; i > 0; i--) {
        const j = Math.floor(unit() * (i + 1));
        [order[i], order[j]] = [order[j] as number, order[i] as number];
      }
      return order;
    },
  };
}

/** A random rotation in space, row-major, from a quaternion. */
export function rotation(next: ReturnType<typeof random>): number[] {
  const q = next.numbers(4);
  const length = Math.hypot(...q);
  const [w = 1, x = 0, y = 0, z = 0] = q.map((part) => part / length);
  return [
    1 - 2 * (y * y + z * z),
    2 * (x * y - w * z),
    2 * (x * z + w * y),
    2 * (x * y + w * z),
    1 - 2 * (x * x + z * z),
    2 * (y * z - w * x),
    2 * (x * z - w * y),
    2 * (y * z + w * x),
    1 - 2 * (x * x + y * y),
  ];
}

export function rotate(m: readonly number[], points: ArrayLike<number>): number[] {
  return Array.from({ length: points.length }, (_, i) => {
    const first = i - (i % 3);
    return [0, 1, 2].reduce((sum, k) => sum + (m[3 * (i % 3) + k] ?? 0) * (points[first + k] ?? 0), 0);
  });
}

/** The HandlebodyError that `run` throws. */
export function errorOf(run: () => unknown): HandlebodyError {
  try {
    run();
  } catch (error) {
    if (error instanceof HandlebodyError) return error;
    throw error;
  }
  throw new Error('expected a HandlebodyError');
}

/** The largest absolute value. */
export const largest = (numbers: ArrayLike<number>) => Array.from(numbers).reduce((most, x) => Math.max(most, Math.abs(x)), 0);

/** Equal within `tolerance`, relative to the largest expected number where that is above 1. */
export function expectClose(actual: ArrayLike<number>, expected: ArrayLike<number>, tolerance: number, what = '') {
  expect(actual.length).toBe(expected.length);
  const error = largest(Array.from(actual, (x, i) => x - (expected[i] ?? Number.NaN)));
  expect(error, what).toBeLessThan(tolerance * Math.max(1, largest(expected)));
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
