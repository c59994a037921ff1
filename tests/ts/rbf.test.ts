import { describe, expect, test } from 'vitest';
import { KERNELS, type KernelName, load, type Rbf, type RbfOptions } from '../../wasm/ts/index.ts';
import { errorOf, expectClose, random, rotate, rotation } from './support/scattered.ts';

const hb = await load();
const seed = 20140728;
type Name = KernelName | 'a function';
const names: Name[] = [...(Object.keys(KERNELS) as KernelName[]), 'a function'];
/** What is known of a kernel; the caller's is the Gaussian. */
const known = (kernel: Name) => KERNELS[kernel === 'a function' ? 'gaussian' : kernel];
const quiet = () => {};

/** Options under which a kernel interpolates points in [−1, 1]^dimension well: about `count` of them. */
function comfortable(kernel: Name, dimension: number): Partial<RbfOptions> {
  const order = Math.floor(dimension / 2) + 1;
  const width = kernel === 'clamped-plate' ? 6 : known(kernel).compact && kernel !== 'compact-inverse-multiquadric' ? 1.5 : 0.35;
  return { kernel: kernel === 'a function' ? (s) => Math.exp(-s * s) : kernel, width, order, onWarning: quiet };
}

function made(
  kernel: Name,
  dimension: number,
  points: ArrayLike<number>,
  values: ArrayLike<number>,
  more: Partial<RbfOptions> = {},
): Rbf {
  return hb.rbf({ dimension, points, values, ...comfortable(kernel, dimension), ...more });
}

