// Points that do not determine the polynomials that a kernel wants: on a line, in a plane, too few. The tail is then the least-norm one.
import { describe, expect, test } from 'vitest';
import { KERNELS, type KernelName, load, type RbfOptions } from '../../wasm/ts/index.ts';
import { POSE_KERNELS } from './support/pose-kernels.ts';
import { expectClose, random, rotate, rotation } from './support/scattered.ts';

const hb = await load();
const seed = 20261130;
const names = Object.keys(KERNELS) as KernelName[];
const quiet = () => {};

test('a line of the plane under the default kernel: numpy’s least-norm thin plate gives 1.5 and 0.25', () => {
  const data = { dimension: 2, points: [0, 0, 1, 1, 2, 2, 3, 3], values: [0, 1, 2, 3] };
  using rbf = hb.rbf({ ...data, onWarning: quiet });
  expectClose(rbf.evaluate([1.5, 1.5, 0.25, 0.25]), [1.5, 0.25], 1e-9);
  // Not linear: numpy.linalg.lstsq of [[R, P], [Pᵀ, 0]], the same on the line.
  using bent = hb.rbf({ ...data, values: [0, 1, 0, 2], onWarning: quiet });
  expectClose(bent.evaluate([1.5, 1.5, 0.25, 0.25]), [0.43074896326371487, 0.33668051607813876], 1e-9);
  const pose = {
    dimensions: ['a', 'b'],
    kernel: 'cubic',
    examples: [0, 1, 2].map((t) => ({ name: `p${t}`, at: [t, t], shape: [t] })),
  } as const;
  using space = hb.poseSpace(pose);
  expectClose(space.evaluate([1.5, 1.5]), [1.5], 1e-9);
});

/** Sets of space that span less than it does, by name: n × 3. */
function sets(next: ReturnType<typeof random>): Record<string, number[]> {
  const [u, v] = [next.numbers(3), next.numbers(3)];
  const combine = (count: number, ...axes: number[][]) =>
    Array.from({ length: count }, () => {
      const t = axes.map(() => next.number());
      return [0, 1, 2].map((axis) => axes.reduce((sum, a, k) => sum + (t[k] ?? 0) * (a[axis] ?? 0), 0.3));
    }).flat();
  return {
    'a plane': combine(14, u, v),
    'a line': combine(9, u),
    'an axis': combine(6, [1, 0, 0]),
    'two points': combine(2, u),
    'three points': combine(3, u, v),
    'a single point': [0.2, -1, 3],
  };
}

describe.each(names)('%s', (kernel) => {
  const options = (points: number[], values: number[]): RbfOptions => ({
    dimension: 3,
    points,
    values,
    kernel,
    degree: kernel === 'quintic' ? 2 : 1,
    width: kernel === 'clamped-plate' ? 12 : 'auto',
    onWarning: quiet,
  });

  test(`interpolates in the span of its points, and reproduces what is linear there (seed ${seed})`, () => {
    const next = random(seed);
    for (const [name, points] of Object.entries(sets(next))) {
      const values = next.numbers(points.length / 3);
      using through = hb.rbf(options(points, values));
      expectClose(through.evaluate(points), values, 1e-6, name);
      const f = (all: number[]) =>
        Array.from({ length: all.length / 3 }, (_, i) => 2 - (all[3 * i] ?? 0) + 3 * (all[3 * i + 2] ?? 0));
      using flat = hb.rbf(options(points, f(points)));
      const between = Array.from({ length: points.length - 3 }, (_, i) => ((points[i] ?? 0) + (points[i + 3] ?? 0)) / 2);
      expectClose(flat.evaluate(between), f(between), 1e-7, name);
    }
  });

  test(`does so however the set is turned and moved (seed ${seed})`, () => {
    if (kernel === 'clamped-plate') return; // its ball is centered on the box of the points, which turning changes
    const next = random(seed + 1);
    for (const [name, points] of Object.entries(sets(next))) {
      const values = next.numbers(points.length / 3);
      const queries = next.numbers(9);
      const turn = rotation(next);
      const moved = (all: number[]) => rotate(turn, all).map((x, i) => x + (i % 3) - 0.5);
      using plain = hb.rbf(options(points, values));
      using turned = hb.rbf(options(moved(points), values));
      expectClose(turned.evaluate(moved(queries)), plain.evaluate(queries), 1e-6, name);
    }
  });

  test('its gradient is that of its values', () => {
    const points = [0, 0, 0, 1, 2, 0, 2, 4, 0, 3.5, 7, 0];
    using f = hb.rbf(options(points, [0, 1, -1, 2]));
    const at = [0.6, 1.1, 0.2];
    const gradient = f.gradient(at);
    for (let axis = 0; axis < 3; axis++) {
      const step = (h: number) => f.evaluate(at.map((x, i) => (i === axis ? x + h : x)))[0] ?? 0;
      expect((step(1e-5) - step(-1e-5)) / 2e-5).toBeCloseTo(gradient[axis] ?? Number.NaN, 5);
    }
  });
});

