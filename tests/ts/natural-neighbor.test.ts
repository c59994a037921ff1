import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { HandlebodyError, load, NATURAL_NEIGHBOR_DEFAULTS, type NaturalNeighborOptions } from '../../wasm/ts/index.ts';

const hb = await load();
const seed = 19811118;
const corners = [1, 1, -1, 1, -1, -1, 1, -1];

function errorOf(run: () => unknown): HandlebodyError {
  try {
    run();
  } catch (error) {
    if (error instanceof HandlebodyError) return error;
    throw error;
  }
  throw new Error('expected a HandlebodyError');
}

const coordinate = fc.integer({ min: -20, max: 20 }).map((k) => k / 8);
const place = fc.tuple(coordinate, coordinate);
/** Points with values, on a grid of eighths: many are cocircular, on a line or twins. */
const data = fc.uniqueArray(fc.record({ at: place, value: fc.integer({ min: -9, max: 9 }) }), {
  minLength: 1,
  maxLength: 25,
  selector: ({ at }) => at.join(),
});

const options = (points: { at: [number, number]; value: number }[]): NaturalNeighborOptions => ({
  dimension: 2,
  points: points.flatMap(({ at }) => at),
  values: points.map(({ value }) => value),
});

describe('natural neighbor interpolation', () => {
  test('in a square it is bilinear, and so are its gradients', () => {
    using f = hb.naturalNeighbor({ dimension: 2, points: corners, values: [4, 0, 0, 0] });
    const queries = [0, 0, 0.5, -0.25, -0.75, 0.125];
    for (let q = 0; q < 3; q++) {
      const [x = 0, y = 0] = queries.slice(2 * q);
      expect(f.evaluate(queries)[q]).toBeCloseTo((1 + x) * (1 + y), 14);
      expect(f.gradient(queries)[2 * q]).toBeCloseTo(1 + y, 13);
      expect(f.gradient(queries)[2 * q + 1]).toBeCloseTo(1 + x, 13);
    }
  });

  test(`weights: none negative, sum 1, own value at the points, mean the query inside (seed ${seed})`, () => {
    fc.assert(
      fc.property(data, fc.array(place, { minLength: 1, maxLength: 8 }), (points, queries) => {
        using f = hb.naturalNeighbor(options(points));
        using inside = hb.naturalNeighbor({ ...options(points), outside: 'nan' });
        f.evaluate(options(points).points).forEach((value, i) => {
          expect(value).toBe(points[i]?.value);
        });
        for (const query of queries) {
          const weights = [...f.weights(query)];
          const mean = (axis: 0 | 1) => weights.reduce((sum, w, i) => sum + w * (points[i]?.at[axis] ?? 0), 0);
          expect(Math.min(...weights)).toBeGreaterThanOrEqual(0);
          expect(weights.reduce((a, b) => a + b)).toBeCloseTo(1, 13);
          const [value = 0] = inside.evaluate(query);
          if (Number.isNaN(value)) continue;
          expect(value).toBe(f.evaluate(query)[0]);
          expect(mean(0)).toBeCloseTo(query[0], 10);
          expect(mean(1)).toBeCloseTo(query[1], 10);
        }
      }),
      { seed, numRuns: 150 },
    );
  });

  test(`a quarter turn, a mirror and another order of the points change nothing (seed ${seed})`, () => {
    fc.assert(
      fc.property(data, place, (points, [x, y]) => {
        using f = hb.naturalNeighbor(options(points));
        using turned = hb.naturalNeighbor(
          options(points.map(({ at: [a, b], value }) => ({ at: [-b, a] as [number, number], value }))),
        );
        using mirrored = hb.naturalNeighbor(
          options(points.map(({ at: [a, b], value }) => ({ at: [b, a] as [number, number], value })).reverse()),
        );
        const [value = 0] = f.evaluate([x, y]);
        expect(turned.evaluate([-y, x])[0]).toBeCloseTo(value, 10);
        expect(mirrored.evaluate([y, x])[0]).toBeCloseTo(value, 10);
      }),
      { seed, numRuns: 150 },
    );
  });

  test('outside the hull: the nearest point by default, NaN on demand', () => {
    const square = { dimension: 2, points: corners, values: [0, 1, 2, 3] } as const;
    using f = hb.naturalNeighbor(square);
    using nan = hb.naturalNeighbor({ ...square, outside: 'nan' });
    expect(NATURAL_NEIGHBOR_DEFAULTS.outside).toBe('nearest');
    expect([...f.evaluate([0, 7, 1, 0, 9, 9, -1e3, 0])].map((v) => Number(v.toFixed(12)))).toEqual([0.5, 1.5, 0, 1.5]);
    expect([...f.gradient([0.5, 7])].map((v) => Number(v.toFixed(12)) + 0)).toEqual([-0.5, 0]);
    expect([...nan.evaluate([0, 7, 1, 0])].map((v) => Number(v.toFixed(12)))).toEqual([Number.NaN, 1.5]);
    expect([...nan.gradient([0, 7])]).toEqual([Number.NaN, Number.NaN]);
  });

  test('no gradient at a point', () => {
    using f = hb.naturalNeighbor({ dimension: 2, points: [...corners, 0, 0], values: [0, 0, 0, 0, 1] });
    expect([...f.gradient([0, 0])]).toEqual([Number.NaN, Number.NaN]);
  });

  test('twins of equal values are merged', () => {
    using f = hb.naturalNeighbor({ dimension: 2, points: [...corners, 1, 1], values: [1, 2, 3, 4, 1] });
    expect(f.merged).toEqual([{ point: 4, into: 0 }]);
    expect(f.weights([0, 0])[4]).toBe(0);
  });

  test('bad input is named', () => {
    const flat = { dimension: 2, points: corners, values: [0, 1, 2, 3] } as const;
    const make = (change: object) => errorOf(() => hb.naturalNeighbor({ ...flat, ...change }));
    const space = make({ dimension: 3, points: [...corners, ...corners.slice(4)] });
    expect(space.code).toBe('invalid-shape');
    expect(space.remedy).toMatch(/simplexLinear\(\) or rbf\(\)/);
    expect(make({ outside: 'far' }).code).toBe('invalid-option');
    expect(make({ points: [1, 1, 1, 1, -1, -1, 1, -1] })).toMatchObject({
      code: 'point-duplicate',
      culprit: { kind: 'point', index: 1 },
    });
    expect(make({ values: [0, 1, Number.NaN, 3] })).toMatchObject({
      code: 'value-not-finite',
      culprit: { kind: 'point', index: 2 },
    });
    expect(make({ points: [], values: [] }).code).toBe('points-too-few');
    using f = hb.naturalNeighbor(flat);
    expect(errorOf(() => f.evaluate([0, 0, 0, Number.POSITIVE_INFINITY]))).toMatchObject({ culprit: { kind: 'query', index: 1 } });
  });
});
