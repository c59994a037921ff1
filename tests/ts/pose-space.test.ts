import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { HandlebodyError, load, POSE_SPACE_DEFAULTS, type PoseExample, type PoseSpaceOptions } from '../../wasm/ts/index.ts';
import { POSE_KERNELS } from './support/pose-kernels.ts';

const hb = await load();
const seed = 19800101;

// Approximate readings of Russell's (1980) Fig. 4; shapes made so that each is easy to recognize.
const places: Record<string, readonly [number, number]> = {
  neutral: [0, 0],
  happy: [0.83, 0.53],
  calm: [0.56, -0.31],
  'at ease': [0.59, -0.26],
  tired: [0.04, -0.63],
  sad: [-0.65, -0.27],
  angry: [-0.52, 0.58],
  astonished: [0.16, 0.89],
};
const dimensions = ['valence', 'arousal'];
const examples: PoseExample[] = Object.entries(places).map(([name, at], k) => ({ name, at, shape: [k, k * k, -at[0], 1] }));

function errorOf(run: () => unknown): HandlebodyError {
  try {
    run();
  } catch (error) {
    if (error instanceof HandlebodyError) return error;
    throw error;
  }
  throw new Error('expected a HandlebodyError');
}

const sum = (values: ArrayLike<number>) => Array.from(values).reduce((a, b) => a + b, 0);

/** Example i changed, the others as they are. */
function changed(i: number, change: Partial<PoseExample>): PoseExample[] {
  return examples.map((example, k) => (k === i ? { ...example, ...change } : example));
}

describe('weights', () => {
  test.each([
    ['cardinal', undefined],
    ['normalized', undefined],
    ...POSE_KERNELS.map((kernel) => ['cardinal', kernel] as const),
    ...POSE_KERNELS.slice(3).map((kernel) => ['normalized', kernel] as const),
  ] as const)('%s %s: 1 at the own place, 0 at the others to 1e-9, sum 1', (method, kernel) => {
    using space = hb.poseSpace({ dimensions, examples, method, ...(kernel && { kernel }) });
    expect(space.names).toEqual(Object.keys(places));
    examples.forEach(({ at }, i) => {
      const weights = space.weights(at);
      weights.forEach((weight, k) => {
        expect(weight).toBeCloseTo(i === k ? 1 : 0, 9);
      });
    });
    expect(sum(space.weights([0.9, -0.9]))).toBeCloseTo(1, 9);
  });

  test(`sum to 1 and stay tame anywhere on the pad and far away (seed ${seed})`, () => {
    using space = hb.poseSpace({ dimensions, examples });
    const coordinate = fc.oneof(fc.double({ min: -1, max: 1, noNaN: true }), fc.double({ noNaN: true, noDefaultInfinity: true }));
    fc.assert(
      fc.property(coordinate, coordinate, (valence, arousal) => {
        const weights = space.weights([valence, arousal]);
        expect(Math.abs(sum(weights) - 1)).toBeLessThan(1e-9);
        expect(Math.min(...weights)).toBeGreaterThan(-1);
        expect(Math.max(...weights)).toBeLessThan(1.6);
      }),
      { seed, numRuns: 300 },
    );
  });

  test(`any places: cardinal, in any order, or a sentence that says why not (seed ${seed})`, () => {
    const place = fc.array(fc.integer({ min: -1000, max: 1000 }), { minLength: 3, maxLength: 3 });
    fc.assert(
      fc.property(fc.array(place, { minLength: 1, maxLength: 20 }), (ats) => {
        const some = ats.map((at, k) => ({ name: `example ${k}`, at, shape: [k] }));
        const coincide = new Set(ats.map(String)).size < ats.length;
        if (coincide) {
          expect(errorOf(() => hb.poseSpace({ dimensions: ['x', 'y', 'z'], examples: some })).code).toBe('example-duplicate');
          return;
        }
        using space = hb.poseSpace({ dimensions: ['x', 'y', 'z'], examples: some });
        using reversed = hb.poseSpace({ dimensions: ['x', 'y', 'z'], examples: some.toReversed() });
        for (const [k, at] of ats.entries()) expect(space.weights(at)[k]).toBeCloseTo(1, 9);
        const query = [1, 2, 3];
        const other = reversed.weights(query).reverse();
        space.weights(query).forEach((weight, k) => {
          expect(weight).toBeCloseTo(other[k] ?? Number.NaN, 9);
        });
      }),
      { seed, numRuns: 60 },
    );
  });

  test('degree 1 reproduces the place', () => {
    using space = hb.poseSpace({ dimensions, examples, degree: 1 });
    const weights = space.weights([0.3, -2]);
    for (const axis of [0, 1])
      expect(sum(weights.map((w, k) => w * (examples[k]?.at[axis] ?? 0)))).toBeCloseTo([0.3, -2][axis] ?? 0, 9);
  });

  test('go into the array that the caller gives', () => {
    using space = hb.poseSpace({ dimensions, examples });
    const out = new Float64Array(examples.length);
    expect(space.weights([0.1, 0.2], out)).toBe(out);
    expect(out).toEqual(space.weights([0.1, 0.2]));
    expect(errorOf(() => space.weights([0, 0], new Float64Array(3))).code).toBe('invalid-shape');
  });

  test('options left out are the defaults', () => {
    using space = hb.poseSpace({ dimensions, examples });
    using explicit = hb.poseSpace({ dimensions, examples, ...POSE_SPACE_DEFAULTS });
    using named = hb.poseSpace({ dimensions, examples, kernel: 'multiquadric', degree: 0 });
    expect(explicit.weights([0.4, 0.1])).toEqual(space.weights([0.4, 0.1]));
    expect(named.weights([0.4, 0.1])).toEqual(space.weights([0.4, 0.1]));
  });
});

