import { LAYOUT } from './abi.generated.ts';
import { HandlebodyError } from './errors.ts';
import type { Heap, Scratch } from './heap.ts';
import { checkShapes, type ScatteredData } from './interpolant.ts';
import { HOST_KERNEL, KERNEL_NUMBERS, KERNELS, type KernelFunction, type KernelName, type UserKernel } from './kernels.ts';
import type { RbfWarning } from './rbf-report.ts';

/** Options of everything that is made of radial basis functions. */
export interface RbfOptions extends ScatteredData {
  /** A name of {@link KERNELS}, or a function of s = r/width. */
  readonly kernel?: KernelName | KernelFunction | UserKernel;
  /**
   * In units of the points; the kernel is a function of r/width. One number; one per center; `'auto'`, from the points' spacing; or
   * `'leave-one-out'`, the one with the least leave-one-out error (some 25 fits).
   */
  readonly width?: number | ArrayLike<number> | 'auto' | 'leave-one-out';
  /**
   * Degree of the polynomial tail; −1 is none. `'auto'`: the lowest that the kernel needs. What the points do not determine of it, as a slope
   * across a line that all are on, is left out.
   */
  readonly degree?: -1 | 0 | 1 | 2 | 'auto';
  /** λ of R + λI (SciPy's `smoothing`), in units of the kernel: 0 interpolates. The polynomial part is not penalized. */
  readonly smoothing?: number;
  /** λ of min ‖Rw − d‖² + λ‖w‖² (2014 course, eq. (3)). */
  readonly weightDecay?: number;
  /**
   * Divides the kernels by their sum: weights stay small, and constants are reproduced without a tail. Where no kernel reaches, beyond the
   * supports of compact ones, the center that is nearest in terms of its width counts alone, as in the limit of wider kernels.
   */
  readonly normalized?: boolean;
  /** Fewer centers than points, k × dimension: a least-squares fit. Left out, each point is one. */
  readonly centers?: ArrayLike<number>;
  /** Which points a least-squares fit with `centers` trusts: all; `'least-absolute'`, all but a few; `'least-median'`, the better half. */
  readonly robust?: 'least-absolute' | 'least-median';
  /**
   * M of a Mahalanobis distance r² = xᵀMx, dimension × dimension, symmetric and positive definite. Left out, distances are Euclidean, but an
   * axis on which the points span less than a thousandth of the longest counts as spanning a thousandth, with a warning (the identity keeps plain
   * distances): so axes in units that have nothing in common are kept apart.
   */
  readonly metric?: ArrayLike<number>;
  /** Order of the kernels 'polyharmonic' and 'clamped-plate', more than half the dimension: 2 is biharmonic, 3 triharmonic. */
  readonly order?: number;
  /** Where the compact inverse multiquadric ends, in widths. */
  readonly support?: number;
  /** Called for each warning when the fit is made. By default they go to the console; `report().warnings` has them too. */
  readonly onWarning?: (warning: RbfWarning) => void;
}

export const RBF_DEFAULTS = {
  kernel: 'thin-plate',
  width: 'auto',
  degree: 'auto',
  smoothing: 0,
  weightDecay: 0,
  normalized: false,
  order: 2,
  support: 4,
} as const;

/** The options as the solver's numbers. */
interface ResolvedRbf {
  readonly name: KernelName | 'custom';
  readonly kernel: number;
  readonly hostKernel: number;
  readonly width: number;
  readonly widthChoice: number;
  readonly widths: ArrayLike<number> | undefined;
  readonly degree: number;
  readonly smoothing: number;
  readonly weightDecay: number;
  readonly normalized: boolean;
  readonly order: number;
  readonly support: number;
  readonly robust: number;
  readonly centers: ArrayLike<number> | undefined;
  readonly centerCount: number;
  readonly metric: ArrayLike<number> | undefined;
}

