import { readFileSync } from 'node:fs';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { load, SHEPARD_DEFAULTS } from '../../wasm/ts/index.ts';
import { errorOf, largestDifference, pointSet } from './support/scattered.ts';

const hb = await load();
const seed = 1968;

interface Case {
  readonly dimension: number;
  readonly points: number[];
  readonly values: number[];
  readonly power: number;
  readonly epsilon: number;
  readonly queries: number[];
  readonly expected: number[];
}

test('agrees with the formula in 50 digits to 1e-12', () => {
  const cases = JSON.parse(readFileSync(new URL('../oracles/shepard.json', import.meta.url), 'utf8')) as Case[];
  expect(cases.length).toBe(44);
  for (const { queries, expected, ...options } of cases) {
    using f = hb.shepard(options);
    expect(largestDifference(f.evaluate(queries), expected)).toBeLessThan(1e-12 * Math.max(...expected.map(Math.abs)));
  }
});

describe('properties', () => {
  const power = fc.double({ min: 0.1, max: 20, noNaN: true });

  test(`interpolates, stays within the values, and its weights sum to 1 (seed ${seed})`, () => {
    fc.assert(
      fc.property(pointSet(), power, (data, p) => {
        using f = hb.shepard({ ...data, power: p });
        expect(Array.from(f.evaluate(data.points))).toEqual(data.values);
        const weights = f.weights(data.queries);
        const values = f.evaluate(data.queries);
        for (const [q, value] of values.entries()) {
          const row = weights.subarray(q * f.size, (q + 1) * f.size);
          expect(row.reduce((a, b) => a + b, 0)).toBeCloseTo(1, 12);
          expect(Math.min(...row)).toBeGreaterThanOrEqual(0);
          expect(row.reduce((sum, w, k) => sum + w * (data.values[k] ?? 0), 0)).toBeCloseTo(value, 9);
          expect(value).toBeGreaterThanOrEqual(Math.min(...data.values) - 1e-9);
          expect(value).toBeLessThanOrEqual(Math.max(...data.values) + 1e-9);
        }
      }),
      { seed, numRuns: 100 },
    );
  });

  test(`neither order, place nor scale matters (seed ${seed})`, () => {
    fc.assert(
      fc.property(pointSet(), power, (data, p) => {
        using f = hb.shepard({ ...data, power: p });
        const { dimension } = data;
        const moved = (x: readonly number[]) => x.map((c, i) => 4 * c + (i % dimension) - 2);
        const rows = Array.from({ length: f.size }, (_, k) => data.points.slice(k * dimension, (k + 1) * dimension)).reverse();
        using g = hb.shepard({ dimension, points: moved(rows.flat()), values: data.values.toReversed(), power: p });
        expect(largestDifference(f.evaluate(data.queries), g.evaluate(moved(data.queries)))).toBeLessThan(1e-9);
      }),
      { seed, numRuns: 100 },
    );
  });
});

test('flat at the points for p > 1, no gradient there for p = 1, only approximate with epsilon', () => {
  const data = { dimension: 1, points: [0, 1, 3], values: [2, 0, 1] };
  using flat = hb.shepard(data);
  using cusp = hb.shepard({ ...data, power: 1 });
  using near = hb.shepard({ ...data, epsilon: 0.1 });
  expect(Array.from(flat.gradient(data.points))).toEqual([0, 0, 0]);
  expect(Array.from(cusp.gradient(data.points))).toEqual([Number.NaN, Number.NaN, Number.NaN]);
  expect(near.evaluate([0])[0]).toBeCloseTo((2 / 0.1 ** 2 + 1 / 3.1 ** 2) / (1 / 0.1 ** 2 + 1 / 1.1 ** 2 + 1 / 3.1 ** 2), 14);
  expect(flat.evaluate([1e300])[0]).toBeCloseTo(1, 14);
});

test('defaults, merged points, several values, out', () => {
  const data = { dimension: 2, points: [0, 0, 1, 0, 0, 0, 0, 2], values: [1, 2, 3, 4, 1, 2, 5, 6] };
  using f = hb.shepard(data);
  using explicit = hb.shepard({ ...data, ...SHEPARD_DEFAULTS });
  expect(f.merged).toEqual([{ point: 2, into: 0 }]);
  expect(f.outputs).toBe(2);
  const out = new Float64Array(2);
  expect(f.evaluate([0.3, 0.4], out)).toBe(out);
  expect(explicit.evaluate([0.3, 0.4])).toEqual(out);
  expect(f.weights([0.3, 0.4])[2]).toBe(0);
});

test('bad input is named', () => {
  const data = { dimension: 1, points: [0, 1, 3], values: [2, 0, 1] };
  expect(errorOf(() => hb.shepard({ ...data, power: 0 }))).toMatchObject({ code: 'invalid-option', culprit: { kind: 'option' } });
  expect(errorOf(() => hb.shepard({ ...data, epsilon: -1 })).code).toBe('invalid-option');
  expect(errorOf(() => hb.shepard({ ...data, points: [0, 1, 1] }))).toMatchObject({
    code: 'point-duplicate',
    culprit: { kind: 'point', index: 2 },
  });
  expect(errorOf(() => hb.shepard({ ...data, points: [0, Number.NaN, 1] })).culprit).toEqual({ kind: 'point', index: 1 });
  expect(errorOf(() => hb.shepard({ ...data, values: [1, 2] })).code).toBe('invalid-shape');
  expect(errorOf(() => hb.shepard({ dimension: 1, points: [], values: [] })).code).toBe('points-too-few');
  const f = hb.shepard(data);
  expect(errorOf(() => f.evaluate([0, Number.POSITIVE_INFINITY])).culprit).toEqual({ kind: 'query', index: 1 });
  f.dispose();
  f.dispose();
  expect(errorOf(() => f.evaluate([0])).code).toBe('disposed');
});
