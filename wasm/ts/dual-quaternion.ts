import { options } from './arguments.ts';
import type { Heap } from './heap.ts';
import { BlendedSkin, SKIN_DEFAULTS, SKIN_READERS, type SkinOptions } from './skin.ts';

/**
 * Dual quaternion blending (Kavan et al. 2008): every vertex moves by a rigid average of the handles' motions, so that nothing collapses
 * where they turn against each other. Of a transform only the closest rotation counts, and where it takes the handle's own region; scale
 * is left out. A vertex's weights matter by their proportions, and may not all be 0.
 *
 * ```ts
 * const skin = hb.dualQuaternion({ dimension: 2, positions: [0, 0, 1, 0, 2, 0], weights: [1, 0, 0.5, 0.5, 0, 1] });
 * skin.transforms.set([0, -1, 2, 1, 0, 0], 6); // turns handle 1 by 90° and shifts it by 2
 * skin.deform();
 * ```
 */
export class DualQuaternion extends BlendedSkin {
  /** @internal Use `Handlebody.dualQuaternion`. */
  constructor(heap: Heap, given: SkinOptions) {
    super(heap, options(given, SKIN_READERS, SKIN_DEFAULTS), (e, out, { positions, count, dimension, weights, handleCount }) =>
      e.hb_dual_quaternion_create(positions, count, dimension, weights, handleCount, out),
    );
  }
}
