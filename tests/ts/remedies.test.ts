// Every remedy of the interpolants, pose spaces and the search for outliers that names an option, a call, a value or a range is followed
// by a program, and what it is for is gone. Those that only a person can follow are listed, with the reason.
import { describe, expect, test } from 'vitest';
import {
  HandlebodyError,
  KERNELS,
  type KernelName,
  load,
  type PoseSpaceOptions,
  type RbfOptions,
  type RbfWarning,
} from '../../wasm/ts/index.ts';
import { POSE_KERNELS } from './support/pose-kernels.ts';
import { random } from './support/scattered.ts';

const hb = await load();
const seed = 20261201;
const names = Object.keys(KERNELS) as KernelName[];

type Options = Record<string, unknown>;
type Step = (options: Options, found: RegExpExecArray, error: HandlebodyError) => Options | (() => unknown);

/** For a person: what to do is not the program's to decide. */
const PERSON: readonly [RegExp, string][] = [
  [/^Remove NaN/, 'which number is meant is not known'],
  [/^Rescale the points/, 'in which unit is not known'],
  [/^Use another kernel, or points that lie farther apart\.$/, 'nothing that was tried helps'],
  [/^Try another kernel, or fewer centers\.$/, 'nothing that was tried helps'],
  [/^Move examples apart that almost coincide\.$/, 'nothing that was tried helps'],
  [/^Return a finite number/, 'the kernel is the caller’s'],
  [/^Check the lengths/, 'which array is wrong is not known'],
  [/^Give every point the same number of values/, 'which are missing is not known'],
  [/^Give the number of coordinates/, 'the dimension is the data’s'],
  [/^Give \d+ coordinates for each, or another dimension/, 'which are missing is not known'],
  [/^Give at least one point/, 'there are no data'],
  [/^Divide the coordinates/, 'the functional is in units of the coordinates'],
  [/^Move one of the two, or remove it\.$/, 'which of the two is meant is not known'],
];

const without =
  (...keys: string[]) =>
  (options: Options) =>
    Object.fromEntries(Object.entries(options).filter(([key]) => !keys.includes(key)));
const withOption = (key: string, value: (found: RegExpExecArray) => unknown): Step => {
  return (options, found) => ({ ...options, [key]: value(found) });
};
const numberIn = (found: RegExpExecArray) => Number(found[1]);

/** Points without those of these numbers. */
function lessPoints(options: Options, out: readonly number[]): Options {
  const { dimension, points, values } = options as { dimension: number; points: number[]; values: number[] };
  const keep = (rows: number[], width: number) => rows.filter((_, i) => !out.includes(Math.floor(i / width)));
  return { ...options, points: keep(points, dimension), values: keep(values, (values.length * dimension) / points.length) };
}

