/** Of a box around points in space, from corner to corner. */
export function diagonalOf(positions: ArrayLike<number>): number {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; i++) {
    low[i % 3] = Math.min(low[i % 3] as number, positions[i] as number);
    high[i % 3] = Math.max(high[i % 3] as number, positions[i] as number);
  }
  return Math.hypot(...high.map((x, axis) => x - (low[axis] as number)));
}

/** What a closed surface encloses. */
export function volumeOf(p: ArrayLike<number>, triangles: ArrayLike<number>): number {
  let sum = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * (triangles[t] as number), 3 * (triangles[t + 1] as number), 3 * (triangles[t + 2] as number)];
    const n = (i: number) => p[i] as number;
    sum +=
      n(a) * (n(b + 1) * n(c + 2) - n(b + 2) * n(c + 1)) +
      n(a + 1) * (n(b + 2) * n(c) - n(b) * n(c + 2)) +
      n(a + 2) * (n(b) * n(c + 1) - n(b + 1) * n(c));
  }
  return sum / 6;
}
