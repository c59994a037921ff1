import { flag, options, type Readers } from './arguments.ts';
import type { Heap } from './heap.ts';
import { BlendedSkin, SKIN_DEFAULTS, SKIN_READERS, type SkinOptions } from './skin.ts';

export interface LinearBlendOptions extends SkinOptions {
  /** Multiplies positions and weights into one matrix beforehand: the same result, more memory. */
  readonly compiled?: boolean;
}

export const LINEAR_BLEND_DEFAULTS = { ...SKIN_DEFAULTS, compiled: false } as const;

const READERS = { ...SKIN_READERS, compiled: flag } satisfies Readers<LinearBlendOptions>;

/**
 * Linear blend skinning: uᵢ = Σⱼ wᵢⱼ Tⱼ [vᵢ; 1]. A motion that all handles share is the shape's, since a vertex's weights are made to
 * sum to 1; with `normalize: false` they may be any finite numbers. Shapes collapse where handles turn against each other.
 *
 * ```ts
 * const skin = hb.linearBlend({ dimension: 2, positions: [0, 0, 1, 0, 2, 0], weights: [1, 0, 0.5, 0.5, 0, 1] });
 * skin.transforms.set([0, -1, 2, 1, 0, 0], 6); // turns handle 1 by 90° and shifts it by 2
 * skin.deform();
 * ```
 */
export class LinearBlend extends BlendedSkin {
  /** @internal Use `Handlebody.linearBlend`. */
  constructor(heap: Heap, given: LinearBlendOptions) {
    const read = options(given, READERS, LINEAR_BLEND_DEFAULTS);
    const compiled = read.compiled ? 1 : 0;
    super(heap, read, (e, out, { positions, count, dimension, weights, handleCount }) =>
      e.hb_linear_blend_create(positions, count, dimension, weights, handleCount, compiled, out),
    );
  }
}
