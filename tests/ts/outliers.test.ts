import { describe, expect, test } from 'vitest';
import { load, type OutlierMethod } from '../../wasm/ts/index.ts';
import { errorOf, random } from './support/scattered.ts';

const hb = await load();
const seed = 531;
const methods: OutlierMethod[] = ['row-sum', 'leave-one-out', 'residual'];

const curve = (x: number) => Math.sin(0.6 * x) + 0.2 * x;
const surface = (x: number, y: number) => Math.sin(2 * x) + x * y;

describe.each(methods)('%s', (method) => {
  test('finds the one point that was moved, on a curve (Fig. 21)', () => {
    const points = Array.from({ length: 12 }, (_, i) => i + 0.2 * Math.sin(7 * i));
    // Row sums only approximate what a point costs: they stand out less, and beside a steep slope they name a neighbor.
    const rough = method === 'row-sum';
    for (const bad of rough ? [3, 6] : [3, 6, 8]) {
      const values = points.map((x, i) => curve(x) + (i === bad ? 2.5 : 0));
      const report = hb.findOutliers({ dimension: 1, points, values, kernel: 'cubic', method, ...(rough && { threshold: 1.5 }) });
      expect(report.outliers[0]).toBe(bad);
      expect(report.heights[0]).toBeGreaterThan(report.threshold);
      expect(report.method).toBe(method);
      expect(report.scores.indexOf(Math.max(...report.scores))).toBe(bad);
    }
  });

  test(`finds three of forty on a surface, in whatever order they are given (seed ${seed})`, () => {
    const next = random(seed);
    const points = next.numbers(80);
    const bad = [4, 17, 31];
    const values = Array.from({ length: 40 }, (_, i) => {
      const value = surface(points[2 * i] ?? 0, points[2 * i + 1] ?? 0);
      return bad.includes(i) ? [value + 3, -value] : [value, -value];
    }).flat();
    const options = {
      dimension: 2,
      points,
      values,
      kernel: 'thin-plate',
      smoothing: 0.01,
      method,
      threshold: method === 'row-sum' ? 3 : 8,
    } as const;
    const found = hb.findOutliers(options);
    expect(found.outliers.slice(0, 3).toSorted((a, b) => a - b)).toEqual(bad);
    expect(found.outliers.length).toBeLessThan(6);
    expect(found.smoothing).toBe(0.01);
    const order = next.permutation(40);
    const shuffled = hb.findOutliers({
      ...options,
      points: order.flatMap((i) => points.slice(2 * i, 2 * i + 2)),
      values: order.flatMap((i) => values.slice(2 * i, 2 * i + 2)),
    });
    expect(shuffled.outliers.map((i) => order[i])).toEqual(found.outliers);
  });

  test('finds none in smooth data, at most as many as it may, and none among three points', () => {
    const points = Array.from({ length: 40 }, (_, i) => i / 2);
    const options = { dimension: 1, points, values: points.map((x) => 2 * x - 1), kernel: 'cubic', method } as const;
    expect(hb.findOutliers(options).outliers).toEqual([]);
    const two = points.map((x, i) => (i === 10 || i === 30 ? 30 : 0) + 2 * x);
    expect(hb.findOutliers({ ...options, values: two, most: 1 }).outliers).toHaveLength(1);
    expect(hb.findOutliers({ ...options, values: two, most: 0 }).outliers).toEqual([]);
    expect(hb.findOutliers({ ...options, points: [0, 1, 2], values: [0, 9, 0] }).outliers).toEqual([]);
  });
});

test(`what the norm loses without a point is what a refit says (seed ${seed})`, () => {
  const next = random(seed + 1);
  const points = next.numbers(2 * 12);
  const values = next.numbers(12);
  const drop = 5;
  for (const [kernel, sign] of [
    ['gaussian', 1],
    ['multiquadric', -1],
    ['thin-plate', 1],
  ] as const) {
    const options = { dimension: 2, kernel, width: 0.5, onWarning: () => {} } as const;
    // cᵀRc = cᵀf, since the tail drops out by the side conditions.
    const norm = (p: number[], f: number[]) => {
      using rbf = hb.rbf({ ...options, points: p, values: f });
      return sign * rbf.coefficients().reduce((sum, c, i) => sum + c * (f[i] ?? 0), 0);
    };
    const { scores } = hb.findOutliers({ ...options, points, values, method: 'leave-one-out', smoothing: 0 });
    const without = norm(
      points.filter((_, i) => i >> 1 !== drop),
      values.filter((_, i) => i !== drop),
    );
    expect((scores[drop] ?? 0) ** 2).toBeCloseTo(norm(points, values) - without, 6);
  }
});

test(`row sums add up to the norm (seed ${seed})`, () => {
  const next = random(seed + 2);
  const points = Array.from({ length: 9 }, (_, i) => i + 0.3 * next.number());
  const values = next.numbers(9);
  const options = { dimension: 1, points, values, kernel: 'gaussian', width: 0.8, onWarning: () => {} } as const;
  using rbf = hb.rbf(options);
  const c = rbf.coefficients();
  const expected = points.map((x, i) => {
    const row = points.reduce((sum, y, j) => sum + (i === j ? 0.5 : 1) * Math.exp(-(((x - y) / 0.8) ** 2)) * (c[j] ?? 0), 0);
    const part = (c[i] ?? 0) * row;
    return Math.sign(part) * Math.sqrt(Math.abs(part));
  });
  const { scores } = hb.findOutliers({ ...options, method: 'row-sum', smoothing: 0 });
  scores.forEach((score, i) => {
    expect(score).toBeCloseTo(expected[i] ?? Number.NaN, 9);
  });
});

test('bad options are named', () => {
  const data = { dimension: 1, points: [0, 1, 2, 3, 4], values: [0, 0, 5, 0, 0], kernel: 'cubic' } as const;
  expect(errorOf(() => hb.findOutliers({ ...data, method: 'guess' as 'residual' })).code).toBe('invalid-option');
  expect(errorOf(() => hb.findOutliers({ ...data, threshold: 0 })).code).toBe('invalid-option');
  expect(errorOf(() => hb.findOutliers({ ...data, threshold: Number.NaN })).code).toBe('invalid-option');
  expect(errorOf(() => hb.findOutliers({ ...data, most: -1 })).code).toBe('invalid-option');
  expect(errorOf(() => hb.findOutliers({ ...data, values: [0, Number.NaN, 5, 0, 0] })).culprit).toEqual({
    kind: 'point',
    index: 1,
  });
  expect(hb.findOutliers({ ...data, points: [0, 1], values: [0, 1], kernel: 'quintic' }).outliers).toEqual([]);
  expect(errorOf(() => hb.findOutliers({ ...data, kernel: () => Number.NaN })).code).toBe('kernel-failed');
});
