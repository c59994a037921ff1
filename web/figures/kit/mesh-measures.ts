import { Box3, Vector3 } from 'three';

/** Of a box around points in space, from corner to corner. */
export function diagonalOf(positions: ArrayLike<number>): number {
  return new Box3().setFromArray(positions).getSize(new Vector3()).length();
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
