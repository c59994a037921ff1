import { describe, expect, test } from 'vitest';
import { load } from '../../wasm/ts/index.ts';
import { errorOf, expectClose, largest } from './support/scattered.ts';

const hb = await load();
const quiet = () => {};

describe('the clamped plate', () => {
  test('is clamped: zero with its gradient on the ball and beyond, in 1, 2 and 3 dimensions', () => {
    for (const dimension of [1, 2, 3]) {
      const points = [...Array(dimension).fill(-0.5), ...Array(dimension).fill(0.5), ...Array(dimension).fill(0.2)];
      using rbf = hb.rbf({ dimension, points, values: [1, -2, 0.5], kernel: 'clamped-plate', width: 2, onWarning: quiet });
      expectClose(rbf.evaluate(points), [1, -2, 0.5], 1e-12);
      for (const radius of [2, 3]) {
        const rim = [radius, ...Array(dimension - 1).fill(0)];
        expect(largest(rbf.evaluate(rim))).toBeLessThan(1e-12);
        expect(largest(rbf.gradient(rim))).toBeLessThan(1e-12);
      }
      // It vanishes to second order.
      const near = rbf.evaluate([2 - 1e-3, ...Array(dimension - 1).fill(0)])[0] ?? 0;
      const nearer = rbf.evaluate([2 - 5e-4, ...Array(dimension - 1).fill(0)])[0] ?? 0;
      expect(near / nearer).toBeCloseTo(4, 1);
    }
  });

  test("is Boggio's closed form for the plate in the unit disk", () => {
    // G = |x−y|² ln(|x−y|/A) + ½(A² − |x−y|²), A² = |x|²|y|² − 2x·y + 1, up to scale: both as ratios to G at the center.
    const green = (x: [number, number], y: [number, number]) => {
      const r2 = (x[0] - y[0]) ** 2 + (x[1] - y[1]) ** 2;
      const a2 = (x[0] ** 2 + x[1] ** 2) * (y[0] ** 2 + y[1] ** 2) - 2 * (x[0] * y[0] + x[1] * y[1]) + 1;
      return r2 === 0 ? a2 / 2 : (r2 * Math.log(r2 / a2)) / 2 + (a2 - r2) / 2;
    };
    const center: [number, number] = [0.25, 0.1];
    // Two points whose box is centered on the origin; the second has weight 0.
    const other: [number, number] = [-0.25, -0.1];
    const ratio = green(other, center) / green(center, center);
    using rbf = hb.rbf({
      dimension: 2,
      points: [...center, ...other],
      values: [1, ratio],
      kernel: 'clamped-plate',
      width: 1,
      onWarning: quiet,
    });
    expect(largest(rbf.coefficients().slice(1))).toBeLessThan(1e-12);
    for (const x of [
      [0.5, 0.5],
      [-0.3, 0.8],
      [0.26, 0.1],
      [0, 0],
    ] as [number, number][])
      expect(rbf.evaluate(x)[0]).toBeCloseTo(green(x, center) / green(center, center), 12);
  });

  test('refuses points outside of its ball, and orders that are too low', () => {
    const outside = errorOf(() =>
      hb.rbf({ dimension: 1, points: [0, 1, 2], values: [0, 1, 0], kernel: 'clamped-plate', width: 0.9 }),
    );
    expect(outside.code).toBe('invalid-option');
    expect(outside.culprit).toEqual({ kind: 'point', index: 0 });
    const order = errorOf(() =>
      hb.rbf({ dimension: 4, points: Array(8).fill(0), values: [0, 0], kernel: 'clamped-plate', order: 2 }),
    );
    expect(order.remedy).toContain('use order 3');
  });
});
