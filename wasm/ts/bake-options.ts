import { callback, named, numbers, optional, type Readers, signal, whole } from './arguments.ts';
import type { BakeOptions, DistanceMethod } from './types.ts';

export const BAKE_DEFAULTS = {
  centers: 'auto',
  distance: 'fast-marching',
  resolution: 'auto',
  quality: 'normal',
  spheres: 'auto',
  packing: 'skeleton',
} as const;

/** By the solver's numbers. */
export const METHODS: readonly DistanceMethod[] = ['fast-marching', 'euclidean', 'heat', 'mean-value'];
export const PACKINGS = ['skeleton', 'tree', 'medial'] as const;
export const QUALITIES = ['draft', 'normal', 'fine'] as const;

const chosen = named(['auto'], whole(1, 0xffff_ffff), 'a whole number from 1 on');

/** @internal How a bake's options are read, here and by who hands them to a worker. */
export const BAKE_READERS = {
  centers: chosen,
  distance: named(METHODS),
  resolution: chosen,
  quality: named(QUALITIES),
  spheres: chosen,
  packing: named(PACKINGS),
  density: optional((value, name) => numbers(value, name, { kind: 'vertex' })),
  signal: optional(signal),
  onProgress: optional(callback),
  onWarning: optional(callback),
} satisfies Readers<BakeOptions>;
