/** Weights that do not sum to 1: skins at rest rest, whatever was exported. */
import { describe, expect, test, vi } from 'vitest';
import { load, type SkinWarning } from '../../wasm/ts/index.ts';
import { errorOf, random } from './support/scattered.ts';
import { boxMesh } from './support/shapes.ts';

const hb = await load();
const FORMS = ['direct', 'compiled', 'dual quaternion'] as const;

interface Rig {
  readonly dimension: 2 | 3;
  readonly positions: readonly number[];
  readonly weights: ArrayLike<number>;
}
interface How {
  readonly normalize?: boolean;
  readonly onWarning?: (warning: SkinWarning) => void;
}

const make = (form: (typeof FORMS)[number], rig: Rig, how: How = {}) =>
  form === 'dual quaternion'
    ? hb.dualQuaternion({ ...rig, ...how })
    : hb.linearBlend({ ...rig, ...how, compiled: form === 'compiled' });

/** Positive weights that sum to `sums`, one or more of them 0. */
function anyRig(next: ReturnType<typeof random>, sums: (vertex: number) => number): Rig {
  const dimension = next.number() < 0 ? 2 : 3;
  const [vertices, handles] = [1 + Math.floor(40 * Math.abs(next.number())), 1 + Math.floor(9 * Math.abs(next.number()))];
  const weights = Array.from({ length: vertices }, (_, v) => {
    const row = next.numbers(handles).map((x) => Math.max(0, x));
    row[v % handles] = 1;
    const [sum, wanted] = [row.reduce((a, b) => a + b, 0), sums(v)];
    return row.map((w) => (w / sum) * wanted);
  });
  return { dimension, positions: next.numbers(vertices * dimension).map((x) => 1000 * x), weights: weights.flat() };
}

const SEEDS = Array.from({ length: 24 }, (_, i) => 800 + i);

test.each(SEEDS)('at rest nothing moves, by a digit, whatever the sums are; the worst row is told (seed %i)', (seed) => {
  const next = random(seed);
  const factors = new Map<number, number>();
  const rig = anyRig(next, (v) => {
    const sum = [0.98, 1, 1e-200, 40, 1 + next.number() / 2][(v + seed) % 5] ?? 1;
    factors.set(v, sum);
    return sum;
  });
  const worst = [...factors].reduce((a, b) => (Math.abs(b[1] - 1) > Math.abs(a[1] - 1) ? b : a));
  const off = [...factors.values()].filter((sum) => sum !== 1).length;
  for (const form of FORMS) {
    const told: SkinWarning[] = [];
    using skin = make(form, rig, { onWarning: (warning) => told.push(warning) });
    expect(skin.deform()).toEqual(Float32Array.from(rig.positions));
    expect(told.map(({ code }) => code)).toEqual(off > 0 ? ['weights-not-one'] : []);
    if (off === 0) continue;
    expect(Math.abs((told[0]?.sum ?? 1) - 1)).toBeCloseTo(Math.abs(worst[1] - 1), 9);
    expect(factors.get(told[0]?.culprit.index ?? -1)).toBeCloseTo(told[0]?.sum ?? 0, 9);
    expect(told[0]?.message).toContain(`vertex ${told[0]?.culprit.index}`);
  }
});

test.each(SEEDS)('the result is that of the same weights divided by their sums (seed %i)', (seed) => {
  const next = random(seed);
  const rig = anyRig(next, () => 0.2 + Math.abs(next.number()));
  const handles = rig.weights.length / (rig.positions.length / rig.dimension);
  const sum = (v: number) =>
    Array.from(rig.weights)
      .slice(v * handles, (v + 1) * handles)
      .reduce((a, b) => a + b, 0);
  const divided = Array.from(rig.weights, (w, i) => w / sum(Math.floor(i / handles)));
  for (const form of FORMS) {
    using given = make(form, rig, { onWarning: () => {} });
    using right = make(form, { ...rig, weights: divided }, { normalize: false });
    const transforms = Array.from(given.transforms, (x) => x + next.number() / 4);
    given.transforms.set(transforms);
    right.transforms.set(transforms);
    const [a, b] = [given.deform(), right.deform()];
    expect(Math.max(...a.map((x, i) => Math.abs(x - (b[i] ?? 0))))).toBeLessThan(1e-3); // of 1000
  }
});

