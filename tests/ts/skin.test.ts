import { readFileSync } from 'node:fs';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { LINEAR_BLEND_DEFAULTS, load } from '../../wasm/ts/index.ts';
import { errorOf, expectClose, largest, largestDifference, random, rotation } from './support/scattered.ts';

const hb = await load();
const seed = 2014;

type Dimension = 2 | 3;
const forms = ['direct', 'compiled', 'dual quaternion'] as const;

interface Shape {
  readonly dimension: Dimension;
  readonly positions: number[];
  readonly weights: number[];
}

function make(form: (typeof forms)[number], shape: Shape) {
  return form === 'dual quaternion' ? hb.dualQuaternion(shape) : hb.linearBlend({ ...shape, compiled: form === 'compiled' });
}

/** Vertices in [−1, 1]^d with positive weights that sum to 1. */
function randomShape(next: ReturnType<typeof random>, dimension: Dimension, vertices: number, handles: number): Shape {
  const rows = Array.from({ length: vertices }, () => next.numbers(handles).map((x) => x + 1.01));
  const weights = rows.flatMap((row) => row.map((w) => w / row.reduce((a, b) => a + b, 0)));
  return { dimension, positions: next.numbers(vertices * dimension), weights };
}

function rigid(next: ReturnType<typeof random>, dimension: Dimension): number[] {
  if (dimension === 2) {
    const angle = Math.PI * next.number();
    return [Math.cos(angle), -Math.sin(angle), next.number(), Math.sin(angle), Math.cos(angle), next.number()];
  }
  const r = rotation(next);
  return [0, 1, 2].flatMap((row) => [...r.slice(3 * row, 3 * row + 3), next.number()]);
}

/** Σⱼ wᵢⱼ Tⱼ [vᵢ; 1], literally. */
function textbook({ dimension: d, positions, weights }: Shape, transforms: ArrayLike<number>): number[] {
  const count = positions.length / d;
  const handles = weights.length / count;
  return positions.map((_, at) => {
    const [i, row] = [Math.floor(at / d), at % d];
    let sum = 0;
    for (let j = 0; j < handles; j++) {
      const t = (j * d + row) * (d + 1);
      let image = transforms[t + d] ?? 0;
      for (let axis = 0; axis < d; axis++) image += (transforms[t + axis] ?? 0) * (positions[i * d + axis] ?? 0);
      sum += (weights[i * handles + j] ?? 0) * image;
    }
    return sum;
  });
}

const cases = fc.record({
  dimension: fc.constantFrom<Dimension>(2, 3),
  vertices: fc.integer({ min: 1, max: 33 }),
  handles: fc.integer({ min: 1, max: 12 }),
  number: fc.nat(),
});

test('linear blending is what libigl’s lbs_matrix makes, to 1e-6 of the extent', () => {
  const oracle = JSON.parse(readFileSync(new URL('../oracles/linear_blend.json', import.meta.url), 'utf8')) as (Shape & {
    readonly transforms: number[];
    readonly deformed: number[];
  })[];
  expect(oracle.length).toBe(6);
  for (const { transforms, deformed, ...shape } of oracle) {
    for (const compiled of [false, true]) {
      using skin = hb.linearBlend({ ...shape, compiled, normalize: false });
      skin.transforms.set(transforms);
      expect(largestDifference(skin.deform(), deformed)).toBeLessThan(1e-6 * largest(deformed));
    }
  }
});

describe('properties', () => {
  test(`linear blending is its formula, in both forms (seed ${seed})`, () => {
    fc.assert(
      fc.property(cases, fc.boolean(), ({ dimension, vertices, handles, number }, unity) => {
        const next = random(number);
        const shape = randomShape(next, dimension, vertices, handles);
        if (!unity) for (let i = 0; i < shape.weights.length; i++) shape.weights[i] = next.number();
        const transforms = next.numbers(handles * dimension * (dimension + 1));
        for (const compiled of [false, true]) {
          using skin = hb.linearBlend({ ...shape, compiled, normalize: unity });
          skin.transforms.set(transforms);
          expectClose(skin.deform(), textbook(shape, transforms), 1e-6 * Math.max(1, unity ? 1 : handles));
        }
      }),
      { seed, numRuns: 150 },
    );
  });

  test(`at rest nothing moves; a rigid motion of all handles is the shape's (seed ${seed})`, () => {
    fc.assert(
      fc.property(cases, ({ dimension, vertices, handles, number }) => {
        const next = random(number);
        const shape = randomShape(next, dimension, vertices, handles);
        const motion = rigid(next, dimension);
        for (const form of forms) {
          using skin = make(form, shape);
          expect(skin.deform()).toEqual(Float32Array.from(shape.positions));
          for (let j = 0; j < handles; j++) skin.transforms.set(motion, j * motion.length);
          expectClose(
            skin.deform(),
            textbook({ ...shape, weights: shape.weights.map((_, i) => (i % handles ? 0 : 1)) }, skin.transforms),
            2e-6,
          );
        }
      }),
      { seed, numRuns: 100 },
    );
  });

  test(`dual quaternions move every vertex rigidly about a shared center (seed ${seed})`, () => {
    fc.assert(
      fc.property(cases, ({ dimension, vertices, handles, number }) => {
        const next = random(number);
        const shape = randomShape(next, dimension, vertices, handles);
        using skin = make('dual quaternion', shape);
        for (let j = 0; j < handles; j++) {
          const turn = rigid(next, dimension);
          turn.forEach((x, i) => {
            skin.transforms[j * turn.length + i] = i % (dimension + 1) === dimension ? 0 : x;
          });
        }
        const moved = skin.deform();
        const length = (of: ArrayLike<number>, i: number) =>
          Math.hypot(...Array.from({ length: dimension }, (_, axis) => of[i * dimension + axis] ?? 0));
        for (let i = 0; i < vertices; i++) expect(Math.abs(length(moved, i) - length(shape.positions, i))).toBeLessThan(1e-4);
      }),
      { seed, numRuns: 100 },
    );
  });
});

