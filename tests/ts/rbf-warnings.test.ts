import { describe, expect, test } from 'vitest';
import { KERNELS, type KernelName, load, type RbfOptions, type RbfWarning } from '../../wasm/ts/index.ts';

const hb = await load();
const names = Object.keys(KERNELS) as KernelName[];

describe('warnings', () => {
  const grid = Array.from({ length: 25 }, (_, i) => [i % 5, Math.floor(i / 5)]).flat();
  const heights = Array.from({ length: 25 }, (_, i) => Math.sin(i));
  const told = (options: Partial<RbfOptions>): RbfWarning[] => {
    const warnings: RbfWarning[] = [];
    using rbf = hb.rbf({ dimension: 2, points: grid, values: heights, onWarning: (w) => warnings.push(w), ...options });
    expect(rbf.report().warnings).toEqual(warnings);
    return warnings;
  };

  test('are not given where all is well', () => {
    for (const kernel of names)
      expect(
        told({ kernel }).filter(({ code }) => code !== 'not-definite'),
        kernel,
      ).toEqual([]);
  });

  test('of a width that is too large say by how much, and their remedies work', () => {
    const [warning] = told({ kernel: 'gaussian', width: 12 });
    expect(warning?.code).toBe('ill-conditioned');
    expect(warning?.message).toMatch(/^Width 12 is 12 × the mean spacing: condition 1e\d+\.$/);
    expect(warning?.remedy).toMatch(/^Try a width ≤ [\d.]+ or smoothing ≥ \de-\d+\.$/);
    const { width, smoothing } = warning?.suggestion ?? {};
    for (const better of [{ width }, { width: 12, smoothing }] as Partial<RbfOptions>[]) {
      using rbf = hb.rbf({ dimension: 2, points: grid, values: heights, kernel: 'gaussian', ...better });
      expect(rbf.report().condition).toBeLessThan(3e8);
      expect(rbf.report().warnings).toEqual([]);
    }
  });

  test('name points that nearly coincide, and those that were merged', () => {
    const near = told({ kernel: 'multiquadric', points: [...grid, 2 + 1e-6, 3], values: [...heights, 0] });
    const pair = near.find(({ code }) => code === 'near-duplicates');
    expect(pair?.points).toEqual([17, 25]);
    expect(pair?.message).toContain('17 and 25');
    const merged = told({ kernel: 'multiquadric', points: [...grid, 2, 3], values: [...heights, heights[17] ?? 0] });
    expect(merged).toMatchObject([{ code: 'merged-duplicates', points: [25] }]);
  });

  test('of a width that is too narrow suggest a wider one', () => {
    const [warning] = told({ kernel: 'gaussian', width: 0.1 });
    expect(warning).toMatchObject({ code: 'narrow-width', suggestion: { width: 2 } });
  });

  test('go to the console unless they are taken, and only then', () => {
    const said: unknown[] = [];
    const warn = console.warn;
    console.warn = (message) => said.push(message);
    try {
      hb.rbf({ dimension: 2, points: grid, values: heights, kernel: 'gaussian', width: 12 }).dispose();
      expect(said[0]).toMatch(/condition/);
      said.length = 0;
      told({ kernel: 'gaussian', width: 12 });
      expect(said).toEqual([]);
    } finally {
      console.warn = warn;
    }
  });
});