test(`moving least squares of every degree and weight reproduces lines on a line, and conics do no harm (seed ${seed})`, () => {
  const next = random(seed + 2);
  for (const weight of ['inverse-distance', 'gaussian', 'wendland'] as const)
    for (const degree of [0, 1, 2] as const)
      for (const [name, points] of Object.entries(sets(next))) {
        const count = points.length / 3;
        const values = Array.from({ length: count }, (_, i) => 1 + 2 * (points[3 * i] ?? 0) - (points[3 * i + 1] ?? 0));
        using f = hb.movingLeastSquares({ dimension: 3, points, values, degree, weight });
        if (degree > 0) expectClose(f.evaluate(points), values, 1e-7, `${name}, ${weight}, ${degree}`);
        expect(f.evaluate(points).every(Number.isFinite)).toBe(true);
      }
  const circle = Array.from({ length: 16 }, (_, i) => (i % 2 ? Math.sin(i - 1) : Math.cos(i)));
  const ones = Array(8).fill(1);
  for (const made of [
    hb.movingLeastSquares({ dimension: 2, points: circle, values: ones, degree: 2 }),
    hb.rbf({ dimension: 2, points: circle, values: ones, degree: 2, onWarning: quiet }),
    hb.rbf({ dimension: 2, points: circle, values: ones, kernel: 'quintic', onWarning: quiet }),
  ])
    expectClose(made.evaluate([0.1, 0.2]), [1], 1e-9);
});

test(`pose spaces of every kernel that can have a tail of degree 1 do so too (seed ${seed})`, () => {
  const next = random(seed + 3);
  for (const kernel of POSE_KERNELS)
    for (const [name, points] of Object.entries(sets(next))) {
      const examples = Array.from({ length: points.length / 3 }, (_, k) => {
        const at = points.slice(3 * k, 3 * k + 3);
        return { name: `${k}`, at, shape: at };
      });
      using space = hb.poseSpace({ dimensions: ['a', 'b', 'c'], kernel, degree: 1, examples });
      for (const { at } of examples) expectClose(space.evaluate(at), at, 1e-6, `${name}, ${kernel}`);
      const middle = [0, 1, 2].map((axis) => ((points[axis] ?? 0) + (points[points.length - 3 + axis] ?? 0)) / 2);
      expectClose(space.evaluate(middle), middle, 1e-6, `${name}, ${kernel}`);
    }
});

test('tension splines and the search for outliers take points on a line', () => {
  const points = Array.from({ length: 12 }, (_, i) => [i, 2 * i]).flat();
  const values = Array.from({ length: 12 }, (_, i) => (i === 5 ? 9 : Math.sin(i / 3)));
  using spline = hb.tensionSpline({ dimension: 2, points: [0, 0, 1, 1, 2, 2], values: [0, 1, 2], onWarning: quiet });
  expectClose(spline.evaluate([0.5, 0.5]), [0.5], 1e-9);
  using two = hb.tensionSpline({ dimension: 2, points: [0, 0, 2, 2], values: [0, 1], onWarning: quiet });
  expectClose(two.evaluate([1, 1]), [0.5], 1e-9);
  expect(hb.findOutliers({ dimension: 2, points, values }).outliers).toEqual([5]);
});
