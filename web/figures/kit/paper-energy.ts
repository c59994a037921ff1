import type { BakeOptions, IrbfOptions } from '../../../wasm/ts/types.ts';

/** What the paper's figures show is its own energy, eqs. (8) to (10): small spheres count as much as large ones, and volume is free. */
export const ENERGY = { relativeWidth: 2, edgeExponent: -1, poissonRatio: 0 } as const satisfies IrbfOptions;

/** The bar of its figures. */
export const BAR = { centers: 100, resolution: 48, quality: 'fine', packing: 'medial' } as const satisfies BakeOptions;