describe('what is rounded is no warning, and is normalized all the same', () => {
  test.each([
    ['bytes', 255, 4],
    ['bytes', 255, 8],
    ['16 bits', 65535, 4],
    ['16 bits', 65535, 8],
  ])('weights in %s (steps of 1/%i, %i a vertex)', (_, steps, handles) => {
    const next = random(handles * steps);
    const rig = { dimension: 3, positions: next.numbers(300).map((x) => 1000 * x), weights: [] as number[] } as const;
    for (let v = 0; v < 100; v++) {
      const row = next.numbers(handles).map((x) => x + 1.001);
      const sum = row.reduce((a, b) => a + b, 0);
      rig.weights.push(...row.map((w) => Math.round((w / sum) * steps) / steps));
    }
    expect(
      new Set(rig.weights.map((_w, i) => (i % handles ? 1 : rig.weights.slice(i, i + handles).reduce((a, b) => a + b, 0)))).size,
    ).toBeGreaterThan(1);
    for (const form of FORMS) {
      const onWarning = vi.fn();
      using skin = make(form, rig, { onWarning });
      expect(skin.deform()).toEqual(Float32Array.from(rig.positions));
      expect(onWarning).not.toHaveBeenCalled();
    }
  });

  test('the threshold is half a step of a byte for each weight that is not 0, eight at most', () => {
    const told = (weights: number[]) => {
      const onWarning = vi.fn();
      hb.linearBlend({ positions: [1, 2, 3], weights, onWarning }).dispose();
      return onWarning.mock.calls.length;
    };
    const half = 0.5 / 255;
    for (const handles of [1, 2, 5, 8, 20]) {
      const off = (many: number) => Array.from({ length: handles }, (_, j) => 1 / handles + (j === 0 ? many : 0));
      const most = half * Math.min(handles, 8);
      expect([told(off(0.98 * most)), told(off(-0.98 * most)), told(off(1.02 * most)), told(off(-1.02 * most))]).toEqual([
        0, 0, 1, 1,
      ]);
    }
    expect(told([0.5, 0.48])).toBe(1);
    expect(told([1 - 1.02 * half, 0, 0, 0, 0, 0])).toBe(1);
  });

  test('what sums to 1 to nine digits is taken bit by bit: weights of the solver’s own, too', () => {
    const mesh = boxMesh([3, 1, 1], [9, 3, 3]);
    const solid = hb.tetrahedralize(mesh, { resolution: 12 });
    using weights = hb.biharmonicWeights(solid, [{ at: [0.3, 0.5, 0.5] }, { at: [2.7, 0.5, 0.5] }]);
    const rig = { dimension: 3, positions: Array.from(solid.positions), weights: weights.weights } as const;
    for (const form of FORMS) {
      using given = make(form, rig);
      using taken = make(form, rig, { normalize: false });
      for (const skin of [given, taken]) skin.transforms.set([0, -1, 0, 0.3, 1, 0, 0, 0.2, 0, 0, 1, 0], 12);
      expect(given.deform()).toEqual(taken.deform());
    }
  });
});

describe('rows that no division can mend', () => {
  test.each([
    ['zeros', [0, 0]],
    ['a negative sum', [-0.5, -0.2]],
    ['signs that cancel', [1, -1]],
    ['signs that nearly cancel', [1, -0.9999]],
  ])('%s are refused, and the vertex is named', (_, row) => {
    const rig = { dimension: 2, positions: [1, 2, 3, 4, 5, 6], weights: [1, 0, ...row, 0.5, 0.5] } as const;
    for (const form of FORMS) {
      const error = errorOf(() => make(form, rig));
      expect([error.code, error.culprit]).toEqual(['weights-missing', { kind: 'vertex', index: 1 }]);
      expect(error.message).toContain('vertex 1');
      expect(error.remedy).toContain('normalize: false');
    }
  });

  test.each([
    [3e38, 3e38],
    [3.4e38, 1, 3.4e38, 2e38],
    [1e-45, 1e-45],
    [1e-300, 3e-300],
    [5e-324, 0],
  ])('large and small ones are mended as long as floats hold each: %d, %d …', (...row) => {
    for (const form of FORMS) {
      const weights = Array.from({ length: 3 * row.length }, (_, i) =>
        Math.floor(i / row.length) === 1 ? (row[i % row.length] as number) : 1 / row.length,
      );
      const told: SkinWarning[] = [];
      using skin = make(
        form,
        { dimension: 2, positions: [1, 2, 3, 4, 5, 6], weights },
        { onWarning: (warning) => told.push(warning) },
      );
      expect(Array.from(skin.deform()).map((x) => Math.round(1e5 * x) / 1e5)).toEqual([1, 2, 3, 4, 5, 6]);
      expect(told).toMatchObject([{ culprit: { index: 1 }, sum: row.reduce((sum, weight) => sum + weight, 0) }]);
    }
  });

  test('numbers that are none are refused by the solver, which names the vertex', () => {
    for (const bad of [Number.NaN, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY, 1e39]) {
      for (const normalize of [true, false]) {
        for (const form of FORMS) {
          expect(
            errorOf(() => make(form, { dimension: 2, positions: [1, 2, 3, 4], weights: [1, 0, bad, 1] }, { normalize })),
          ).toMatchObject({
            code: 'value-not-finite',
            culprit: { kind: 'vertex', index: 1 },
          });
        }
      }
    }
  });
});

test('with normalize: false weights are taken as they are: zeros too, but for dual quaternions, which have no motion then', () => {
  const rig = { dimension: 2, positions: [10, 20, 3, 4], weights: [0.5, 0.48, 0, 0] } as const;
  const warn = vi.spyOn(console, 'warn').mockImplementation(() => {});
  for (const form of ['direct', 'compiled'] as const) {
    using skin = make(form, rig, { normalize: false });
    const moved = skin.deform();
    [9.8, 19.6, 0, 0].forEach((x, i) => {
      expect(moved[i]).toBeCloseTo(x, 5);
    });
  }
  expect(errorOf(() => make('dual quaternion', rig, { normalize: false }))).toMatchObject({
    code: 'weights-missing',
    culprit: { kind: 'vertex', index: 1 },
  });
  expect(warn).not.toHaveBeenCalled();
  // Nobody listens: it is printed.
  make('direct', { ...rig, weights: [0.5, 0.48, 1, 0] }).dispose();
  expect(warn).toHaveBeenCalledExactlyOnceWith(expect.stringContaining('vertex 0: 0.98'));
  warn.mockRestore();
});
