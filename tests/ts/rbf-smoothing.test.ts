import { describe, expect, test } from 'vitest';
import { load } from '../../wasm/ts/index.ts';
import { errorOf, expectClose, largest, random } from './support/scattered.ts';

const hb = await load();
const seed = 20140728;
const quiet = () => {};

describe('smoothing', () => {
  test(`of a thin plate tends to the affine least-squares fit (seed ${seed})`, () => {
    const next = random(seed + 9);
    const points = next.numbers(60);
    const values = Array.from(
      { length: 30 },
      (_, i) => 1 + 2 * (points[2 * i] ?? 0) - (points[2 * i + 1] ?? 0) + 0.3 * (next.number() ?? 0),
    );
    using stiff = hb.rbf({ dimension: 2, points, values, kernel: 'thin-plate', smoothing: 1e7 });
    using plane = hb.rbf({ dimension: 2, points, values, kernel: 'thin-plate', centers: [0, 0, 1, 0, 0, 1], onWarning: quiet });
    const queries = next.numbers(10);
    expectClose(stiff.evaluate(queries), plane.evaluate(queries), 1e-5);
    using exact = hb.rbf({ dimension: 2, points, values, kernel: 'thin-plate' });
    expect(largest(exact.evaluate(queries).map((x, i) => x - (plane.evaluate(queries)[i] ?? 0)))).toBeGreaterThan(0.05);
  });

  test('takes points that repeat with other values, near their mean', () => {
    const data = { dimension: 1, points: [0, 1, 1, 2], values: [0, 1, 3, 0], kernel: 'cubic' } as const;
    expect(errorOf(() => hb.rbf(data)).code).toBe('point-duplicate');
    using smoothed = hb.rbf({ ...data, smoothing: 1e-6, onWarning: quiet });
    expect(smoothed.evaluate([1])[0]).toBeCloseTo(2, 5);
  });
});
