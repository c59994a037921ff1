/** Vertices that nothing uses may stand anywhere, and have numbers that are none. */

import { boxOf } from './box.ts';

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
  for (let c = 0; c < corners.length; c++) used[corners[c] as number] = 1;
  const { low, high } = boxOf(positions, corners);
  for (const vertex of unheld) {
    if (used[vertex] === 1) continue;
    for (const axis of [0, 1, 2] as const) positions[3 * vertex + axis] = low[axis] / 2 + high[axis] / 2;
  }
}
