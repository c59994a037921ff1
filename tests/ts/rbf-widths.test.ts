import { describe, expect, test } from 'vitest';
import { load, type Rbf } from '../../wasm/ts/index.ts';
import { expectClose, random } from './support/scattered.ts';

const hb = await load();
const seed = 20140728;
const quiet = () => {};

describe('widths', () => {
  const next = random(seed + 10);
  const points = next.numbers(80);
  const smooth = (x: number, y: number) => Math.sin(2 * x) * Math.cos(3 * y);
  const values = Array.from({ length: 40 }, (_, i) => smooth(points[2 * i] ?? 0, points[2 * i + 1] ?? 0));
  const data = { dimension: 2, points, values, onWarning: quiet } as const;

  test('chosen by leave-one-out have less leave-one-out error than others nearby, whatever the order of the points', () => {
    for (const kernel of ['gaussian', 'multiquadric', 'inverse-multiquadric', 'wendland-c4'] as const) {
      using chosen = hb.rbf({ ...data, kernel, width: 'leave-one-out' });
      const { width, condition } = chosen.report();
      expect(condition).toBeLessThan(1e13);
      const error = (rbf: Rbf) => rbf.leaveOneOut().reduce((sum, x) => sum + x * x, 0);
      const least = error(chosen);
      for (const factor of [0.5, 0.8]) {
        using other = hb.rbf({ ...data, kernel, width: width * factor });
        expect(error(other)).toBeGreaterThan(least);
      }
      using automatic = hb.rbf({ ...data, kernel });
      expect(least).toBeLessThanOrEqual(error(automatic));
      const order = next.permutation(40);
      using shuffled = hb.rbf({
        ...data,
        kernel,
        width: 'leave-one-out',
        points: order.flatMap((i) => [...points.slice(2 * i, 2 * i + 2)]),
        values: order.map((i) => values[i] ?? 0),
      });
      expect(shuffled.report().width / width).toBeCloseTo(1, 3);
    }
  });

  test('are chosen from a part of many points', () => {
    const many = random(seed + 11).numbers(2 * 700);
    const heights = Array.from({ length: 700 }, (_, i) => smooth(many[2 * i] ?? 0, many[2 * i + 1] ?? 0));
    using rbf = hb.rbf({
      dimension: 2,
      points: many,
      values: heights,
      kernel: 'inverse-multiquadric',
      width: 'leave-one-out',
      onWarning: quiet,
    });
    expect(rbf.report().width).toBeGreaterThan(0.01);
    expect(rbf.evaluate([0.1, 0.2])[0]).toBeCloseTo(smooth(0.1, 0.2), 3);
  });

  test('one a center: each kernel has its own', () => {
    const widths = Array.from({ length: 40 }, (_, i) => 0.2 + 0.01 * i);
    using rbf = hb.rbf({ ...data, kernel: 'gaussian', width: widths });
    expectClose(rbf.evaluate(points), values, 1e-8);
    const w = rbf.coefficients();
    const at = [0.3, -0.2] as const;
    const expected = w.reduce(
      (sum, c, i) =>
        sum +
        c * Math.exp(-(((at[0] - (points[2 * i] ?? 0)) ** 2 + (at[1] - (points[2 * i + 1] ?? 0)) ** 2) / (widths[i] ?? 0) ** 2)),
      0,
    );
    expect(rbf.evaluate(at)[0]).toBeCloseTo(expected, 9);
    expect(rbf.report().warnings.map(({ code }) => code)).toContain('unequal-widths');
  });
});
