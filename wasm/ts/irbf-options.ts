import { LAYOUT } from './abi.generated.ts';
import { callback, finite, named, number, options, positive, type Read, type Reader, type Readers, whole } from './arguments.ts';
import type { Heap, Scratch } from './heap.ts';
import { HOST_KERNEL, KERNEL_NUMBERS, KERNELS, type KernelFunction } from './kernels.ts';
import { printWarning } from './rbf-report.ts';
import type { IrbfKernel, IrbfOptions } from './types.ts';

/** λ is eq. (10)'s: the paper's 0.001, which its appendix stacks unsquared, would be 1e-6 here. */
export const IRBF_DEFAULTS = {
  kernel: 'inverse-multiquadric',
  relativeWidth: 'auto',
  smoothness: 'auto',
  constraints: 'soft',
  anchorWeight: 100,
  edgeExponent: 2,
  poissonRatio: 0.4,
  support: 4,
  order: 2,
  precision: 'fixed',
  sphereFit: 'rigid',
  structure: 'octahedron',
} as const;

const RADIAL = Object.keys(KERNELS).filter((name) => name !== 'clamped-plate') as IrbfKernel[];

const READERS = {
  kernel: named(RADIAL, callback as Reader<KernelFunction>, 'a function of s'),
  relativeWidth: named(['auto'], positive, 'a positive number'),
  smoothness: named(['auto'], positive, 'a positive number'),
  constraints: named(['soft', 'hard']),
  anchorWeight: positive,
  edgeExponent: finite,
  poissonRatio: number('a number from 0 to 0.499', (x) => x >= 0 && x <= 0.499),
  support: positive,
  order: whole(2, 8),
  precision: named(['fixed', 'float']),
  sphereFit: named(['rigid', 'similarity']),
  structure: named(['octahedron', 'icosahedron']),
  onWarning: callback,
} satisfies Readers<IrbfOptions>;

type ResolvedIrbf = Read<typeof READERS>;

/** The options with their defaults; what the solver would not see is checked. */
export function resolve(given: IrbfOptions): ResolvedIrbf {
  return options(given, READERS, { ...IRBF_DEFAULTS, onWarning: printWarning });
}

/** Puts the struct into scratch memory and returns its address. */
export function writeOptions(heap: Heap, scratch: Scratch, how: ResolvedIrbf, hostKernel: number): number {
  const layout = LAYOUT.hb_irbf_options;
  const at = scratch.reserve(layout.sizeof);
  const doubles = heap.f64(at, layout.kernel / 8);
  doubles[layout.relative_width / 8] = how.relativeWidth === 'auto' ? 0 : how.relativeWidth;
  doubles[layout.smoothness / 8] = how.smoothness === 'auto' ? 0 : how.smoothness;
  doubles[layout.anchor_weight / 8] = how.anchorWeight;
  doubles[layout.edge_exponent / 8] = how.edgeExponent;
  doubles[layout.poisson_ratio / 8] = how.poissonRatio;
  doubles[layout.support / 8] = how.support;
  const words = heap.u32(at, layout.sizeof / 4);
  words[layout.kernel / 4] = typeof how.kernel === 'string' ? KERNEL_NUMBERS[how.kernel] : HOST_KERNEL;
  words[layout.host_kernel / 4] = hostKernel;
  words[layout.order / 4] = how.order;
  words[layout.constraints / 4] = how.constraints === 'hard' ? 1 : 0;
  words[layout.precision / 4] = how.precision === 'float' ? 1 : 0;
  words[layout.sphere_fit / 4] = how.sphereFit === 'similarity' ? 1 : 0;
  words[layout.structure / 4] = how.structure === 'icosahedron' ? 1 : 0;
  return at;
}
