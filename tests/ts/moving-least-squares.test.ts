import { readFileSync } from 'node:fs';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { load, MOVING_LEAST_SQUARES_DEFAULTS, type MovingLeastSquaresOptions, type MovingWeight } from '../../wasm/ts/index.ts';
import { errorOf, largestDifference, type PointSet, pointSet } from './support/scattered.ts';

const hb = await load();
const seed = 1981;
const weights: readonly MovingWeight[] = ['inverse-distance', 'gaussian', 'wendland'];
const degrees = [0, 1, 2] as const;

interface Case {
  readonly dimension: number;
  readonly points: number[];
  readonly values: number[];
  readonly degree: 0 | 1 | 2;
  readonly weight: number;
  readonly power: number;
  readonly epsilon: number;
  readonly width: number;
  readonly queries: number[];
  readonly expected: number[];
}

test("agrees with numpy's weighted fits to 1e-9", () => {
  const cases = JSON.parse(readFileSync(new URL('../oracles/moving_least_squares.json', import.meta.url), 'utf8')) as Case[];
  expect(cases.length).toBe(87);
  let worst = 0;
  for (const { queries, expected, weight, width, ...rest } of cases) {
    using f = hb.movingLeastSquares({
      ...rest,
      weight: weights[weight] as MovingWeight,
      width: width === 0 ? 'auto' : width,
    });
    const scale = Math.max(1, ...expected.map(Math.abs));
    worst = Math.max(worst, largestDifference(f.evaluate(queries), expected) / scale);
  }
  console.log(`worst ${worst.toExponential(1)}`);
  expect(worst).toBeLessThan(1e-9);
});

/** Points that determine a quadratic: any, and a lattice of their own. */
function withLattice({ dimension, points, values, queries }: PointSet): PointSet {
  const steps = Array.from({ length: 3 ** dimension }, (_, k) =>
    Array.from({ length: dimension }, (_, axis) => 100 + 7 * (Math.floor(k / 3 ** axis) % 3)),
  );
  return { dimension, points: [...points, ...steps.flat()], values: [...values, ...steps.map((_, k) => k % 4)], queries };
}

const anyData = pointSet().map(withLattice);
const anyMethod = fc.record({
  degree: fc.constantFrom(...degrees),
  weight: fc.constantFrom(...weights),
  power: fc.double({ min: 1.2, max: 8, noNaN: true }),
});

describe('properties', () => {
  test(`weights sum to 1 and give the value; singular ones interpolate (seed ${seed})`, () => {
    fc.assert(
      fc.property(anyData, anyMethod, (data, method) => {
        using f = hb.movingLeastSquares({ ...data, ...method });
        if (method.weight === 'inverse-distance') expect(Array.from(f.evaluate(data.points))).toEqual(data.values);
        const all = f.weights(data.queries);
        for (const [q, value] of f.evaluate(data.queries).entries()) {
          const row = all.subarray(q * f.size, (q + 1) * f.size);
          const size = row.reduce((sum, w) => sum + Math.abs(w), 0);
          expect(Math.abs(row.reduce((a, b) => a + b, 0) - 1)).toBeLessThan(1e-11 * size);
          expect(Math.abs(row.reduce((sum, w, k) => sum + w * (data.values[k] ?? 0), 0) - value)).toBeLessThan(1e-9 * size);
        }
      }),
      { seed, numRuns: 100 },
    );
  });

  test(`polynomials of the degree are reproduced by weights that reach everything (seed ${seed})`, () => {
    fc.assert(
      fc.property(anyData, fc.constantFrom(...degrees), fc.double({ min: 1, max: 6, noNaN: true }), (data, degree, power) => {
        const { dimension } = data;
        const polynomial = (x: readonly number[]) =>
          Array.from({ length: x.length / dimension }, (_, k) => {
            const [a = 0, b = 0, c = 0] = x.slice(k * dimension, (k + 1) * dimension);
            return 3 + (degree > 0 ? a - 2 * b + 0.5 * c : 0) + (degree > 1 ? 0.1 * a * a - 0.2 * b * c + 0.05 * a * b : 0);
          });
        using f = hb.movingLeastSquares({ ...data, values: polynomial(data.points), degree, power });
        const apart = largestDifference(f.evaluate(data.queries), polynomial(data.queries));
        expect(apart).toBeLessThan(1e-7);
      }),
      { seed, numRuns: 100 },
    );
  });

  test(`neither order, place nor scale matters (seed ${seed})`, () => {
    fc.assert(
      fc.property(anyData, anyMethod, (data, method) => {
        using f = hb.movingLeastSquares({ ...data, ...method });
        const { dimension } = data;
        const moved = (x: readonly number[]) => x.map((c, i) => 4 * c + (i % dimension) - 2);
        const rows = Array.from({ length: f.size }, (_, k) => data.points.slice(k * dimension, (k + 1) * dimension)).reverse();
        const values = data.values.toReversed();
        using g = hb.movingLeastSquares({ dimension, points: moved(rows.flat()), values, ...method });
        expect(g.width).toBeCloseTo(4 * f.width, 9);
        const sizes = Array.from(data.queries.keys()).filter((i) => i % dimension === 0);
        for (const first of sizes) {
          const query = data.queries.slice(first, first + dimension);
          const size = f.weights(query).reduce((sum, w) => sum + Math.abs(w), 0);
          expect(largestDifference(f.evaluate(query), g.evaluate(moved(query)))).toBeLessThan(1e-7 * size);
        }
      }),
      { seed, numRuns: 60 },
    );
  });
});