/** Each alternative that a remedy names, and how it is followed. */
const STEPS: readonly [RegExp, Step][] = [
  [/width ≤ ([\d.e+-]*\d)/, withOption('width', numberIn)],
  [/smoothing ≥ ([\d.e+-]*\d)/, withOption('smoothing', numberIn)],
  [/weightDecay ≥ ([\d.e+-]*\d)/, withOption('weightDecay', numberIn)],
  [/[Uu]se a smoothing of ([\d.e+-]*\d)/, withOption('smoothing', numberIn)],
  [/[Uu]se a weightDecay of ([\d.e+-]*\d)/, withOption('weightDecay', numberIn)],
  [/a width of ([\d.e+-]*\d)/, withOption('width', numberIn)],
  [/normalized: true/, withOption('normalized', () => true)],
  [/smoothing above 0/, withOption('smoothing', () => 0.1)],
  [/epsilon above 0/, withOption('epsilon', () => 0.1)],
  [/weightDecay above 0/, withOption('weightDecay', () => 0.1)],
  [/weightDecay instead of smoothing/, (options) => ({ ...without('smoothing')(options), weightDecay: 0.1 })],
  [/^Remove one of the two/, (options, _, { culprit }) => lessPoints(options, [culprit?.index ?? -1])],
  [
    /^Use at most (\d+) centers/,
    (options, found) => {
      const { centers = [], dimension } = options as { centers?: number[]; dimension: number };
      return { ...options, centers: centers.slice(0, numberIn(found) * dimension) };
    },
  ],
  [
    /[Gg]ive centers/,
    (options) => ({ ...options, centers: (options.points as number[]).slice(0, 2 * (options.dimension as number)) }),
  ],
  [/leave out robust/, without('robust')],
  [/findOutliers\(\)/, (options) => () => hb.findOutliers(without('robust')(options) as unknown as RbfOptions)],
  [/wendland-c2/, withOption('kernel', () => 'wendland-c2')],
  [/single width/, withOption('width', () => 'auto')],
  [/^Give a metric: .*\[(.*)\]/, withOption('metric', (found) => (found[1] ?? '').split(', ').map(Number))],
  [/or leave out metric/, without('metric')],
  [/units of the points, or leave (?:it|them) out|center, or leave them out/, without('width')],
  [/^Leave them out, or/, without('smoothing', 'weightDecay')],
  [/^Leave out the widths?/, without('width')],
  [/^Leave out kernel, method, width and degree/, without('kernel', 'method', 'width', 'degree')],
  [/^Raise the degree to (\d)/, withOption('degree', numberIn)],
  [/^Use degree (\d)/, withOption('degree', numberIn)],
  [/^Give a whole number from -1 to (\d)/, withOption('degree', numberIn)],
  [/^Give a positive number/, withOption('width', () => 1)],
  [/^Give a number from (\d) on/, withOption('smoothing', numberIn)],
  [/^Use degree 0, or 1/, withOption('degree', () => 1)],
  [/or leave out the method and the degree/, without('method', 'degree')],
  [/[Uu]se order (\d+)/, withOption('order', numberIn)],
  [/^Use the kernel cubic/, withOption('kernel', () => 'cubic')],
  [/^Use gaussian, /, withOption('kernel', () => 'gaussian')],
  [/or leave out normalized/, without('normalized')],
  [/^Use one of the two/, without('weightDecay')],
  [
    /^Use one of: ([^,.]+)/,
    (options, found, error) => {
      const option = /no (?:pose space has no )?(?:robust )?(\w+) called/.exec(error.message)?.[1] ?? '';
      return { ...options, [option.replace('method', 'method')]: found[1] };
    },
  ],
  [/^Remove one of each/, (options) => options],
  [/^Nothing has to be done; remove it/, (options) => options],
];

/** The alternatives of a remedy; none where it is for a person. */
function alternatives(remedy: string): [RegExpExecArray, Step][] {
  return STEPS.flatMap(([pattern, step]) => {
    const found = pattern.exec(remedy);
    return found ? [[found, step] as [RegExpExecArray, Step]] : [];
  });
}

function outcome(run: () => { dispose(): void } | unknown): HandlebodyError | undefined {
  try {
    (run() as { dispose?: () => void }).dispose?.();
    return undefined;
  } catch (error) {
    expect(error).toBeInstanceOf(HandlebodyError);
    return error as HandlebodyError;
  }
}

/** Follows each alternative of the error's remedy: that error must be gone. Returns how many were followed. */
function follow(make: (options: Options) => unknown, options: Options, former: readonly string[] = []): number {
  const error = outcome(() => make(options));
  if (!error) return 0;
  if (PERSON.some(([pattern]) => pattern.test(error.remedy))) return 0;
  const steps = alternatives(error.remedy);
  expect(steps.length, `nobody follows: ${error.message} ${error.remedy}`).toBeGreaterThan(0);
  for (const [found, step] of steps) {
    let next = step(options, found, error);
    let still = outcome(typeof next === 'function' ? next : () => make(next as Options));
    // Points at one place are removed one at a time.
    for (let round = 0; round < 8 && still?.code === 'point-duplicate' && /^Remove/.test(found[0]); round++) {
      next = lessPoints(next as Options, [still.culprit?.index ?? -1]);
      still = outcome(() => make(next as Options));
    }
    const told = `after "${found[0]}" of: ${error.message} ${error.remedy}`;
    if (!still) continue;
    // Another error may be left, of an option that was wrong too: its remedy must lead out, and not back.
    expect(former.concat(error.message), told).not.toContain(still.message);
    expect(typeof next, told).toBe('object');
    expect(follow(make, next as Options, former.concat(error.message)), told).toBeGreaterThan(0);
  }
  return steps.length;
}

const WEIGHTY: readonly RbfWarning['code'][] = [
  'ill-conditioned',
  'misses-points',
  'narrow-width',
  'near-duplicates',
  'uneven-axes',
];

function warningsOf(options: Options): RbfWarning[] {
  const told: RbfWarning[] = [];
  hb.rbf({ ...(options as unknown as RbfOptions), onWarning: (warning) => told.push(warning) }).dispose();
  return told;
}

