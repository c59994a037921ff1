/** What is known of a kernel φ(s), s = r/width. */
export interface KernelInfo {
  /** The kernel in mathematical notation. */
  readonly formula: string;
  /** Whether the width matters; where not, s is r. */
  readonly hasWidth: boolean;
  /** Whether it is zero beyond its width (of the compact inverse multiquadric: beyond `support` widths; of the clamped plate: on its ball). */
  readonly compact: boolean;
  /** Continuous derivatives, at the centers and elsewhere. */
  readonly smoothness: number;
  /**
   * For any distinct points the interpolation matrix is regular given a polynomial tail of this degree or more (−1: none is needed): the
   * kernel or its negative is conditionally positive definite. `undefined` where it depends on the order, or is not known.
   */
  readonly minimumDegree: number | undefined;
  /** Largest dimension in which that is proved; 0 where there is none. */
  readonly definiteToDimension: number;
}

const anywhere = Number.POSITIVE_INFINITY;
const smooth = Number.POSITIVE_INFINITY;

function info(
  formula: string,
  hasWidth: boolean,
  compact: boolean,
  smoothness: number,
  minimumDegree: number | undefined,
  definiteToDimension = anywhere,
): KernelInfo {
  return { formula, hasWidth, compact, smoothness, minimumDegree, definiteToDimension };
}

/**
 * Every kernel by name, in the order of the solver's numbers. ℓ of Wendland's kernels follows from the dimension, so that they are positive
 * definite there.
 */
export const KERNELS = {
  linear: info('r', false, false, 0, 0),
  cubic: info('r³', false, false, 2, 1),
  'thin-plate': info('r² ln r', false, false, 1, 1),
  gaussian: info('exp(−s²)', true, false, smooth, -1),
  multiquadric: info('√(1 + s²)', true, false, smooth, 0),
  'inverse-multiquadric': info('1/√(1 + s²)', true, false, smooth, -1),
  'inverse-quadratic': info('1/(1 + s²)', true, false, smooth, -1),
  quintic: info('r⁵', false, false, 4, 2),
  polyharmonic: info('r^e, or r^e ln r for even e; e = 2·order − dimension', false, false, 0, undefined),
  'wendland-c0': info('(1 − s)^ℓ', true, true, 0, -1),
  'wendland-c2': info('(1 − s)^(ℓ+1) ((ℓ+1)s + 1)', true, true, 2, -1),
  'wendland-c4': info('(1 − s)^(ℓ+2) ((ℓ²+4ℓ+3)s² + (3ℓ+6)s + 3)/3', true, true, 4, -1),
  buhmann: info('12s⁴ ln s − 21s⁴ + 32s³ − 12s² + 1', true, true, 2, -1, 3),
  'compact-inverse-multiquadric': info('1/√(1 + s²) − 1/√(1 + support²)', true, true, 0, undefined, 0),
  'clamped-plate': info('Boggio’s Green’s function of Δ^order on a ball of radius width', true, true, 0, -1),
} as const satisfies Record<string, KernelInfo>;

export type KernelName = keyof typeof KERNELS;

/** The solver's number of a kernel. */
export const KERNEL_NUMBERS = Object.fromEntries(Object.keys(KERNELS).map((name, number) => [name, number])) as Readonly<
  Record<KernelName, number>
>;
/** The number that stands for a function of the caller's. */
export const HOST_KERNEL = 15;

/** A kernel of your own: φ(s), s = r/width ≥ 0. */
export type KernelFunction = (s: number) => number;

/** A kernel of your own, and what only you know about it. */
export interface UserKernel {
  readonly value: KernelFunction;
  /** φ′(s), for gradients; central differences of `value` where it is left out. */
  readonly derivative?: KernelFunction;
}