describe('evaluate', () => {
  test('gives the example at its place and the weighted sum elsewhere', () => {
    using space = hb.poseSpace({ dimensions, examples });
    for (const { at, shape } of examples) {
      space.evaluate(at).forEach((value, i) => {
        expect(value).toBeCloseTo(shape[i] ?? Number.NaN, 7);
      });
    }
    const weights = space.weights([0.2, 0.4]);
    const result = space.evaluate([0.2, 0.4]);
    [0, 1, 2, 3].forEach((i) => {
      expect(result[i]).toBeCloseTo(sum(weights.map((w, k) => w * (examples[k]?.shape[i] ?? 0))), 12);
    });
  });

  test('writes floats or doubles, and keeps its own copy of the shapes', () => {
    const shapes = examples.map(({ shape }) => Float32Array.from(shape));
    using space = hb.poseSpace({ dimensions, examples: examples.map((e, k) => ({ ...e, shape: shapes[k] ?? [] })) });
    const out = new Float32Array(4);
    expect(space.evaluate([0.83, 0.53], out)).toBe(out);
    expect(out[0]).toBeCloseTo(1, 6);
    for (const shape of shapes) shape.fill(99);
    expect(space.evaluate([0.83, 0.53])[0]).toBeCloseTo(1, 6);
    expect(errorOf(() => space.evaluate([0, 0], new Float32Array(5))).code).toBe('invalid-shape');
  });

  test('works on when memory has grown in between', () => {
    using space = hb.poseSpace({ dimensions, examples });
    const before = space.evaluate([0.3, 0.3]);
    const size = hb.memory;
    using _large = hb.linearBlend({ positions: new Float64Array(3 * 200_000), weights: new Float64Array(8 * 200_000).fill(1 / 8) });
    expect(hb.memory).toBeGreaterThan(size);
    expect(space.evaluate([0.3, 0.3])).toEqual(before);
  });

  test('one example is its own shape everywhere', () => {
    for (const method of ['cardinal', 'normalized'] as const) {
      using space = hb.poseSpace({ dimensions, examples: examples.slice(1, 2), method });
      expect(space.evaluate([-7, 3])).toEqual(Float64Array.of(1, 1, -0.83, 1));
    }
  });
});