/** Follows each alternative of each warning: it must be gone, and no other of weight must have come. */
function followWarnings(options: Options, what: string): number {
  let followed = 0;
  const told = warningsOf(options);
  const before = told.map(({ code }) => code);
  for (const warning of told) {
    const { code, remedy } = warning;
    const where = `${what}: ${warning.message} ${remedy}`;
    if (PERSON.some(([pattern]) => pattern.test(remedy))) continue;
    const steps = alternatives(remedy);
    expect(steps.length, `nobody follows ${where}`).toBeGreaterThan(0);
    for (const [found, step] of steps) {
      const removed = /^(Remove|Nothing)/.test(found[0]);
      let next = step(options, found, new HandlebodyError('internal', warning)) as Options;
      for (let round = 0, now: RbfWarning | undefined = warning; removed && now && round < 20; round++) {
        const pairs = now.points ?? [];
        next = lessPoints(next, code === 'near-duplicates' ? pairs.filter((_, i) => i === 1) : pairs);
        now = warningsOf(next).find((other) => other.code === code);
      }
      const after = warningsOf(next);
      const left = after.filter((one) => one.code === code || (WEIGHTY.includes(one.code) && !before.includes(one.code)));
      expect(left, `after "${found[0]}" of ${where}`).toEqual([]);
      followed++;
    }
    // A button sets what the sentence names.
    for (const [name, value] of Object.entries(warning.suggestion ?? {}))
      if (typeof value === 'number') {
        const said = new RegExp(`${name}\\D*?(\\d[\\d.e+-]*\\d|\\d)`).exec(remedy)?.[1];
        expect(Number(said), where).toBe(value);
      }
  }
  return followed;
}

test(`warnings of fits over random points, near twins, clusters and widths of any size (seed ${seed})`, () => {
  const next = random(seed);
  let followed = 0;
  const seen = new Set<string>();
  for (const kernel of names)
    for (let round = 0; round < 14; round++) {
      const dimension = 1 + (round % 3);
      const count = 6 + Math.floor(20 * Math.abs(next.number()));
      const points = next.numbers(count * dimension);
      const cluster = round % 4;
      if (cluster === 1)
        for (let i = dimension; i < 4 * dimension; i++) points[i] = (points[i % dimension] ?? 0) + 1e-2 * next.number();
      if (cluster === 2)
        for (let i = dimension; i < 2 * dimension; i++) points[i] = (points[i % dimension] ?? 0) + 1e-5 * next.number();
      if (cluster === 3) for (let i = 0; i < points.length; i += dimension) points[i] = (points[i] ?? 0) * 1e9;
      // In another metric a width in numbers is another width.
      const width = kernel === 'clamped-plate' || cluster === 3 ? 'auto' : 10 ** (3 * next.number() - 0.5);
      const options = { dimension, points, values: next.numbers(count), kernel, width, order: 2 };
      for (const { code } of warningsOf(options)) seen.add(code);
      followed += followWarnings(options, `${kernel}, round ${round}, width ${width}`);
    }
  expect(followed).toBeGreaterThan(200);
  expect([...seen].sort()).toEqual([
    'ill-conditioned',
    'misses-points',
    'narrow-width',
    'near-duplicates',
    'not-definite',
    'uneven-axes',
  ]);
});

test('no circle: a width for few close points and many far ones', () => {
  // Ill conditioned at 0.19 for the pair, narrow at 0.014 for the others.
  const points = [...Array.from({ length: 12 }, (_, i) => i / 11), ...Array.from({ length: 4 }, (_, i) => 0.5 + 1e-3 * (i + 1))];
  for (const kernel of ['gaussian', 'inverse-quadratic', 'inverse-multiquadric'] as const)
    for (const width of [0.001, 0.014, 0.05, 0.19, 1, 10])
      followWarnings({ dimension: 1, points, values: points.map(Math.sin), kernel, width }, `${kernel} ${width}`);
});

