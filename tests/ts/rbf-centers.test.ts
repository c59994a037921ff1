import { describe, expect, test } from 'vitest';
import { load, type Rbf } from '../../wasm/ts/index.ts';
import { errorOf, largest } from './support/scattered.ts';

const hb = await load();
const quiet = () => {};

describe('fewer centers than points', () => {
  const x = Array.from({ length: 41 }, (_, i) => i / 40);
  const centers = [0, 0.2, 0.4, 0.6, 0.8, 1];
  // What the model can be: so that a fit without bad points has no misfit at all.
  const clean = x.map((t) => centers.reduce((sum, c, k) => sum + Math.sin(2 * k) * Math.exp(-(((t - c) / 0.3) ** 2)), 0));
  const base = { dimension: 1, points: x, kernel: 'gaussian', width: 0.3, centers, onWarning: quiet } as const;

  test('robust fits withstand what bends least squares', () => {
    const bad = clean.map((y, i) => (i % 6 === 2 ? y + 3 : y));
    using honest = hb.rbf({ ...base, values: clean });
    const queries = [0.03, 0.17, 0.33, 0.52, 0.71, 0.99];
    const off = (rbf: Rbf) => largest(rbf.evaluate(queries).map((y, i) => y - (honest.evaluate(queries)[i] ?? 0)));
    using bent = hb.rbf({ ...base, values: bad });
    using absolute = hb.rbf({ ...base, values: bad, robust: 'least-absolute' });
    using median = hb.rbf({ ...base, values: bad, robust: 'least-median' });
    expect(off(bent)).toBeGreaterThan(0.3);
    expect(off(absolute)).toBeLessThan(1e-4);
    expect(off(median)).toBeLessThan(1e-9);
    expect([...median.rowWeights()]).toEqual(x.map((_, i) => (i % 6 === 2 ? 0 : 1)));
    expect(Math.max(...absolute.rowWeights().filter((_, i) => i % 6 === 2))).toBeLessThan(0.05);
    expect(errorOf(() => median.leaveOneOut()).code).toBe('invalid-option');
  });

  test('the median withstands two in five', () => {
    const bad = clean.map((y, i) => (i % 5 < 2 ? y + 5 + i / 10 : y));
    using median = hb.rbf({ ...base, values: bad, robust: 'least-median' });
    expect([...median.rowWeights()].map((w, i) => (i % 5 < 2 ? w === 0 : w === 1)).every(Boolean)).toBe(true);
  });

  test('leave-one-out is that of a refit, weight decay included', () => {
    for (const weightDecay of [0, 0.01]) {
      using rbf = hb.rbf({ ...base, values: clean, weightDecay });
      const errors = rbf.leaveOneOut();
      for (const out of [0, 7, 40]) {
        using rest = hb.rbf({
          ...base,
          points: x.filter((_, i) => i !== out),
          values: clean.filter((_, i) => i !== out),
          weightDecay,
        });
        expect(errors[out]).toBeCloseTo((clean[out] ?? 0) - (rest.evaluate([x[out] ?? 0])[0] ?? 0), 9);
      }
    }
  });

  test('more centers than points need weight decay; smoothing needs a center at each', () => {
    const few = { ...base, points: [0, 1], values: [0, 1] };
    expect(errorOf(() => hb.rbf(few)).code).toBe('points-too-few');
    hb.rbf({ ...few, weightDecay: 0.1 }).dispose();
    expect(errorOf(() => hb.rbf({ ...base, values: clean, smoothing: 0.1 })).remedy).toContain('weightDecay');
    expect(errorOf(() => hb.rbf({ ...base, values: clean, centers: [0, Number.NaN] })).culprit).toEqual({
      kind: 'center',
      index: 1,
    });
    const { centers: _, ...all } = base;
    expect(errorOf(() => hb.rbf({ ...all, values: clean, robust: 'least-median' })).code).toBe('invalid-option');
  });
});