describe.each(names)('%s', (kernel) => {
  test(`passes through vector values, in 1 to 4 dimensions, and its weights say the same (seed ${seed})`, () => {
    const next = random(seed);
    for (const dimension of [1, 2, 3, 4]) {
      const points = next.numbers(16 * dimension);
      const values = next.numbers(16 * 3);
      using rbf = made(kernel, dimension, points, values);
      expectClose(rbf.evaluate(points), values, 1e-9 + 1e-16 * rbf.report().condition);
      const queries = next.numbers(4 * dimension);
      const weights = rbf.weights(queries);
      const evaluated = rbf.evaluate(queries);
      for (let q = 0; q < 4; q++)
        for (let j = 0; j < 3; j++) {
          const sum = Array.from({ length: 16 }, (_, k) => (weights[q * 16 + k] ?? 0) * (values[k * 3 + j] ?? 0)).reduce(
            (a, b) => a + b,
          );
          expect(sum).toBeCloseTo(evaluated[q * 3 + j] ?? Number.NaN, 7);
        }
      using one = made(
        kernel,
        dimension,
        points,
        values.filter((_, i) => i % 3 === 1),
      );
      expectClose(
        one.evaluate(queries),
        evaluated.filter((_, i) => i % 3 === 1),
        1e-9,
      );
    }
  });

  test(`does not depend on the order of the points, nor on where they are and how they are turned (seed ${seed})`, () => {
    const next = random(seed + 1);
    const dimension = 3;
    const points = next.numbers(12 * dimension);
    const values = next.numbers(12);
    const queries = next.numbers(5 * dimension);
    using rbf = made(kernel, dimension, points, values);
    const expected = rbf.evaluate(queries);
    const order = next.permutation(12);
    using shuffled = made(
      kernel,
      dimension,
      order.flatMap((i) => [...points.slice(3 * i, 3 * i + 3)]),
      order.map((i) => values[i] ?? 0),
    );
    expectClose(shuffled.evaluate(queries), expected, 1e-9, 'order');
    const shift = (all: ArrayLike<number>) => Array.from(all, (x, i) => x + ([100, -3, 0.5][i % 3] ?? 0));
    using moved = made(kernel, dimension, shift(points), values);
    expectClose(moved.evaluate(shift(queries)), expected, 1e-8, 'translation');
    if (kernel === 'clamped-plate') return; // its ball is centered on the box of the points, which turning changes
    const turn = rotation(next);
    using turned = made(kernel, dimension, rotate(turn, points), values);
    expectClose(turned.evaluate(rotate(turn, queries)), expected, 1e-9, 'rotation');
  });

  test(`scales with the points, its width and, for smoothing, the kernel (seed ${seed})`, () => {
    const next = random(seed + 2);
    const points = next.numbers(12 * 2);
    const values = next.numbers(12);
    const queries = next.numbers(5 * 2);
    const { hasWidth } = known(kernel);
    const exponent = { linear: 1, cubic: 3, quintic: 5, 'thin-plate': 2, polyharmonic: 2 }[kernel as string] ?? 0;
    const { width } = comfortable(kernel, 2) as { width: number };
    for (const smoothing of [0, 0.03])
      for (const scale of [1e-6, 7, 1e6]) {
        using plain = made(kernel, 2, points, values, { smoothing });
        using scaled = made(
          kernel,
          2,
          points.map((x) => x * scale),
          values,
          { smoothing: smoothing * scale ** exponent, ...(hasWidth && { width: width * scale }) },
        );
        const there = queries.map((x) => x * scale);
        expectClose(scaled.evaluate(there), plain.evaluate(queries), 1e-9);
        expectClose(
          scaled.gradient(there).map((x) => x * scale),
          plain.gradient(queries),
          1e-8,
        );
      }
  });

  test(`reproduces polynomials of its tail, smoothed or not, and weights sum to 1 (seed ${seed})`, () => {
    const next = random(seed + 3);
    const points = next.numbers(20 * 2);
    const queries = next.numbers(6 * 2);
    const lowest = Math.max(0, known(kernel).minimumDegree ?? (kernel === 'polyharmonic' ? 1 : 0));
    const polynomials = [
      () => 3,
      (x: number, y: number) => 3 - 2 * x + y,
      (x: number, y: number) => 3 - 2 * x + y + x * x - 4 * x * y + 0.5 * y * y,
    ];
    const sample = (all: number[], f: (x: number, y: number) => number) =>
      Array.from({ length: all.length / 2 }, (_, i) => f(all[2 * i] ?? 0, all[2 * i + 1] ?? 0));
    for (let degree = lowest; degree <= 2; degree++) {
      const f = polynomials[degree] as (x: number, y: number) => number;
      for (const smoothing of [0, 0.1]) {
        using rbf = made(kernel, 2, points, sample(points, f), { degree: degree as 0 | 1 | 2, smoothing });
        expectClose(rbf.evaluate(queries), sample(queries, f), 1e-9);
        const weights = rbf.weights(queries);
        for (let q = 0; q < 6; q++) expect(weights.slice(20 * q, 20 * q + 20).reduce((a, b) => a + b)).toBeCloseTo(1, 8);
      }
      using decayed = made(kernel, 2, points, sample(points, f), { degree: degree as 0 | 1 | 2, weightDecay: 0.1 });
      expectClose(decayed.evaluate(queries), sample(queries, f), 1e-9);
    }
  });
});

/** Those that can be normalized: not zero at their own place. */
const normalizable = names.filter((kernel) => kernel === 'a function' || (known(kernel).hasWidth && kernel !== 'clamped-plate'));

test.each(normalizable)(`%s, normalized, is a partition of unity everywhere, in 1 to 4 dimensions (seed ${seed})`, (kernel) => {
  const next = random(seed + 4);
  for (const dimension of [1, 2, 3, 4])
    for (const width of [0.35, 1e-3]) {
      const points = next.numbers(12 * dimension);
      using rbf = made(kernel, dimension, points, Array(12).fill(5), { normalized: true, width });
      for (const far of [1, 10, 1e4, 1e200]) {
        const query = next.numbers(dimension).map((x) => x * far);
        const weights = rbf.weights(query);
        expect(weights.reduce((a, b) => a + b)).toBeCloseTo(1, 9);
        expectClose(rbf.evaluate(query), [5], 1e-9, `${far}`);
        expect(rbf.gradient(query).every((slope) => Math.abs(slope) < 1e-6 / width)).toBe(true);
      }
      expect(errorOf(() => rbf.leaveOneOut()).code).toBe('invalid-option');
    }
});