test('candy wrapper: at 180° the middle of a bar collapses under linear blending and keeps its radius under dual quaternions', () => {
  const shape: Shape = { dimension: 3, positions: [-1, 0.2, 0, 0, 0.2, 0, 1, 0.2, 0], weights: [1, 0, 0.5, 0.5, 0, 1] };
  const turn = [1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0];
  const radius = (form: (typeof forms)[number]) => {
    using skin = make(form, shape);
    skin.transforms.set(turn, 12);
    const moved = skin.deform();
    return Math.hypot(moved[4] ?? 0, moved[5] ?? 0);
  };
  expect(radius('direct')).toBeLessThan(1e-7);
  expect(radius('compiled')).toBeLessThan(1e-7);
  expect(radius('dual quaternion')).toBeCloseTo(0.2, 6);
});

test('transforms outlive a growth of memory, in place; out is filled; defaults', async () => {
  const own = await load();
  const shape: Shape = { dimension: 2, positions: [0, 0, 1, 0, 2, 0], weights: [1, 0, 0.5, 0.5, 0, 1] };
  using skin = own.linearBlend({ ...shape, compiled: LINEAR_BLEND_DEFAULTS.compiled });
  const { transforms } = skin;
  const before = own.memory;
  const big = own.linearBlend({
    positions: new Float64Array(3 * 200_000),
    weights: new Float64Array(8 * 200_000).fill(1 / 8),
    compiled: true,
  });
  expect(own.memory).toBeGreaterThan(before);
  expect([big.dimension, big.vertexCount, big.handleCount]).toEqual([3, 200_000, 8]);
  big.dispose();
  transforms.set([0, -1, 2, 1, 0, 0], 6);
  expect(skin.transforms).toBe(transforms);
  const out = new Float32Array(6);
  expect(skin.deform(out)).toBe(out);
  expectClose(out, [0, 0, 1.5, 0.5, 2, 2], 1e-7);
});

test('bad input is named', () => {
  const shape: Shape = { dimension: 2, positions: [0, 0, 1, 0, 2, 0], weights: [1, 0, 0.5, 0.5, 0, 1] };
  for (const form of forms) {
    const failure = (change: Partial<Shape>) => errorOf(() => make(form, { ...shape, ...change }));
    expect(failure({ dimension: 4 as 3 }).code).toBe('invalid-shape');
    expect(failure({ positions: [1, 2, 3] }).code).toBe('invalid-shape');
    expect(failure({ positions: [], weights: [] }).code).toBe('invalid-shape');
    expect(failure({ weights: [1, 2, 3, 4] }).code).toBe('invalid-shape');
    expect(failure({ weights: [] }).code).toBe('invalid-shape');
    expect(failure({ positions: [0, 0, 1, Number.NaN, 2, 0] })).toMatchObject({
      code: 'mesh-not-finite',
      culprit: { kind: 'vertex', index: 1 },
    });
    expect(failure({ weights: [1, 0, 0, 1, 0, 1e300] })).toMatchObject({
      code: 'value-not-finite',
      culprit: { kind: 'vertex', index: 2 },
    });
    const skin = make(form, shape);
    skin.transforms[8] = Number.POSITIVE_INFINITY;
    const out = new Float32Array(6).fill(7);
    expect(errorOf(() => skin.deform(out))).toMatchObject({ code: 'target-not-finite', culprit: { kind: 'handle', index: 1 } });
    expect(Array.from(out)).toEqual([7, 7, 7, 7, 7, 7]);
    skin.transforms[8] = 0;
    expect(errorOf(() => skin.deform(new Float32Array(5))).code).toBe('invalid-shape');
    skin.deform(out);
    skin.dispose();
    skin.dispose();
    expect(errorOf(() => skin.deform(out)).code).toBe('disposed');
  }
  expect(errorOf(() => make('dual quaternion', { ...shape, weights: [1, 0, 0, 0, 0, 1] }))).toMatchObject({
    code: 'weights-missing',
    culprit: { kind: 'vertex', index: 1 },
  });
});
