import { LAYOUT } from './abi.generated.ts';
import { HandlebodyError } from './errors.ts';
import type { Heap, Scratch } from './heap.ts';
import { HOST_KERNEL, KERNEL_NUMBERS, KERNELS } from './kernels.ts';
import { printWarning } from './rbf-report.ts';
import type { IrbfOptions } from './types.ts';

/** λ is eq. (10)'s: the paper's 0.001, which its appendix stacks unsquared, would be 1e-6 here. */
export const IRBF_DEFAULTS = {
  kernel: 'inverse-multiquadric',
  relativeWidth: 2,
  smoothness: 'auto',
  constraints: 'soft',
  anchorWeight: 100,
  edgeExponent: -1,
  support: 4,
  order: 2,
  precision: 'fixed',
} as const;

type ResolvedIrbf = Required<IrbfOptions>;

/** The options with their defaults; names that the solver would not see are checked. */
export function resolve(given: IrbfOptions): ResolvedIrbf {
  const options: ResolvedIrbf = { ...IRBF_DEFAULTS, onWarning: printWarning, ...given };
  const { kernel, constraints, precision, smoothness, order } = options;
  const radial = Object.keys(KERNELS).filter((name) => name !== 'clamped-plate');
  if (typeof kernel !== 'function' && !radial.includes(kernel)) throw unknown('kernel', kernel, [...radial, 'a function of s']);
  if (constraints !== 'soft' && constraints !== 'hard') throw unknown('kind of constraints', constraints, ['soft', 'hard']);
  if (precision !== 'fixed' && precision !== 'float') throw unknown('precision', precision, ['fixed', 'float']);
  if (typeof smoothness === 'string' ? smoothness !== 'auto' : !(smoothness > 0))
    throw unknown('smoothness', smoothness, ["'auto'", 'a positive number']);
  if (!Number.isInteger(order) || order < 2 || order > 8) throw unknown('order', order, ['a whole number from 2 to 8']);
  return options;
}

/** Puts the struct into scratch memory and returns its address. */
export function writeOptions(heap: Heap, scratch: Scratch, options: ResolvedIrbf, hostKernel: number): number {
  const layout = LAYOUT.hb_irbf_options;
  const at = scratch.reserve(layout.sizeof);
  const doubles = heap.f64(at, layout.kernel / 8);
  doubles[layout.relative_width / 8] = options.relativeWidth;
  doubles[layout.smoothness / 8] = options.smoothness === 'auto' ? 0 : options.smoothness;
  doubles[layout.anchor_weight / 8] = options.anchorWeight;
  doubles[layout.edge_exponent / 8] = options.edgeExponent;
  doubles[layout.support / 8] = options.support;
  const words = heap.u32(at, layout.sizeof / 4);
  words[layout.kernel / 4] = typeof options.kernel === 'string' ? KERNEL_NUMBERS[options.kernel] : HOST_KERNEL;
  words[layout.host_kernel / 4] = hostKernel;
  words[layout.order / 4] = options.order;
  words[layout.constraints / 4] = options.constraints === 'hard' ? 1 : 0;
  words[layout.precision / 4] = options.precision === 'float' ? 1 : 0;
  return at;
}

function unknown(what: string, value: unknown, known: readonly string[]): HandlebodyError {
  return new HandlebodyError('invalid-option', {
    message: `IRBF has no ${what} "${String(value)}".`,
    remedy: `Use ${known.join(', ')}.`,
    culprit: { kind: 'option', index: -1 },
  });
}
