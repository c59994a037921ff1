/** Where a mesh far from the origin is given about an origin of its own. */
import type { Vec3 } from './types.ts';

/** How many diagonals a shape may be away from the origin before floats about that origin lose too much of it: then 2⁻²⁴ · 1,000 ≈ 6e-5. */
const FAR = 1000;

/**
 * The origin that a shape's positions are given about, exact as floats; undefined where they may be about the coordinates' own. `low` and
 * `high` are the corners of the box of all vertices that the surface uses.
 *
 * A shape that is more than 1,000 of its diagonals away would keep a few bits of its own size in floats: doubles have them all, and about
 * the middle of the box floats do.
 */
export function chooseOrigin(low: Vec3, high: Vec3): Vec3 | undefined {
  const axes = [0, 1, 2] as const;
  const diagonal = Math.hypot(...axes.map((axis) => high[axis] - low[axis]));
  const distance = Math.hypot(...axes.map((axis) => Math.max(low[axis], -high[axis], 0)));
  // A single place has no size that could get lost.
  if (!(diagonal > 0 && distance > FAR * diagonal)) return undefined;
  const center = (axis: 0 | 1 | 2) => Math.fround(low[axis] / 2 + high[axis] / 2);
  return [center(0), center(1), center(2)];
}
