import { describe, expect, test } from 'vitest';
import { load } from '../../wasm/ts/index.ts';
import { errorOf, expectClose, random } from './support/scattered.ts';

const hb = await load();
const seed = 20140728;
const quiet = () => {};

describe('kernels from JavaScript', () => {
  const data = {
    dimension: 2,
    points: random(seed + 6).numbers(24),
    values: random(seed + 7).numbers(12),
    width: 0.4,
    onWarning: quiet,
  };
  const queries = random(seed + 8).numbers(10);

  test('are the built-in ones when they compute the same, gradients with and without a derivative', () => {
    using own = hb.rbf({ ...data, kernel: 'gaussian' });
    using theirs = hb.rbf({ ...data, kernel: (s) => Math.exp(-s * s) });
    using exact = hb.rbf({ ...data, kernel: { value: (s) => Math.exp(-s * s), derivative: (s) => -2 * s * Math.exp(-s * s) } });
    expectClose(theirs.evaluate(queries), own.evaluate(queries), 1e-12);
    expectClose(theirs.gradient(queries), own.gradient(queries), 1e-8);
    expectClose(exact.gradient(queries), own.gradient(queries), 1e-12);
    expect(theirs.report().kernel).toBe('custom');
  });

  test('may change sign: sinc is positive definite up to three dimensions', () => {
    using sinc = hb.rbf({ ...data, kernel: (s) => (s === 0 ? 1 : Math.sin(5 * s) / (5 * s)) });
    expectClose(sinc.evaluate(data.points), data.values, 1e-9);
  });

  test('that throw or give no number are named, with the point, and harm nothing', () => {
    const thrown = new Error('out of tea');
    const throwing = errorOf(() =>
      hb.rbf({
        ...data,
        kernel: () => {
          throw thrown;
        },
      }),
    );
    expect(throwing.code).toBe('kernel-failed');
    expect(throwing.message).toContain('out of tea');
    expect(throwing.cause).toBe(thrown);
    expect(throwing.culprit).toEqual({ kind: 'point', index: 0 });
    const nan = errorOf(() => hb.rbf({ ...data, kernel: (s) => (s > 2 ? Number.NaN : 1 - s / 9) }));
    expect(nan.code).toBe('kernel-failed');
    expect(nan.message).toMatch(/returned NaN at s = 2\..* between point \d+ and center \d+/);
    expect(nan.culprit?.kind).toBe('point');
    expect(nan.remedy).toMatch(/finite/);

    let broken = false;
    using later = hb.rbf({ ...data, kernel: (s) => (broken ? Number.NaN : Math.exp(-s * s)) });
    const good = later.evaluate(queries);
    broken = true;
    expect(errorOf(() => later.evaluate(queries)).code).toBe('kernel-failed');
    broken = false;
    expect(later.evaluate(queries)).toEqual(good);
  });

  test('cannot call the solver that is calling them', () => {
    using other = hb.rbf({ ...data, kernel: 'gaussian' });
    const error = errorOf(() => hb.rbf({ ...data, kernel: () => other.evaluate([0, 0])[0] ?? 0 }));
    expect(error.code).toBe('kernel-failed');
    expect(error.message).toContain('called the solver');
    expect(other.evaluate([0, 0])[0]).toBeTypeOf('number');
  });
});
