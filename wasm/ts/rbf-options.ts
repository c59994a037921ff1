import { LAYOUT } from './abi.generated.ts';
import {
  callback,
  flag,
  type Numbers,
  named,
  notNegative,
  numbers,
  object,
  optional,
  positive,
  type Read,
  type Reader,
  type Readers,
  whole,
} from './arguments.ts';
import { HandlebodyError } from './errors.ts';
import type { Heap, Scratch } from './heap.ts';
import { checkShapes, SCATTERED, type ScatteredData } from './interpolant.ts';
import { HOST_KERNEL, KERNEL_NUMBERS, KERNELS, type KernelFunction, type KernelName, type UserKernel } from './kernels.ts';

/** Options of everything that is made of radial basis functions. */
export interface RbfOptions extends ScatteredData {
  /** A name of {@link KERNELS}, or a function of s = r/width. */
  readonly kernel?: KernelName | KernelFunction | UserKernel;
  /**
   * In units of the points; the kernel is a function of r/width. One number; one per center; `'auto'`, from the points' spacing; or
   * `'leave-one-out'`, the one with the least leave-one-out error (some 25 fits).
   */
  readonly width?: number | Numbers | 'auto' | 'leave-one-out';
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
  /** Fewer centers than points, k × dimension or k rows: a least-squares fit. Left out, each point is one. */
  readonly centers?: Numbers;
  /** Which points a least-squares fit with `centers` trusts: all; `'least-absolute'`, all but a few; `'least-median'`, the better half. */
  readonly robust?: 'least-absolute' | 'least-median';
  /**
   * M of a Mahalanobis distance r² = xᵀMx, dimension × dimension, symmetric and positive definite. Left out, distances are Euclidean, but an
   * axis on which the points span less than a thousandth of the longest counts as spanning a thousandth, with a warning (the identity keeps plain
   * distances): so axes in units that have nothing in common are kept apart.
   */
  readonly metric?: Numbers;
  /** Order of the kernels 'polyharmonic' and 'clamped-plate', more than half the dimension: 2 is biharmonic, 3 triharmonic. */
  readonly order?: number;
  /** Where the compact inverse multiquadric ends, in widths. */
  readonly support?: number;
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

/** A kernel that is no name. */
function readKernel(value: unknown, name: string): KernelFunction | UserKernel {
  if (typeof value === 'function') return value as KernelFunction;
  const given = object(value, name, "Give a kernel's name, a function of s, or { value, derivative }.");
  optional(callback)(given.derivative, `${name}.derivative`);
  callback(given.value, `${name}.value`);
  return value as UserKernel;
}

const readWidth: Reader<number | ArrayLike<number>> = (value, name) =>
  typeof value === 'number' ? positive(value, name) : numbers(value, name);

/** @internal How the options of everything that is made of radial basis functions are read. */
export const RBF_READERS = {
  ...SCATTERED,
  kernel: named(Object.keys(KERNELS) as KernelName[], readKernel, 'a function of s'),
  width: named(['auto', 'leave-one-out'], readWidth, 'a positive number, or one for each center'),
  degree: named(['auto'], whole(-1, 2), 'a whole number from −1 to 2'),
  smoothing: notNegative,
  weightDecay: notNegative,
  normalized: flag,
  centers: optional((value, name, read) =>
    numbers(value, name, { code: 'point-not-finite', kind: 'center', width: read?.dimension as number }),
  ),
  robust: optional(named(['least-absolute', 'least-median'])),
  metric: optional(numbers),
  order: whole(1, 64),
  support: positive,
} satisfies Readers<RbfOptions>;

/** The options as they were read. @internal */
export type ReadRbf = Read<typeof RBF_READERS>;

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

/** Checks what the solver cannot see: lengths, and sizes before anything is copied. */
export function resolve(heap: Heap, all: ReadRbf): ResolvedRbf {
  const { kernel, width, order, centers, metric, dimension } = all;
  const { count } = checkShapes(all);
  const name = typeof kernel === 'string' ? kernel : 'custom';
  const robust = ['least-absolute', 'least-median'].indexOf(all.robust ?? '') + 1;
  const widths = typeof width === 'object' ? width : undefined;
  const centerCount = centers ? centers.length / dimension : 0;
  if (!Number.isInteger(centerCount) || (centers && centerCount === 0))
    throw invalid(`The ${centers?.length} numbers of the centers are no whole number of rows of ${dimension}.`);
  if (widths && widths.length !== (centerCount || count))
    throw invalid(`There are ${widths.length} numbers in "width" for ${centerCount || count} centers.`);
  if (metric && metric.length !== dimension * dimension)
    throw invalid(`The metric has ${metric.length} numbers; ${dimension} dimensions make ${dimension * dimension}.`);
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
    metric,
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

function invalid(message: string): HandlebodyError {
  return new HandlebodyError('invalid-shape', {
    message,
    remedy: 'Check the lengths of the arrays against the dimension and the counts.',
  });
}
