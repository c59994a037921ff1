import { readFileSync } from 'node:fs';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import {
  DISCRETE_GREEN_DEFAULTS,
  type DiscreteGreenOptions,
  type GridBoundary,
  type GridMatrix,
  load,
} from '../../wasm/ts/index.ts';
import { errorOf, largestDifference } from './support/scattered.ts';

const hb = await load();
const seed = 20140728;
const boundaries: readonly GridBoundary[] = ['free', 'dirichlet', 'neumann', 'periodic'];

interface Grid {
  readonly size: number;
  readonly order: 1 | 2 | 3;
  readonly boundary: number;
  readonly samples: number[];
  readonly values: number[];
  readonly operator: number[];
  readonly green: number[];
  readonly curve: number[];
}

const largest = (numbers: ArrayLike<number>) => Array.from(numbers).reduce((most, x) => Math.max(most, Math.abs(x)), 0);

/** a·b, or aᵀ·b. */
function product(a: GridMatrix, b: GridMatrix, transposed = false): Float64Array {
  const rows = transposed ? a.columns : a.rows;
  const inner = transposed ? a.rows : a.columns;
  return Float64Array.from({ length: rows * b.columns }, (_, at) => {
    const [i, j] = [Math.floor(at / b.columns), at % b.columns];
    let sum = 0;
    for (let k = 0; k < inner; k++)
      sum += (a.values[transposed ? k * a.columns + i : i * a.columns + k] ?? 0) * (b.values[k * b.columns + j] ?? 0);
    return sum;
  });
}

test('agrees with exact fractions to 1e-9', () => {
  const { grids } = JSON.parse(readFileSync(new URL('../oracles/discrete_green.json', import.meta.url), 'utf8')) as {
    grids: Grid[];
  };
  expect(grids.length).toBe(24);
  for (const { boundary, operator, green, curve, ...options } of grids) {
    using lesson = hb.discreteGreen({ ...options, boundary: boundaries[boundary] as GridBoundary });
    expect(Array.from(lesson.operator.values)).toEqual(operator);
    if (green.length > 0) expect(largestDifference(lesson.green.values, green)).toBeLessThan(1e-12 * largest(green));
    expect(largestDifference(lesson.solveGrid(), curve)).toBeLessThan(1e-9 * largest(curve));
    expect(largestDifference(lesson.solveRadial(), curve)).toBeLessThan(1e-9 * largest(curve));
  }
});

test(`matrices fit together, and both ways lead to one curve (seed ${seed})`, () => {
  const anyGrid = fc.record({
    size: fc.integer({ min: 4, max: 40 }),
    order: fc.constantFrom(1 as const, 2 as const, 3 as const),
    boundary: fc.constantFrom(...boundaries),
    picks: fc.uniqueArray(fc.nat(39), { minLength: 3, maxLength: 10, selector: (pick) => pick }),
    values: fc.array(fc.integer({ min: -100, max: 100 }), { minLength: 10, maxLength: 10 }),
  });
  fc.assert(
    fc.property(anyGrid, ({ size, order, boundary, picks, values }) => {
      const samples = [...new Set([0, 1, 2, ...picks.map((pick) => pick % size)])];
      const data = values.concat(values).slice(0, samples.length);
      using lesson = hb.discreteGreen({ size, order, boundary, samples, values: data });
      const { operator, squared, nullSpace, green, nullity } = lesson;
      expect(nullity).toBe({ free: order, dirichlet: 0, neumann: 1, periodic: 1 }[boundary]);
      expect(operator.columns).toBe(size);
      expect(largestDifference(product(operator, operator, true), squared.values)).toBe(0);
      expect(largest(product(operator, nullSpace))).toBeLessThan(1e-12);
      // DᵀD G = I − N Nᵀ
      const transposed = { rows: nullity, columns: size, values: product(nullSpace, identity(size), true) };
      const expected = identity(size).values.map((x, at) => x - (product(nullSpace, transposed)[at] ?? 0));
      expect(largestDifference(product(squared, green), expected)).toBeLessThan(1e-13 * (1 + largest(green.values)) * 64);

      const weights = new Float64Array(samples.length + nullity);
      const curve = lesson.solveRadial(undefined, weights);
      const force = largest(product(squared, { rows: size, columns: 1, values: curve }));
      expect(largestDifference(lesson.solveGrid(), curve)).toBeLessThan(1e-13 * (1 + largest(green.values)) * (1 + force));
      const sum = Float64Array.from({ length: size }, (_, i) => {
        let f = 0;
        for (const [k, sample] of samples.entries()) f += (green.values[i * size + sample] ?? 0) * (weights[k] ?? 0);
        for (let a = 0; a < nullity; a++) f += (nullSpace.values[i * nullity + a] ?? 0) * (weights[samples.length + a] ?? 0);
        return f;
      });
      expect(largestDifference(sum, curve)).toBeLessThan(1e-12 * (1 + largest(green.values)) * (1 + force));
    }),
    { seed, numRuns: 60 },
  );
});