test('degree 0 is Shepard', () => {
  const data = { dimension: 2, points: [0, 0, 1, 0, 0, 1, 2, 3], values: [1, 5, -2, 4] };
  using f = hb.movingLeastSquares({ ...data, degree: 0, power: 3 });
  using g = hb.shepard({ ...data, power: 3 });
  const queries = [0.2, 0.3, 5, 5, 1, 0, -3, 2];
  expect(largestDifference(f.evaluate(queries), g.evaluate(queries))).toBeLessThan(1e-14);
  expect(largestDifference(f.gradient(queries), g.gradient(queries))).toBeLessThan(1e-14);
});

test('a line is followed beyond its ends, with its slope at the points', () => {
  using f = hb.movingLeastSquares({ dimension: 1, points: [0, 1, 3, 4], values: [0, 2, 6, 8] });
  expect(largestDifference(f.evaluate([-5, 2, 9]), [-10, 4, 18])).toBeLessThan(1e-13);
  expect(largestDifference(f.gradient([-5, 0, 2, 3, 9]), [2, 2, 2, 2, 2])).toBeLessThan(1e-13);
});

test('defaults, and the width that was chosen', () => {
  const data = { dimension: 1, points: [0, 1, 2, 3, 5], values: [2, 0, 1, 1, 3] };
  using f = hb.movingLeastSquares(data);
  using explicit = hb.movingLeastSquares({ ...data, ...MOVING_LEAST_SQUARES_DEFAULTS });
  expect(explicit.evaluate([0.4, 7])).toEqual(f.evaluate([0.4, 7]));
  expect(f.width).toBe(0);
  for (const degree of degrees) {
    using gaussian = hb.movingLeastSquares({ ...data, degree, weight: 'gaussian' });
    using wendland = hb.movingLeastSquares({ ...data, degree, weight: 'wendland' });
    using given = hb.movingLeastSquares({ ...data, degree, weight: 'gaussian', width: 0.7 });
    expect(gaussian.width).toBeCloseTo((2 + degree) * 1.2, 12);
    expect(wendland.width).toBeCloseTo(2 * gaussian.width, 12);
    expect(given.width).toBeCloseTo(0.7, 12);
  }
});

describe('bad input is named', () => {
  const data = { dimension: 2, points: [0, 0, 1, 0, 0, 1, 1, 1, 2, 3, 4, 1, 3, 3], values: [1, 5, -2, 4, 0, 1, 2] };
  const cases: [string, Partial<MovingLeastSquaresOptions>, string, RegExp][] = [
    ['an unknown weight', { weight: 'toString' as 'gaussian' }, 'invalid-option', /"toString"/],
    ['a degree of 3', { degree: 3 as 2 }, 'invalid-option', /degree" is 3/],
    ['a power of 0', { power: 0 }, 'invalid-option', /power" is 0/],
    ['a negative epsilon', { epsilon: -1 }, 'invalid-option', /epsilon" is -1/],
    ['a width of 0', { weight: 'gaussian', width: 0 }, 'invalid-option', /width" is 0/],
    ['an infinite width', { weight: 'gaussian', width: Number.POSITIVE_INFINITY }, 'invalid-option', /width/],
    ['two values at one place', { points: [0, 0, 1, 0, 0, 1, 1, 0], values: [1, 2, 3, 4] }, 'point-duplicate', /Point 3/],
  ];
  test.each(cases)('%s', (_, options, code, message) => {
    const error = errorOf(() => hb.movingLeastSquares({ ...data, ...options }));
    expect(error.code).toBe(code);
    expect(error.message).toMatch(message);
    expect(error.remedy).not.toBe('');
  });
});
