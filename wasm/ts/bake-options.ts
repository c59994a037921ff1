import { callback, named, numbers, optional, type Readers, signal, whole } from './arguments.ts';
import type { BakeOptions, DistanceMethod } from './types.ts';

export const BAKE_DEFAULTS = {
  centers: 200,
  distance: 'fast-marching',
  resolution: 96,
  spheres: 120,
  packing: 'skeleton',
} as const;

/** By the solver's numbers. */
export const METHODS: readonly DistanceMethod[] = ['fast-marching', 'euclidean', 'heat', 'mean-value'];
export const PACKINGS = ['skeleton', 'tree'] as const;

const positiveWhole = whole(1, 0xffff_ffff);

/** @internal How a bake's options are read, here and by who hands them to a worker. */
export const BAKE_READERS = {
  centers: positiveWhole,
  distance: named(METHODS),
  resolution: positiveWhole,
  spheres: positiveWhole,
  packing: named(PACKINGS),
  density: optional((value, name) => numbers(value, name, { kind: 'vertex' })),
  signal: optional(signal),
  onProgress: optional(callback),
  onWarning: optional(callback),
} satisfies Readers<BakeOptions>;
