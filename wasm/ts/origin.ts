/**
 * Where a mesh lies far from the origin, floats cannot hold its shape: at 4,000,000 they are half a unit apart. Such a mesh is given
 * about an origin of its own.
 */
import type { Vec3 } from './types.ts';

/** So many of its own diagonals away, a shape has lost about a ten-thousandth of its size to rounding. */
const FAR = 1000;

/**
 * The middle of a box, as floats, where the box is farther from the origin than 1,000 of its diagonals; undefined where it is nearer,
 * has no extent, or is not finite.
 */
export function chooseOrigin(low: Vec3, high: Vec3): Vec3 | undefined {
  const gap = low.map((least, axis) => Math.max(least, -(high[axis] as number), 0));
  const size = low.map((least, axis) => (high[axis] as number) - least);
  const diagonal = Math.hypot(...size);
  if (!(diagonal > 0 && Math.hypot(...gap) > FAR * diagonal)) return undefined;
  const middle = low.map((least, axis) => Math.fround(least + 0.5 * (size[axis] as number))) as [number, number, number];
  return middle.every(Number.isFinite) ? middle : undefined;
}
