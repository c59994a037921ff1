/** How far a morph target may go either way, least and most for each. */
export type Range = readonly [least: number, most: number];

/** From none to all of a morph target, and as far beyond as the examples themselves go. */
export function rangesOf(shapes: readonly ArrayLike<number>[]): Range[] {
  return Array.from({ length: shapes[0]?.length ?? 0 }, (_, i) => {
    const values = shapes.map((shape) => shape[i] ?? 0);
    return [Math.min(0, ...values), Math.max(1, ...values)];
  });
}

/**
 * Sets a mesh's morph influences, each within its range: between the examples interpolation may overshoot a little, and a lid that
 * is open beyond open or shut beyond shut is no face. Influences without a value become 0.
 */
export function setInfluences(influences: number[], shape: ArrayLike<number>, ranges: readonly Range[]): void {
  for (const i of influences.keys()) {
    const [least, most] = ranges[i] ?? [0, 1];
    influences[i] = Math.min(Math.max(shape[i] ?? 0, least), most);
  }
}
