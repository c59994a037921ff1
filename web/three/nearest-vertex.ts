/** The vertex nearest to a place. */
export function nearestVertex(positions: ArrayLike<number>, { x, y, z }: { x: number; y: number; z: number }): number {
  let [best, least] = [0, Number.POSITIVE_INFINITY];
  for (let v = 0; v < positions.length / 3; v++) {
    const [dx, dy, dz] = [
      (positions[3 * v] as number) - x,
      (positions[3 * v + 1] as number) - y,
      (positions[3 * v + 2] as number) - z,
    ];
    const d = dx * dx + dy * dy + dz * dz;
    if (d < least) [best, least] = [v, d];
  }
  return best;
}
