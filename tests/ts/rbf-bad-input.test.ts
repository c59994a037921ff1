import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { HandlebodyError, KERNELS, type KernelName, load, type RbfOptions } from '../../wasm/ts/index.ts';
import { errorOf } from './support/scattered.ts';

const hb = await load();
const seed = 20140728;
const quiet = () => {};
const names = Object.keys(KERNELS) as KernelName[];

describe('bad input', () => {
  const points = [0, 0, 1, 0, 0, 1];
  const values = [1, 2, 3];

  test.each([
    ['no points', { points: [], values: [] }, 'points-too-few', undefined],
    [
      'two values at one point',
      { points: [...points, 1, 0], values: [...values, 5] },
      'point-duplicate',
      { kind: 'point', index: 3 },
    ],
    ['NaN in a point', { points: [0, 0, 1, Number.NaN, 0, 1] }, 'point-not-finite', { kind: 'point', index: 1 }],
    ['infinity in a value', { values: [1, 2, Number.POSITIVE_INFINITY] }, 'value-not-finite', { kind: 'point', index: 2 }],
    ['width zero', { kernel: 'gaussian', width: 0 }, 'invalid-option', { kind: 'option', index: -1 }],
    ['a negative width', { kernel: 'gaussian', width: -1 }, 'invalid-option', { kind: 'option', index: -1 }],
    ['a negative width among several', { kernel: 'gaussian', width: [1, -1, 1] }, 'invalid-option', { kind: 'center', index: 1 }],
    ['too few widths', { kernel: 'gaussian', width: [1, 1] }, 'invalid-shape', undefined],
    ['a width that is no width', { width: 'wide' as 'auto' }, 'invalid-option', { kind: 'option', index: -1 }],
    ['a kernel that there is not', { kernel: 'gausian' as 'gaussian' }, 'invalid-option', { kind: 'option', index: -1 }],
    ['a tail that is too low', { kernel: 'thin-plate', degree: 0 }, 'invalid-option', { kind: 'option', index: -1 }],
    ['a tail that is too high', { degree: 3 as 2 }, 'invalid-option', { kind: 'option', index: -1 }],
    ['an order whose tail is too high', { kernel: 'polyharmonic', order: 5 }, 'invalid-option', { kind: 'option', index: -1 }],
    ['negative smoothing', { smoothing: -1 }, 'invalid-option', { kind: 'option', index: -1 }],
    ['smoothing with weight decay', { smoothing: 1, weightDecay: 1 }, 'invalid-option', { kind: 'option', index: -1 }],
    ['a dimension that does not fit', { dimension: 4 }, 'invalid-shape', undefined],
    ['a dimension of zero', { dimension: 0 }, 'invalid-shape', undefined],
    ['values that do not fit', { values: [1, 2, 3, 4] }, 'invalid-shape', undefined],
    [
      '65 dimensions',
      {
        dimension: 65,
        points: Array(130)
          .fill(0)
          .map((_, i) => i),
        values: [0, 1],
        kernel: 'linear',
      },
      'invalid-shape',
      undefined,
    ],
    [
      'an extent beyond double precision',
      { points: [-1.7e308, 0, 1.7e308, 0, 0, 1], kernel: 'linear' },
      'points-degenerate',
      undefined,
    ],
  ] as [string, Partial<RbfOptions>, string, unknown][])('%s', (_, options, code, culprit) => {
    const before = hb.memory;
    const error = errorOf(() => hb.rbf({ dimension: 2, points, values, ...options }));
    expect(error.code).toBe(code);
    expect(error.culprit).toEqual(culprit);
    expect(error.message).toMatch(/^[A-Z0-9].*\.$/);
    expect(error.remedy).toMatch(/^[A-Z].*\.$/);
    expect(hb.memory).toBe(before);
  });

  test('a tail that is too low is told which degree it needs', () => {
    expect(errorOf(() => hb.rbf({ dimension: 2, points, values, kernel: 'quintic', degree: 1 })).message).toContain('degree 2');
  });

  test('a million points are refused before anything is allocated, with the size that they would take', () => {
    const before = hb.memory;
    const error = errorOf(() => hb.rbf({ dimension: 2, points: new Float64Array(2e6), values: new Float64Array(1e6) }));
    expect(error.code).toBe('out-of-memory');
    expect(error.message).toMatch(/^1000000 points with 1000000 centers make a dense matrix of 7450 GiB/);
    expect(hb.memory).toBe(before);
  });

  test('queries that are not finite or do not fit are named, in the caller’s numbers', () => {
    using rbf = hb.rbf({ dimension: 2, points, values });
    const queries = new Float64Array(2 * 10_000);
    queries[2 * 7123 + 1] = Number.NaN;
    const error = errorOf(() => rbf.evaluate(queries));
    expect(error.code).toBe('query-not-finite');
    expect(error.culprit).toEqual({ kind: 'query', index: 7123 });
    expect(error.message).toContain('query 7123');
    expect(errorOf(() => rbf.evaluate([1])).code).toBe('invalid-shape');
    expect(errorOf(() => rbf.evaluate([1, 2], new Float64Array(2))).code).toBe('invalid-shape');
    rbf.dispose();
    rbf.dispose();
    expect(errorOf(() => rbf.evaluate([1, 2])).code).toBe('disposed');
  });

  test(`any numbers give a fit or a sentence (seed ${seed})`, () => {
    const tame = fc.integer({ min: -12, max: 12 }).map((n) => n / 4);
    const rowsOf = (number: fc.Arbitrary<number>) =>
      fc.array(fc.record({ point: fc.tuple(number, number), value: number }), { maxLength: 8 });
    let [ordinary, refused] = [0, 0];
    fc.assert(
      fc.property(
        fc.oneof(rowsOf(tame), rowsOf(fc.oneof(fc.double(), tame))),
        fc.constantFrom(...names),
        fc.constantFrom(-1, 0, 1, 2, 'auto' as const),
        fc.oneof(fc.constant('auto' as const), fc.integer({ min: 1, max: 20 }), fc.double({ min: 0, max: 1e6 })),
        fc.boolean(),
        (rows, kernel, degree, width, normalized) => {
          try {
            using rbf = hb.rbf({
              dimension: 2,
              points: rows.flatMap(({ point }) => point),
              values: rows.map(({ value }) => value),
              kernel,
              degree: degree as 1,
              width,
              normalized,
              onWarning: quiet,
            });
            // Beyond these a value or a gradient may lie outside double precision: 1e300 over a width of 1e-300.
            const sizes = rows.flatMap(({ point, value }) => [...point, value, width === 'auto' ? 1 : width]).map(Math.abs);
            if (sizes.some((size) => size !== 0 && (size < 1e-60 || size > 1e60))) return;
            ordinary++;
            expect(Array.from(rbf.evaluate([0.5, 0.25]), Number.isFinite)).toEqual([true]);
            expect(Array.from(rbf.gradient([0.5, 0.25]), Number.isFinite)).toEqual([true, true]);
          } catch (error) {
            if (!(error instanceof HandlebodyError)) throw error;
            refused++;
            expect(error.code).not.toMatch(/internal|trapped/);
            expect(error.message).toMatch(/^[A-Z0-9].*\.$/);
            expect(error.remedy).toMatch(/^[A-Z].*\.$/);
          }
        },
      ),
      { seed, numRuns: 1500 },
    );
    expect(ordinary).toBeGreaterThan(100);
    expect(refused).toBeGreaterThan(100);
  });
});