describe('errors', () => {
  const points = [0, 0, 1, 0, 0, 1, 1, 1, 0.3, 0.6];
  const data = { dimension: 2, points, values: [1, 2, 3, 4, 5], onWarning: () => {} };
  const twins = { ...data, points: [...points, 1, 0, 0.3, 0.6], values: [1, 2, 3, 4, 5, 6, 7] };
  const far = (d: number) => ({ ...data, dimension: d, points: random(3).numbers(5 * d) });
  const rbf = (options: Options) => hb.rbf(options as unknown as RbfOptions);
  const cases: [string, (options: Options) => unknown, Options][] = [
    ['twins', rbf, twins],
    ['twins in a metric', rbf, { ...twins, metric: [1, 0, 0, 2] }],
    ['a degree too low', rbf, { ...data, degree: 0 }],
    ['a degree too low, on a line', rbf, { ...data, points: [0, 0, 1, 1, 2, 2, 3, 3, 4, 4], degree: 0 }],
    ['a quintic of degree 0, few points', rbf, { ...data, points: [0, 0, 1, 1], values: [1, 2], kernel: 'quintic', degree: 0 }],
    ['a degree there is not', rbf, { ...data, degree: 5 }],
    ['a width of 0', rbf, { ...data, kernel: 'gaussian', width: 0 }],
    ['a width out of proportion', rbf, { ...data, kernel: 'gaussian', width: 1e40 }],
    ['widths below 0', rbf, { ...data, kernel: 'gaussian', width: [1, -1, 1, 1, 1] }],
    ['a width for each center of a plate', rbf, { ...data, kernel: 'clamped-plate', width: [1, 1, 1, 1, 1] }],
    ['a plate too small', rbf, { ...data, kernel: 'clamped-plate', width: 0.2 }],
    ['no metric', rbf, { ...data, metric: [1, 2, 2, 1] }],
    ['smoothing below 0', rbf, { ...data, smoothing: -1 }],
    ['both', rbf, { ...data, smoothing: 1, weightDecay: 1 }],
    ['smoothing with centers', rbf, { ...data, centers: [0, 0, 1, 1], kernel: 'gaussian', smoothing: 1 }],
    ['robust without centers', rbf, { ...data, robust: 'least-median' }],
    ['more centers than points', rbf, { ...data, kernel: 'gaussian', centers: random(1).numbers(20) }],
    ['centers twice', rbf, { ...data, kernel: 'gaussian', centers: [0, 0, 0, 0, 1, 1] }],
    ['a constant kernel', rbf, { ...data, kernel: () => 1 }],
    ['a plate in 9 dimensions of order 2', rbf, { ...far(9), kernel: 'clamped-plate', order: 2 }],
    ['polyharmonic in 20 dimensions', rbf, { ...far(20), kernel: 'polyharmonic' }],
    ['polyharmonic of order 8 in the plane', rbf, { ...data, kernel: 'polyharmonic', order: 8 }],
    ['an unknown kernel', rbf, { ...data, kernel: 'gausian' }],
    ...(['linear', 'cubic', 'thin-plate', 'quintic', 'polyharmonic', 'clamped-plate'] as const).map(
      (kernel) => [`${kernel} normalized`, rbf, { ...data, kernel, normalized: true, width: 9 }] as [string, typeof rbf, Options],
    ),
    ['findOutliers, twins', (o) => hb.findOutliers(o as unknown as RbfOptions), twins],
    ['findOutliers, a degree too low', (o) => hb.findOutliers(o as unknown as RbfOptions), { ...data, degree: 0 }],
    ['shepard, twins', (o) => hb.shepard(o as unknown as RbfOptions), twins],
    ['movingLeastSquares, twins', (o) => hb.movingLeastSquares(o as unknown as RbfOptions as never), twins],
    ['simplexLinear, twins', (o) => hb.simplexLinear(o as unknown as RbfOptions), twins],
    ['naturalNeighbor, twins', (o) => hb.naturalNeighbor(o as unknown as RbfOptions), twins],
    ['tensionSpline, twins', (o) => hb.tensionSpline(o as unknown as RbfOptions), twins],
  ];
  test.each(cases)('%s', (_, make, options) => {
    expect(follow(make, options)).toBeGreaterThan(0);
  });

  test(`pose spaces of any kernel, degree and width over random places (seed ${seed})`, () => {
    const next = random(seed + 1);
    let followed = 0;
    for (const kernel of POSE_KERNELS)
      for (const method of ['cardinal', 'normalized'] as const)
        for (const degree of [-1, 0, 1] as const)
          for (const width of ['auto', 1e-3, 1, 1e3] as const) {
            const line = next.number() > 0;
            const examples = Array.from({ length: 5 }, (_, k) => {
              const [a = 0, b = 0] = next.numbers(2);
              return { name: `${k}`, at: [a, line ? 2 * a : b], shape: [k] };
            });
            const make = (o: Options) => hb.poseSpace(o as unknown as PoseSpaceOptions);
            const options = { dimensions: ['a', 'b'], examples, kernel, method, width, degree };
            followed += follow(make, options);
          }
    expect(followed).toBeGreaterThan(20);
  });
});
