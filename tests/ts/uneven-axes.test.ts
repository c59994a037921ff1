// Axes in units that have nothing in common: what coincides is judged on each, and every method keeps them apart.
import { describe, expect, test } from 'vitest';
import { type Interpolant, load, type RbfWarning, type ScatteredData } from '../../wasm/ts/index.ts';
import { errorOf, expectClose, random } from './support/scattered.ts';

const hb = await load();
const seed = 20261129;
const quiet = () => {};

/** Every method that reproduces linear functions, of the plane unless it says otherwise. */
const linear: Record<string, (data: ScatteredData) => Interpolant> = {
  rbf: (data) => hb.rbf({ ...data, onWarning: quiet }),
  'rbf, cubic': (data) => hb.rbf({ ...data, kernel: 'cubic', onWarning: quiet }),
  'rbf, multiquadric': (data) => hb.rbf({ ...data, kernel: 'multiquadric', degree: 1, onWarning: quiet }),
  tensionSpline: (data) => hb.tensionSpline({ ...data, onWarning: quiet }),
  movingLeastSquares: (data) => hb.movingLeastSquares(data),
  simplexLinear: (data) => hb.simplexLinear(data),
  naturalNeighbor: (data) => hb.naturalNeighbor(data),
};
const all = { ...linear, shepard: (data: ScatteredData) => hb.shepard(data) };
const sizes = [
  [8e9, 1],
  [1, 8e9],
  [1e12, 1e-12],
  [1e-12, 1],
  [3e5, 1],
] as const;

/** A table of 5 × 5 places. */
function table([width, height]: readonly [number, number], from: readonly [number, number] = [0, 0]): number[] {
  return Array.from({ length: 25 }, (_, k) => [from[0] + (width * Math.floor(k / 5)) / 4, from[1] + (height * (k % 5)) / 4]).flat();
}

describe.each(Object.entries(all))('%s', (name, make) => {
  test('passes through a table of any sizes, and reproduces what is linear in both', () => {
    for (const size of sizes) {
      const points = table(size);
      const curved = Array.from({ length: 25 }, (_, k) => Math.sin(k) + (k % 5) ** 2);
      using through = make({ dimension: 2, points, values: curved });
      expectClose(through.evaluate(points), curved, 1e-5, `${size}`);
      if (!(name in linear)) continue;
      using flat = make({ dimension: 2, points, values: Array.from({ length: 25 }, (_, k) => Math.floor(k / 5) + 10 * (k % 5)) });
      const queries = [size[0] / 4, size[1] / 2, size[0] / 8, size[1] / 8, 0.9 * size[0], 0.3 * size[1]];
      // SciPy 1.17, LinearNDInterpolator with and without rescale: 21, 5.5, 15.6.
      expectClose(flat.evaluate(queries), [21, 5.5, 15.6], 1e-6, `${size}`);
    }
  });

  test(`scattered places too, in three dimensions where it can (seed ${seed})`, () => {
    const next = random(seed);
    for (const [x, y, z] of [
      [1e9, 1, 1e-6],
      [1, 1e-9, 1e9],
    ] as const) {
      const d = name === 'naturalNeighbor' ? 2 : 3;
      const size = [x, y, z].slice(0, d);
      const place = () => size.map((s) => s * next.number());
      const points = Array.from({ length: 40 }, place);
      const f = (p: readonly number[]) => p.reduce((sum, c, axis) => sum + ((axis + 1) * c) / (size[axis] ?? 1), 2);
      using made = make({ dimension: d, points: points.flat(), values: points.map(f) });
      expectClose(made.evaluate(points.flat()), points.map(f), 1e-6);
      if (!(name in linear)) continue;
      const inside = Array.from({ length: 10 }, () => {
        const w = points.slice(0, 8).map(() => next.number() ** 2);
        const total = w.reduce((a, b) => a + b);
        return size.map((_, axis) => w.reduce((sum, one, k) => sum + (one / total) * (points[k]?.[axis] ?? 0), 0));
      });
      expectClose(made.evaluate(inside.flat()), inside.map(f), 1e-5);
    }
  });

  test('points that differ on one axis alone, by little, are two; the same on all are one', () => {
    const points = [1e9, 0, 9e9, 1, 5e9, 0.5, 5e9, 0.5 + 1e-6];
    using two = make({ dimension: 2, points, values: [0, 1, 2, 3] });
    expect(two.merged).toEqual([]);
    expectClose(two.evaluate(points), [0, 1, 2, 3], 1e-5);
    const error = errorOf(() => make({ dimension: 2, points: [...points.slice(0, 6), 5e9, 0.5], values: [0, 1, 2, 3] }));
    expect(error.code).toBe('point-duplicate');
    expect(error.culprit).toEqual({ kind: 'point', index: 3 });
  });

  test('an axis with one value, and an offset much larger than the extent', () => {
    const flat = [1e9, 7, 2e9, 7, 4e9, 7, 3e9, 7];
    using line = make({ dimension: 2, points: flat, values: [1, 2, 4, 3] });
    expectClose(line.evaluate(flat), [1, 2, 4, 3], 1e-6);
    if (name in linear) expectClose(line.evaluate([2.5e9, 7]), [2.5], 1e-6);
    const points = table([4e-3, 1], [1e9, 0]);
    const values = Array.from({ length: 25 }, (_, k) => Math.floor(k / 5) + 10 * (k % 5));
    using far = make({ dimension: 2, points, values });
    expectClose(far.evaluate(points), values, 1e-6);
  });
});