function identity(size: number): GridMatrix {
  return { rows: size, columns: size, values: Float64Array.from({ length: size * size }, (_, at) => (at % (size + 1) ? 0 : 1)) };
}

test('free first differences join samples by lines; defaults are free second differences', () => {
  const data = { size: 12, samples: [2, 5, 9], values: [1, 4, 2] };
  using lines = hb.discreteGreen({ ...data, order: 1 });
  expect(largestDifference(lines.solveGrid(), [1, 1, 1, 2, 3, 4, 3.5, 3, 2.5, 2, 2, 2])).toBeLessThan(1e-13);
  using lesson = hb.discreteGreen(data);
  using explicit = hb.discreteGreen({ ...data, ...DISCRETE_GREEN_DEFAULTS });
  expect(lesson.order).toBe(2);
  expect(lesson.operator.rows).toBe(10);
  expect(explicit.solveGrid()).toEqual(lesson.solveGrid());
  const out = new Float64Array(12);
  expect(lesson.solveRadial(out)).toBe(out);
  expect(lesson.green).toBe(lesson.green);
});

describe('bad input is named', () => {
  const data = { size: 12, samples: [2, 5, 9], values: [1, 4, 2] };
  const cases: [string, Partial<DiscreteGreenOptions>, string, number | undefined, RegExp][] = [
    ['too few samples', { samples: [3], values: [1] }, 'points-too-few', undefined, /1 sample does not determine/],
    ['no samples', { samples: [], values: [] }, 'points-too-few', undefined, /0 samples/],
    ['a sample twice', { samples: [2, 5, 2] }, 'point-duplicate', 2, /Sample 2 is at 2, as sample 0 is/],
    ['a sample outside', { samples: [2, 12, 3] }, 'invalid-option', 1, /samples\[1\]" \(point 1\) is 12/],
    ['a negative sample', { samples: [-1, 5, 3] }, 'invalid-option', 0, /samples\[0\]" \(point 0\) is -1/],
    ['a sample between two', { samples: [2, 5, 3.5] }, 'invalid-option', 2, /samples\[2\]" \(point 2\) is 3.5/],
    ['a value of NaN', { values: [1, Number.NaN, 2] }, 'value-not-finite', 1, /values\[1\]" \(point 1\) is NaN/],
    ['too few values', { values: [1, 2] }, 'invalid-shape', undefined, /2 values for 3 samples/],
    ['an unknown boundary', { boundary: 'toString' as 'free' }, 'invalid-option', undefined, /"toString"/],
    ['order 4', { order: 4 as 3 }, 'invalid-option', undefined, /order" is 4/],
    ['order 1.5', { order: 1.5 as 1 }, 'invalid-option', undefined, /order" is 1.5/],
    ['a grid too small', { size: 2, samples: [0, 1], values: [0, 1] }, 'invalid-option', undefined, /grid of 2 samples/],
    ['a grid too large', { size: 1025 }, 'invalid-option', undefined, /grid of 1025 samples/],
    ['half a sample', { size: 12.5 }, 'invalid-option', undefined, /size" is 12.5/],
  ];
  test.each(cases)('%s', (_, options, code, index, message) => {
    const error = errorOf(() => hb.discreteGreen({ ...data, ...options }));
    expect(error.code).toBe(code);
    expect(error.message).toMatch(message);
    expect(error.remedy).not.toBe('');
    if (index !== undefined) expect(error.culprit).toEqual({ kind: 'point', index });
  });

  test('rooms of the wrong size, and use after dispose', () => {
    const lesson = hb.discreteGreen(data);
    expect(errorOf(() => lesson.solveGrid(new Float64Array(3))).code).toBe('invalid-shape');
    expect(errorOf(() => lesson.solveRadial(undefined, new Float64Array(3))).code).toBe('invalid-shape');
    lesson.dispose();
    lesson.dispose();
    expect(errorOf(() => lesson.solveGrid()).code).toBe('disposed');
    expect(errorOf(() => lesson.green).code).toBe('disposed');
  });
});
