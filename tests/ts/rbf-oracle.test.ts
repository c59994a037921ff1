import { readFileSync } from 'node:fs';
import { afterAll, describe, expect, test } from 'vitest';
import { type KernelName, load, type RbfOptions } from '../../wasm/ts/index.ts';

interface DataSet {
  readonly dimension: number;
  readonly points: number[];
  readonly values: number[];
  readonly queries: number[];
}

interface Case {
  readonly set: number;
  readonly kernel: KernelName;
  readonly width: number;
  readonly degree: -1 | 0 | 1 | 2;
  readonly smoothing: number;
  readonly expected: number[];
}

const oracle = JSON.parse(readFileSync(new URL('../oracles/rbf_interpolator.json', import.meta.url), 'utf8')) as {
  sets: DataSet[];
  cases: Case[];
};
const hb = await load();

/** Up to this condition number the bound is a plain 1e-9; beyond, each side may be off by the condition number times 1e-16. */
const WELL_CONDITIONED = 1e6;
const BEYOND = 1e-16;

const worst = new Map<string, { well: number; beyond: number }>();

describe("SciPy's RBFInterpolator", () => {
  test.each(oracle.sets.map((set, index) => [set.points.length / set.dimension, set.dimension, index] as const))(
    '%i points in %i dimensions: equal to 1e-9 where well conditioned, to the condition number times 1e-16 elsewhere',
    (_count, _dimension, index) => {
      const { dimension, points, values, queries } = oracle.sets[index] as DataSet;
      const cases = oracle.cases.filter(({ set }) => set === index);
      expect(cases.length).toBe(76);
      for (const { kernel, width, degree, smoothing, expected } of cases) {
        using rbf = hb.rbf({ dimension, points, values, kernel, width, degree, smoothing, onWarning: () => {} });
        const scale = Math.max(1, ...expected.map(Math.abs));
        const error = Math.max(...rbf.evaluate(queries).map((value, i) => Math.abs(value - (expected[i] ?? Number.NaN)))) / scale;
        const { condition } = rbf.report();
        const well = condition < WELL_CONDITIONED;
        const known = worst.get(kernel) ?? { well: 0, beyond: 0 };
        worst.set(
          kernel,
          well ? { ...known, well: Math.max(known.well, error) } : { ...known, beyond: Math.max(known.beyond, error / condition) },
        );
        expect(error, `${kernel}, degree ${degree}, smoothing ${smoothing}, condition ${condition}`).toBeLessThan(
          well ? 1e-9 : BEYOND * condition,
        );
      }
    },
  );

  afterAll(() => {
    for (const [kernel, { well, beyond }] of worst)
      console.log(
        `${kernel.padEnd(22)} worst ${well.toExponential(1)} well conditioned, ${beyond.toExponential(1)} × condition beyond`,
      );
  });
});

// Both sides solve well-conditioned least-squares problems (condition below 1e5), by QR here and by SVD there.
test("numpy's least squares: weight decay, fewer centers, metrics and compact kernels, to 1e-9", () => {
  const fits = JSON.parse(readFileSync(new URL('../oracles/rbf_fits.json', import.meta.url), 'utf8')) as {
    options: RbfOptions;
    queries: number[];
    expected: number[];
  }[];
  expect(fits.length).toBe(18);
  let largest = 0;
  for (const { options, queries, expected } of fits) {
    using rbf = hb.rbf({ ...options, onWarning: () => {} });
    const scale = Math.max(1, ...expected.map(Math.abs));
    const error = Math.max(...rbf.evaluate(queries).map((value, i) => Math.abs(value - (expected[i] ?? Number.NaN)))) / scale;
    expect(error, `${options.kernel}, degree ${options.degree}, condition ${rbf.report().condition}`).toBeLessThan(1e-9);
    largest = Math.max(largest, error);
  }
  console.log(`fits: worst ${largest.toExponential(1)}`);
});
