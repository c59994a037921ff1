import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import { load } from '../../wasm/ts/index.ts';
import { errorOf, expectClose, largest, random, rotate, rotation } from './support/scattered.ts';

const hb = await load();
const seed = 41;

interface Case {
  readonly dimension: number;
  readonly points: number[];
  readonly values: number[];
  readonly queries: number[];
  readonly inside: number[];
  readonly expected: number[];
}
const oracle = JSON.parse(readFileSync(new URL('../oracles/simplex_linear.json', import.meta.url), 'utf8')) as Case[];

describe("SciPy's LinearNDInterpolator", () => {
  test.each(oracle.map((item, i) => [item.points.length / item.dimension, item.dimension, i] as const))(
    '%i points in %i dimensions: equal to 1e-9, inside the hull and, where quadprog knows the nearest point, outside',
    (_count, _dimension, i) => {
      const { dimension, points, values, queries, inside, expected } = oracle[i] as Case;
      using nearest = hb.simplexLinear({ dimension, points, values });
      using nan = hb.simplexLinear({ dimension, points, values, outside: 'nan' });
      const got = nearest.evaluate(queries);
      expectClose(got, expected, 1e-9);
      nan.evaluate(queries).forEach((value, q) => {
        expect(value).toBe(inside[q] ? got[q] : Number.NaN);
      });
    },
  );
});

describe('weights', () => {
  const next = random(seed);
  test.each([1, 2, 3, 4, 6])(
    `in %i dimensions: convex, summing to 1, reproducing x, 1 at the own point (seed ${seed})`,
    (dimension) => {
      const count = 12 + 6 * dimension;
      const points = next.numbers(count * dimension);
      using f = hb.simplexLinear({ dimension, points, values: next.numbers(count) });
      expectClose(
        f.weights(points),
        Array.from({ length: count * count }, (_, i) => (i % (count + 1) === 0 ? 1 : 0)),
        1e-9,
      );
      const queries = next.numbers(20 * dimension).map((x) => 0.4 * x);
      const weights = f.weights(queries);
      for (let q = 0; q < 20; q++) {
        const w = [...weights.slice(q * count, q * count + count)];
        expect(Math.min(...w)).toBeGreaterThanOrEqual(0);
        expect(w.reduce((a, b) => a + b)).toBeCloseTo(1, 12);
        expect(w.filter((x) => x > 0).length).toBeLessThanOrEqual(dimension + 1);
      }
    },
  );

  test('of cospherical points share alike: a square, a cube, a hexagon', () => {
    const cube = Array.from({ length: 8 }, (_, i) => [i & 1, (i >> 1) & 1, (i >> 2) & 1]).flat();
    for (const [dimension, points] of [
      [2, [0, 0, 1, 0, 1, 1, 0, 1]],
      [3, cube],
      [2, Array.from({ length: 6 }, (_, k) => [0.5 + Math.cos((k * Math.PI) / 3), 0.5 + Math.sin((k * Math.PI) / 3)]).flat()],
    ] as const) {
      const count = points.length / dimension;
      using f = hb.simplexLinear({ dimension, points, values: Array(count).fill(0) });
      expectClose(f.weights(Array(dimension).fill(0.5)), Array(count).fill(1 / count), 1e-12);
    }
  });

  test(`of a grid do not depend on the order of points or queries, nor on a rotation (seed ${seed})`, () => {
    const grid = Array.from({ length: 27 }, (_, i) => [i % 3, Math.floor(i / 3) % 3, Math.floor(i / 9)]).flat();
    const values = next.numbers(27);
    const queries = next.numbers(30 * 3).map((x) => 1 + x);
    using f = hb.simplexLinear({ dimension: 3, points: grid, values });
    const expected = f.evaluate(queries);
    const order = next.permutation(27);
    using shuffled = hb.simplexLinear({
      dimension: 3,
      points: order.flatMap((i) => grid.slice(3 * i, 3 * i + 3)),
      values: order.map((i) => values[i] ?? 0),
    });
    for (let q = 29; q >= 0; q--)
      expect(shuffled.evaluate(queries.slice(3 * q, 3 * q + 3))[0]).toBeCloseTo(expected[q] ?? Number.NaN, 10);
    const turn = rotation(next);
    using turned = hb.simplexLinear({ dimension: 3, points: rotate(turn, grid), values });
    expectClose(turned.evaluate(rotate(turn, queries)), expected, 1e-9);
    using moved = hb.simplexLinear({ dimension: 3, points: grid.map((x) => 1e3 * x - 5e3), values });
    expectClose(moved.evaluate(queries.map((x) => 1e3 * x - 5e3)), expected, 1e-8);
    expect(largest(expected)).toBeLessThanOrEqual(largest(values));
  });
});

test('points that span less: on a line, two, one', () => {
  using line = hb.simplexLinear({ dimension: 2, points: [0, 0, 1, 1, 3, 3], values: [0, 1, 5] });
  expectClose(line.evaluate([0.5, 0.5, 2, 2, 3, 1, 9, 9, -1, -2]), [0.5, 3, 3, 5, 0], 1e-12);
  using strict = hb.simplexLinear({ dimension: 2, points: [0, 0, 1, 1, 3, 3], values: [0, 1, 5], outside: 'nan' });
  expect([...strict.evaluate([0.5, 0.5, 3, 1])]).toEqual([0.5, Number.NaN]);
  using one = hb.simplexLinear({ dimension: 3, points: [1, 2, 3], values: [7] });
  expect([...one.evaluate([0, 0, 0, 1, 2, 3])]).toEqual([7, 7]);
});

test('bad input is named; there is no gradient', () => {
  const data = { dimension: 2, points: [0, 0, 1, 0, 0, 1], values: [0, 1, 2] };
  using f = hb.simplexLinear(data);
  expect(errorOf(() => f.gradient([0.2, 0.2])).code).toBe('invalid-option');
  expect(errorOf(() => f.evaluate([0.2, Number.NaN])).culprit).toEqual({ kind: 'query', index: 0 });
  expect(errorOf(() => hb.simplexLinear({ ...data, outside: 'far' as 'nan' })).code).toBe('invalid-option');
  expect(errorOf(() => hb.simplexLinear({ ...data, points: [0, 0, 1, 0, 0, 0] })).code).toBe('point-duplicate');
  using merged = hb.simplexLinear({ ...data, points: [...data.points, 1, 0], values: [...data.values, 1] });
  expect(merged.merged).toEqual([{ point: 3, into: 1 }]);
});
