/** Vertices that nothing uses may stand anywhere, and have numbers that are none. */

const isHeld = (x: number) => Number.isFinite(Math.fround(x));

/**
 * Puts vertices (n×3, changed in place) that are no corner and that floats cannot hold in the middle of those that are corners: so they set
 * no size, and nobody who reads the shape meets a number that is none.
 */
export function placeUnheld(positions: { readonly length: number; [i: number]: number }, corners: ArrayLike<number>): void {
  const unheld: number[] = [];
  for (let i = 0; i < positions.length; i++) if (!isHeld(positions[i] as number)) unheld.push(Math.floor(i / 3));
  if (unheld.length === 0) return;
  const used = new Uint8Array(positions.length / 3);
  const [low, high] = [new Float64Array(3).fill(Number.POSITIVE_INFINITY), new Float64Array(3).fill(Number.NEGATIVE_INFINITY)];
  for (let c = 0; c < corners.length; c++) {
    const vertex = corners[c] as number;
    used[vertex] = 1;
    for (let axis = 0; axis < 3; axis++) {
      const x = positions[3 * vertex + axis] as number;
      low[axis] = Math.min(low[axis] as number, x);
      high[axis] = Math.max(high[axis] as number, x);
    }
  }
  for (const vertex of unheld) {
    if (used[vertex] === 1) continue;
    for (let axis = 0; axis < 3; axis++) positions[3 * vertex + axis] = (low[axis] as number) / 2 + (high[axis] as number) / 2;
  }
}