/** Reads the options and checks what the solver cannot see: names, lengths, and sizes before anything is copied. */
export function resolve(heap: Heap, options: RbfOptions): ResolvedRbf {
  const all = { ...RBF_DEFAULTS, ...options };
  const { kernel, width, order } = all;
  const { dimension } = options;
  const { count } = checkShapes(options);
  const name = typeof kernel === 'string' ? kernel : 'custom';
  if (name !== 'custom' && !Object.hasOwn(KERNELS, name))
    throw unknown('kernel', name, [...Object.keys(KERNELS), 'a function of s']);
  if (typeof width === 'string' && width !== 'auto' && width !== 'leave-one-out')
    throw unknown('width', width, ['a number', 'numbers', "'auto'", "'leave-one-out'"]);
  const robust = ['least-absolute', 'least-median'].indexOf(all.robust ?? '') + 1;
  if (all.robust !== undefined && robust === 0) throw unknown('robust method', all.robust, ['least-absolute', 'least-median']);
  const widths = typeof width === 'object' ? width : undefined;
  const centers = all.centers;
  const centerCount = centers ? centers.length / dimension : 0;
  if (!Number.isInteger(centerCount) || (centers && centerCount === 0))
    throw invalid(`The ${centers?.length} numbers of the centers are no whole number of rows of ${dimension}.`);
  if (widths && widths.length !== (centerCount || count))
    throw invalid(`There are ${widths.length} widths for ${centerCount || count} centers.`);
  if (all.metric && all.metric.length !== dimension * dimension)
    throw invalid(`The metric has ${all.metric.length} numbers; ${dimension} dimensions make ${dimension * dimension}.`);
  const degree = all.degree === 'auto' ? lowestDegree(name, dimension, order, all.normalized) : all.degree;
  heap.check((e) => e.hb_rbf_check_size(count, dimension, centerCount, degree));
  return {
    name,
    kernel: name === 'custom' ? HOST_KERNEL : KERNEL_NUMBERS[name],
    hostKernel: typeof kernel === 'string' ? 0 : heap.kernels.add(kernel),
    width: typeof width === 'number' ? width : 1,
    widthChoice: width === 'auto' ? 1 : width === 'leave-one-out' ? 2 : 0,
    widths,
    degree,
    smoothing: all.smoothing,
    weightDecay: all.weightDecay,
    normalized: all.normalized,
    order,
    support: all.support,
    robust,
    centers,
    centerCount: centerCount || (widths ? count : 0),
    metric: all.metric,
  };
}

/** The lowest degree of the tail that makes the interpolation matrix regular. */
function lowestDegree(name: KernelName | 'custom', dimension: number, order: number, normalized: boolean): number {
  if (normalized || name === 'custom') return -1;
  if (name === 'polyharmonic') return Math.floor((2 * order - dimension) / 2);
  return KERNELS[name].minimumDegree ?? -1;
}

/** Puts the struct into scratch memory and returns its address. */
export function writeOptions(heap: Heap, scratch: Scratch, options: ResolvedRbf): number {
  const layout = LAYOUT.hb_rbf_options;
  const widths = options.widths ? scratch.putF64(options.widths) : 0;
  const centers = options.centers ? scratch.putF64(options.centers) : 0;
  const metric = options.metric ? scratch.putF64(options.metric) : 0;
  const at = scratch.reserve(layout.sizeof);
  const doubles = heap.f64(at, layout.widths / 8);
  doubles[layout.width / 8] = options.width;
  doubles[layout.smoothing / 8] = options.smoothing;
  doubles[layout.weight_decay / 8] = options.weightDecay;
  doubles[layout.support / 8] = options.support;
  const words = heap.u32(at, layout.sizeof / 4);
  words[layout.widths / 4] = widths;
  words[layout.centers / 4] = centers;
  words[layout.metric / 4] = metric;
  words[layout.center_count / 4] = options.centerCount;
  words[layout.kernel / 4] = options.kernel;
  words[layout.host_kernel / 4] = options.hostKernel;
  words[layout.degree / 4] = options.degree;
  words[layout.order / 4] = options.order;
  words[layout.normalized / 4] = options.normalized ? 1 : 0;
  words[layout.width_choice / 4] = options.widthChoice;
  words[layout.robust / 4] = options.robust;
  return at;
}

function unknown(what: string, value: unknown, known: readonly string[]): HandlebodyError {
  return new HandlebodyError('invalid-option', {
    message: `There is no ${what} called "${String(value)}".`,
    remedy: `Use one of: ${known.join(', ')}.`,
    culprit: { kind: 'option', index: -1 },
  });
}

function invalid(message: string): HandlebodyError {
  return new HandlebodyError('invalid-shape', {
    message,
    remedy: 'Check the lengths of the arrays against the dimension and the counts.',
  });
}