test.each(normalizable)(
  '%s, normalized, follows the nearest center where no kernel reaches, and shares among several',
  (kernel) => {
    const data = {
      dimension: 1,
      points: [0, 1, 20, 21],
      values: [5, 6, 7, 8],
      width: 0.02,
      support: 4,
      normalized: true,
      onWarning: quiet,
    };
    using rbf = hb.rbf({ ...data, kernel: kernel === 'a function' ? (s) => Math.max(0, 1 - s) ** 2 : kernel });
    const local = kernel === 'a function' || kernel === 'gaussian' || known(kernel).compact;
    if (!local) return;
    expectClose(rbf.evaluate([9, 12, 1e3, -50]), [6, 7, 8, 5], 1e-9);
    expectClose(rbf.evaluate([10.5]), [6.5], 1e-9);
    expectClose(rbf.gradient([9, 12]), [0, 0], 1e-9);
  },
);

test.each(names.filter((kernel) => !normalizable.includes(kernel)))('%s cannot be normalized, and what can is named', (kernel) => {
  const data = { dimension: 1, points: [0, 1, 2], values: [1, 2, 3], normalized: true, onWarning: quiet };
  const { code, remedy } = errorOf(() => hb.rbf({ ...data, kernel: kernel as KernelName, width: 4 }));
  expect(code).toBe('invalid-option');
  const named = names.filter((name) => new RegExp(`\\b${name}\\b`).test(remedy));
  expect(named.length).toBeGreaterThan(2);
  for (const other of named) hb.rbf({ ...data, kernel: other as KernelName, width: 1 }).dispose();
});

test(`a Mahalanobis metric LLᵀ is Euclidean distance after Lᵀ (seed ${seed})`, () => {
  const next = random(seed + 5);
  const [a, b, c] = [1.5, 0.8, 0.6];
  const transform = (all: number[]) => all.flatMap((x, i) => (i % 2 ? [] : [a * x + b * (all[i + 1] ?? 0), c * (all[i + 1] ?? 0)]));
  const [points, values, queries] = [next.numbers(24), next.numbers(12), next.numbers(10)];
  const metric = [a * a, a * b, a * b, b * b + c * c];
  for (const kernel of names) {
    if (kernel === 'clamped-plate') continue; // its ball is centered on the box of the points, which the metric changes
    using direct = made(kernel, 2, transform(points), values);
    using stretched = made(kernel, 2, points, values, { metric });
    expectClose(stretched.evaluate(queries), direct.evaluate(transform(queries)), 1e-9);
  }
  expect(errorOf(() => made('gaussian', 2, points, values, { metric: [1, 2, 2, 1] })).code).toBe('invalid-option');
  expect(errorOf(() => made('gaussian', 2, points, values, { metric: [1, 2, 2] })).code).toBe('invalid-shape');
});

test('memory is given back, and growing in between does no harm', () => {
  const other = random(seed + 12);
  const points = other.numbers(600);
  const values = other.numbers(300);
  const make = () => hb.rbf({ dimension: 2, points, values, kernel: 'multiquadric', onWarning: quiet });
  const first = make();
  const expected = first.evaluate(points.slice(0, 20));
  const rest = Array.from({ length: 12 }, make);
  expect(first.evaluate(points.slice(0, 20))).toEqual(expected);
  for (const rbf of [first, ...rest]) rbf.dispose();
  const before = hb.memory;
  for (let round = 0; round < 20; round++) {
    const rbf = make();
    rbf.weights([0, 0]);
    rbf.leaveOneOut();
    rbf.dispose();
  }
  expect(hb.memory).toBe(before);
});
