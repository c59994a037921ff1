import { readFileSync } from 'node:fs';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { load, TENSION_SPLINE_DEFAULTS, type TensionSplineOptions } from '../../wasm/ts/index.ts';
import { errorOf, expectClose, largest, random, rotate, rotation } from './support/scattered.ts';

interface Case {
  readonly dimension: number;
  readonly alpha: number;
  readonly beta: number;
  readonly gamma: number;
  readonly smoothing: number;
  readonly points: number[];
  readonly values: number[];
  readonly queries: number[];
  readonly expected: number[];
  /** What the oracle knows of its own error. */
  readonly accuracy: number;
}

const read = <T>(name: string) => JSON.parse(readFileSync(new URL(`../oracles/${name}.json`, import.meta.url), 'utf8')) as T[];
const hb = await load();
const seed = 20140728;
const quiet = () => {};

describe('oracles', () => {
  test.each(
    read<Case>('tension_spline').map((c) => [`${c.dimension}D α ${c.alpha} β ${c.beta} γ ${c.gamma} σ ${c.smoothing}`, c] as const),
  )('%s: what minimizing eq. (2) on ever finer grids gives', (_, { queries, expected, accuracy, ...options }) => {
    using spline = hb.tensionSpline(options);
    expect(largest(spline.evaluate(queries).map((x, i) => x - (expected[i] ?? Number.NaN)))).toBeLessThan(accuracy + 1e-10);
  });

  test('zero-slope ends: clamped cubics and what minimizing their functional gives', () => {
    for (const { queries, expected, accuracy, points, values, alpha, beta } of read<Case>('tension_spline_1d')) {
      using spline = hb.tensionSpline({ dimension: 1, points, values, alpha, beta, ends: 'zero-slope' });
      const error = largest(spline.evaluate(queries).map((x, i) => x - (expected[i] ?? Number.NaN)));
      expect(error).toBeLessThan(4 * accuracy + 1e-12);
      expect(spline.report()).toBeUndefined();
    }
  });
});