describe('errors name the culprit and a remedy', () => {
  const cases: [string, Partial<PoseSpaceOptions>, string, number | undefined, RegExp][] = [
    ['no examples', { examples: [] }, 'examples-too-few', undefined, /no examples/],
    ['no dimensions', { dimensions: [] }, 'invalid-shape', undefined, /no dimensions/],
    [
      '65 dimensions',
      { dimensions: Array(65).fill('x'), examples: [{ name: 'a', at: Array(65).fill(0), shape: [] }] },
      'invalid-shape',
      undefined,
      /65/,
    ],
    [
      'shapes of different lengths',
      { examples: changed(2, { shape: [1] }) },
      'example-shape-mismatch',
      2,
      /"calm" has 1 numbers, that of "neutral" 4/,
    ],
    [
      'a shape with NaN',
      { examples: changed(5, { shape: [0, 0, Number.NaN, 0] }) },
      'example-not-finite',
      5,
      /shape\[2\]" \(example 5, "sad"\) is NaN/,
    ],
    [
      'a place with infinity',
      { examples: changed(1, { at: [1, 1 / 0] }) },
      'example-not-finite',
      1,
      /at\[1\]" \(example 1, "happy"\) is Infinity/,
    ],
    ['a place of the wrong length', { examples: changed(1, { at: [1] }) }, 'invalid-shape', 1, /"happy" has 1 numbers/],
    [
      'two shapes at one place',
      { examples: changed(3, { at: [0.56 + 1e-12, -0.31] }) },
      'example-duplicate',
      3,
      /"at ease".*"calm"/,
    ],
    ['an unknown kernel', { kernel: 'toString' as 'linear' }, 'invalid-option', undefined, /"toString"/],
    ['an unknown method', { method: 'magic' as 'cardinal' }, 'invalid-option', undefined, /"magic"/],
    ['a width of 0', { width: 0 }, 'invalid-option', undefined, /"width" is 0/],
    ['a tail too low', { kernel: 'thin-plate', degree: 0 }, 'invalid-option', undefined, /degree 1/],
    ['a kernel that cannot be normalized', { method: 'normalized', kernel: 'linear' }, 'invalid-option', undefined, /normalized/],
  ];
  test.each(cases)('%s', (_, options, code, index, message) => {
    const error = errorOf(() => hb.poseSpace({ dimensions, examples, ...options }));
    expect(error.code).toBe(code);
    expect(error.message).toMatch(message);
    expect(error.remedy).not.toBe('');
    if (index !== undefined) expect(error.culprit).toEqual({ kind: 'example', index });
  });

  test('a query that is not finite, or has the wrong length, leaves the pose space usable', () => {
    using space = hb.poseSpace({ dimensions, examples });
    expect(errorOf(() => space.weights([Number.NaN, 0])).code).toBe('query-not-finite');
    expect(errorOf(() => space.evaluate([0])).code).toBe('invalid-shape');
    expect(space.weights([0, 0])[0]).toBeCloseTo(1, 9);
  });

  test('after dispose, which may be repeated', () => {
    const space = hb.poseSpace({ dimensions, examples });
    space.dispose();
    space.dispose();
    expect(errorOf(() => space.weights([0, 0])).code).toBe('disposed');
    expect(errorOf(() => space.evaluate([0, 0])).code).toBe('disposed');
  });
});

test('equal shapes at one place are one example, and which is said', () => {
  const twin = { name: 'content', at: [0.56, -0.31], shape: Array.from(examples[2]?.shape ?? []) };
  using space = hb.poseSpace({ dimensions, examples: [...examples, twin] });
  expect(space.names).not.toContain('content');
  expect(space.merged).toEqual([{ name: 'content', into: 'calm' }]);
});

test('what is disposed gives its memory back', async () => {
  const own = await load();
  // Each holds a matrix of 150 × 150: 150 that stayed would take 27 MB, and memory begins with 16.
  const many = Array.from({ length: 150 }, (_, k) => ({ name: `${k}`, at: [Math.cos(k), Math.sin(k * k)], shape: [k] }));
  const round = () => own.poseSpace({ dimensions, examples: many }).dispose();
  round();
  const settled = own.memory;
  for (let i = 0; i < 150; i++) round();
  expect(own.memory).toBe(settled);
});