test('a metric decides what coincides, and makes valid what it evens out', () => {
  // On the diagonal both axes span 1e9; only across it do the points differ.
  const points = [0, 0, 1e9, 1e9, 0.1, -0.1, 1e9 + 0.1, 1e9 - 0.1];
  const along = (1 / 1e9) ** 2;
  const [a, b] = [(along + 1) / 2, (along - 1) / 2];
  using even = hb.rbf({ dimension: 2, points, values: [0, 1, 2, 3], metric: [a, b, b, a], onWarning: quiet });
  expect(even.merged).toEqual([]);
  const squeezed = { dimension: 2, points: [0, 0, 1, 0, 0, 1], values: [0, 1, 0], metric: [1, 0, 0, 1], kernel: 'cubic' } as const;
  using plain = hb.rbf(squeezed);
  expect(plain.merged).toEqual([]);
});

test('is said, with the metric that evens the axes out; with a metric it is not', () => {
  const data = { dimension: 2, points: table([8e9, 1]), values: Array.from({ length: 25 }, (_, k) => Math.cos(k)) };
  const told = (metric?: readonly number[]) => {
    const warnings: RbfWarning[] = [];
    using f = hb.rbf({ ...data, ...(metric && { metric }), onWarning: (warning) => warnings.push(warning) });
    expectClose(f.evaluate(data.points), data.values, 1e-6);
    return warnings;
  };
  const [warning, ...others] = told();
  expect(others).toEqual([]);
  expect(warning?.code).toBe('uneven-axes');
  expect(warning?.message).toContain('Axis 1 spans 1 and axis 0 8e+9');
  expect(told(warning?.suggestion?.metric)).toEqual([]);
});

test('findOutliers names the moved entry of a table', () => {
  for (const size of sizes) {
    const values = Array.from({ length: 25 }, (_, k) => Math.sin(Math.floor(k / 5) / 2) + Math.cos((k % 5) / 2));
    values[13] = (values[13] ?? 0) + 2;
    expect(hb.findOutliers({ dimension: 2, points: table(size), values }).outliers).toEqual([13]);
  }
});

describe('poseSpace', () => {
  const examples = (points: readonly number[], d = 2) =>
    Array.from({ length: points.length / d }, (_, k) => ({
      name: `${k}`,
      at: points.slice(d * k, d * k + d),
      shape: [Math.sin(k), k],
    }));

  test('keeps a table of any sizes apart, without scales', () => {
    for (const size of sizes) {
      const points = table(size);
      using space = hb.poseSpace({ dimensions: ['frequency', 'bias'], examples: examples(points) });
      for (let k = 0; k < 25; k++) expect(space.evaluate(points.slice(2 * k, 2 * k + 2))[1]).toBeCloseTo(k, 6);
      const half = space.evaluate([size[0] / 2, size[1] / 8]);
      expect(half.every(Number.isFinite)).toBe(true);
    }
  });

  test(`with scales is the one of coordinates / scale (seed ${seed})`, () => {
    const next = random(seed + 1);
    for (const method of ['cardinal', 'normalized'] as const)
      for (const scales of [
        [2, 0.5],
        [1e9, 3],
        [1e-12, 1e12],
      ] as const) {
        const points = next.numbers(2 * 9);
        const stretched = points.map((x, i) => x * (scales[i % 2] ?? 1));
        const dimensions = ['a', 'b'].map((name, axis) => ({ name, scale: scales[axis] ?? 1 }));
        using scaled = hb.poseSpace({ dimensions, examples: examples(stretched), method });
        using plain = hb.poseSpace({ dimensions: ['a', 'b'], examples: examples(points), method });
        expect(scaled.dimensions).toEqual(['a', 'b']);
        for (let q = 0; q < 8; q++) {
          const at = next.numbers(2);
          expectClose(scaled.weights(at.map((x, i) => x * (scales[i] ?? 1))), plain.weights(at), 1e-8);
        }
      }
  });

  test(`a scale of 1 is none, and equal scales change nothing that is automatic (seed ${seed})`, () => {
    const points = random(seed + 2).numbers(2 * 7);
    const at = [0.2, -0.4];
    using plain = hb.poseSpace({ dimensions: ['a', 'b'], examples: examples(points) });
    using ones = hb.poseSpace({ dimensions: [{ name: 'a' }, { name: 'b', scale: 1 }], examples: examples(points) });
    using sevens = hb.poseSpace({ dimensions: ['a', 'b'].map((name) => ({ name, scale: 7 })), examples: examples(points) });
    expect(ones.weights(at)).toEqual(plain.weights(at));
    expectClose(sevens.weights(at), plain.weights(at), 1e-9);
  });

  test.each([0, -1, Number.NaN, Number.POSITIVE_INFINITY])('refuses the scale %s by its place', (scale) => {
    const error = errorOf(() => hb.poseSpace({ dimensions: ['a', { name: 'turn', scale }], examples: examples([0, 0, 1, 1]) }));
    expect(error.code).toBe('invalid-option');
    expect(error.message).toContain('"dimensions[1].scale"');
    expect(error.message).toContain(`${scale}`);
  });

  test('one place is what is one on every axis', () => {
    const at = [1e9, 0, 9e9, 1, 9e9, 1 - 1e-6];
    using space = hb.poseSpace({ dimensions: ['a', 'b'], examples: examples(at) });
    expect(space.merged).toEqual([]);
    const error = errorOf(() => hb.poseSpace({ dimensions: ['a', 'b'], examples: examples([1e9, 0, 9e9, 1, 9e9, 1 - 1e-12]) }));
    expect(error.code).toBe('example-duplicate');
  });
});