describe('tensionSpline()', () => {
  const weights = fc.record({
    alpha: fc.double({ min: 0.01, max: 100, noNaN: true }),
    beta: fc.oneof(fc.constant(0), fc.double({ min: 1e-3, max: 100, noNaN: true })),
    gamma: fc.oneof(fc.constant(0), fc.double({ min: 1e-3, max: 100, noNaN: true })),
  });

  test(`passes through vector values in 1 to 3 dimensions, whatever the weights; its weights say the same (seed ${seed})`, () => {
    fc.assert(
      fc.property(weights, fc.integer({ min: 1, max: 3 }), fc.nat(), (w, dimension, start) => {
        const next = random(start);
        const points = next.numbers(12 * dimension);
        const values = next.numbers(24);
        using spline = hb.tensionSpline({ dimension, points, values, ...w, onWarning: quiet });
        const tolerance = 1e-9 + 1e-15 * (spline.report()?.condition ?? 0);
        expectClose(spline.evaluate(points), values, tolerance);
        const query = next.numbers(dimension);
        const cardinal = spline.weights(query);
        const sums = [0, 1].map((j) => cardinal.reduce((sum, weight, k) => sum + weight * (values[2 * k + j] ?? 0), 0));
        expectClose(spline.evaluate(query), sums, tolerance);
        const h = 1e-5;
        const gradient = spline.gradient(query);
        for (let axis = 0; axis < dimension; axis++) {
          const [up, down] = [h, -h].map((step) => spline.evaluate(query.map((x, i) => x + (i === axis ? step : 0))));
          for (const j of [0, 1]) {
            const difference = ((up?.[j] ?? 0) - (down?.[j] ?? 0)) / (2 * h);
            expect(Math.abs((gradient[j * dimension + axis] ?? 0) - difference)).toBeLessThan(
              1e-5 * (1 + largest(gradient)) + tolerance / h,
            );
          }
        }
      }),
      { seed, numRuns: 60 },
    );
  });

  test(`turns and moves with its points in space, and does not mind their order (seed ${seed})`, () => {
    const next = random(seed);
    for (const w of [{ beta: 2, gamma: 3 }, { beta: 1 }, { gamma: 1, smoothing: 0.1 }, {}]) {
      const points = next.numbers(60);
      const values = next.numbers(20);
      const queries = next.numbers(15);
      const turn = rotation(next);
      const move = (p: number[]) => rotate(turn, p).map((x, i) => x + ([3, -20, 7][i % 3] ?? 0));
      const order = next.permutation(20);
      using spline = hb.tensionSpline({ dimension: 3, points, values, ...w });
      using moved = hb.tensionSpline({ dimension: 3, points: move(points), values, ...w });
      using shuffled = hb.tensionSpline({
        dimension: 3,
        points: order.flatMap((i) => points.slice(3 * i, 3 * i + 3)),
        values: order.map((i) => values[i] ?? 0),
        ...w,
      });
      expectClose(moved.evaluate(move(queries)), spline.evaluate(queries), 1e-9);
      expectClose(shuffled.evaluate(queries), spline.evaluate(queries), 1e-9);
    }
  });

  test('zero-slope ends are flat and constant beyond; natural ends go on, straight without tension', () => {
    const data = { dimension: 1, points: [0, 1, 2.5, 4], values: [0, 2, 1, 3] };
    using flat = hb.tensionSpline({ ...data, beta: 2, ends: 'zero-slope' });
    expectClose(flat.gradient([0, 4]), [0, 0], 1e-12);
    expectClose(flat.evaluate([-5, 9]), [0, 3], 1e-12);
    using natural = hb.tensionSpline(data);
    const [a = 0, b = 0, c = 0] = natural.evaluate([5, 6, 7]);
    expect(c - 2 * b + a).toBeCloseTo(0, 9);
    expect(b - a).not.toBeCloseTo(0, 1);
    using fading = hb.tensionSpline({ ...data, gamma: 1 });
    expectClose(fading.evaluate([-60, 60]), [0, 0], 1e-12);
  });

  test('tension takes the overshoot out of a step, in the plane', () => {
    const grid = Array.from({ length: 36 }, (_, i) => [i % 6, Math.floor(i / 6)]).flat();
    const step = Array.from({ length: 36 }, (_, i) => (i % 6 < 3 ? 0 : 1));
    const along = Array.from({ length: 101 }, (_, i) => [i / 20, 2.5]).flat();
    const overshoots = [0, 3, 30, 300].map((beta) => {
      using spline = hb.tensionSpline({ dimension: 2, points: grid, values: step, beta });
      return Math.max(...spline.evaluate(along)) - 1;
    });
    for (let i = 1; i < overshoots.length; i++) expect(overshoots[i]).toBeLessThan(0.9 * (overshoots[i - 1] ?? 0));
  });

  test('reports, and warns of points that nearly coincide', () => {
    const warnings: string[] = [];
    const onWarning = ({ code }: { code: string }) => warnings.push(code);
    using spline = hb.tensionSpline({
      dimension: 2,
      points: [0, 0, 1, 0, 0, 1, 1, 1 + 1e-5, 1, 1],
      values: [0, 1, 2, 3, 3],
      beta: 1,
      onWarning,
    });
    expect(spline.report()).toMatchObject({ kernel: 'tension', degree: 0, centers: 5 });
    expect(spline.report()?.residual).toBeLessThan(1e-9);
    expect(warnings).toContain('near-duplicates');
    expect(TENSION_SPLINE_DEFAULTS).toEqual({ alpha: 1, beta: 0, gamma: 0, smoothing: 0, ends: 'natural' });
  });

  const fine = { dimension: 2, points: [0, 0, 1, 0, 0, 1], values: [1, 2, 3] };
  const onLine = { dimension: 1, points: [0, 1, 2], values: [1, 2, 3] };
  test.each<[string, Partial<TensionSplineOptions>, string]>([
    ['a negative weight', { alpha: -1 }, 'invalid-option'],
    ['NaN', { beta: Number.NaN }, 'invalid-option'],
    ['an infinite weight', { gamma: Number.POSITIVE_INFINITY }, 'invalid-option'],
    ['no weight at all', { alpha: 0 }, 'invalid-option'],
    ['no curvature in the plane', { alpha: 0, beta: 1 }, 'invalid-option'],
    ['negative smoothing', { smoothing: -1 }, 'invalid-option'],
    ['four dimensions', { dimension: 4, points: [0, 0, 0, 0], values: [1] }, 'invalid-shape'],
    ['zero-slope ends in the plane', { ends: 'zero-slope' }, 'invalid-shape'],
    ['zero-slope ends with gamma', { ...onLine, ends: 'zero-slope', gamma: 1 }, 'invalid-option'],
    ['zero-slope ends with smoothing', { ...onLine, ends: 'zero-slope', smoothing: 1 }, 'invalid-option'],
    ['zero-slope ends without alpha', { ...onLine, ends: 'zero-slope', alpha: 0, beta: 1 }, 'invalid-option'],
    ['unknown ends', { ends: 'loose' as 'natural' }, 'invalid-option'],
    ['two values at one place', { points: [0, 0, 1, 0, 1, 0] }, 'point-duplicate'],
    ['a NaN point', { points: [0, 0, 1, Number.NaN, 0, 1] }, 'point-not-finite'],
    ['no points', { points: [], values: [] }, 'points-too-few'],
    ['more points than memory', { points: new Float64Array(40000), values: new Float64Array(20000) }, 'out-of-memory'],
  ])('refuses %s with a sentence', (_, options, code) => {
    const error = errorOf(() => hb.tensionSpline({ ...fine, ...options, onWarning: quiet }));
    expect(error.code).toBe(code);
    expect(error.message).toMatch(/\.$/);
    expect(error.remedy).toMatch(/\.$/);
  });
});
