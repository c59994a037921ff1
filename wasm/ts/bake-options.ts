import { callback, list, named, number, numbers, optional, type Reader, type Readers, row, signal, whole } from './arguments.ts';
import type { BakeOptions, DistanceMethod } from './types.ts';

export const BAKE_DEFAULTS = {
  centers: 'auto',
  distance: 'fast-marching',
  resolution: 'auto',
  quality: 'normal',
  spheres: 'auto',
  packing: 'skeleton',
  level: 'auto',
  overlap: 0,
  smallestRadius: 'auto',
  bones: 'none',
} as const;

/** By the solver's numbers. */
export const METHODS: readonly DistanceMethod[] = ['fast-marching', 'euclidean', 'heat', 'mean-value'];
export const PACKINGS = ['skeleton', 'tree', 'medial'] as const;
export const QUALITIES = ['draft', 'normal', 'fine'] as const;

const chosen = named(['auto'], whole(1, 0xffff_ffff), 'a whole number from 1 on');

const part = number('a part of the diagonal, such as 0.01', (x) => x > 0 && x <= 1);

const ends: Reader<ArrayLike<number>[]> = (value, name) =>
  list(value, name, 'pairs of ends, such as [[[0, 0, 0], [0, 1, 0]]]', (pair, which) => row(pair, which, 6));

/** @internal How a bake's options are read, here and by who hands them to a worker. */
export const BAKE_READERS = {
  centers: chosen,
  distance: named(METHODS),
  resolution: chosen,
  quality: named(QUALITIES),
  spheres: chosen,
  packing: named(PACKINGS),
  level: named(['auto'], whole(1, 10), 'a whole number from 1 to 10'),
  overlap: number('a number from -4 to 1', (x) => x >= -4 && x <= 1),
  smallestRadius: named(['auto'], part, 'a part of the diagonal'),
  bones: named(['none', 'straight'], ends, 'pairs of ends'),
  density: optional((value, name) => numbers(value, name, { kind: 'vertex' })),
  signal: optional(signal),
  onProgress: optional(callback),
  onWarning: optional(callback),
} satisfies Readers<BakeOptions>;
