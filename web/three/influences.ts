/** How far a morph target may go either way, least and most. */
export type Range = readonly [least: number, most: number];

/** For each target from none to all of it, and as far beyond as the examples themselves go; none for one that no example moves. */
export function rangesOf(shapes: readonly ArrayLike<number>[]): (Range | undefined)[] {
  return Array.from({ length: shapes[0]?.length ?? 0 }, (_, i) => {
    const values = shapes.map((shape) => shape[i] ?? 0);
    if (values.every((value) => value === 0)) return undefined;
    return [Math.min(0, ...values), Math.max(1, ...values)];
  });
}

/**
 * Sets a mesh's morph influences, each within its range: between the examples interpolation may overshoot a little, and a lid that
 * is open beyond open or shut beyond shut is no face. `targets` says which influence each number of the shape is, where the order is
 * another one. Influences without a range keep what they have: they are somebody else's.
 */
export function setInfluences(
  influences: number[],
  shape: ArrayLike<number>,
  ranges: readonly (Range | undefined)[],
  targets?: readonly (number | undefined)[],
): void {
  for (let i = 0; i < ranges.length; i++) {
    const range = ranges[i];
    const target = targets ? targets[i] : i;
    if (!range || target === undefined || target >= influences.length) continue;
    influences[target] = Math.min(Math.max(shape[i] ?? 0, range[0]), range[1]);
  }
}
