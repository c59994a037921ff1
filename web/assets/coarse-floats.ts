/** Where floats are too far apart for a shape: what a reader warns of. */
import { chooseOrigin } from '../../wasm/ts/origin.ts';
import type { Mesh } from '../../wasm/ts/types.ts';
import type { MeshRange } from './concatenate.ts';
import type { DrawnRun } from './drawn-corners.ts';

interface Drawing {
  readonly indices: ArrayLike<number> | undefined;
  readonly drawn?: readonly DrawnRun[] | undefined;
}

/** 1 for the vertices that are drawn, of `count`. */
export function drawnVertices({ indices, drawn }: Drawing, count: number): Uint8Array {
  const out = new Uint8Array(count);
  const end = indices?.length ?? count;
  for (const run of drawn ?? [{ start: 0, count: end }])
    for (let at = Math.max(run.start, 0); at < Math.min(run.start + run.count, end); at++)
      out[indices ? (indices[at] as number) : at] = 1;
  return out;
}

/** The box of what is drawn. */
export function boxOf(positions: ArrayLike<number>, drawn: Uint8Array): Box {
  const box = new Box();
  for (let vertex = 0; vertex < drawn.length; vertex++) if (drawn[vertex] === 1) box.widen(positions, vertex);
  return box;
}

/** Whether stored floats lie more than 1,000 of their diagonals from their origin. */
export function isCoarse({ low, high }: Box): boolean {
  return chooseOrigin(low, high) !== undefined;
}

/** As many of its diagonals away from the others' middle a part is a few hundred floats long. */
const LOST = 1e5;

/** Whether a part of a joined mesh is so small, and so far from the rest, that the joined floats have lost its shape. */
export function isLostInScene({ positions, triangles }: Mesh, { firstTriangle, triangleCount }: MeshRange): boolean {
  const box = new Box();
  for (let i = 3 * firstTriangle; i < 3 * (firstTriangle + triangleCount); i++) box.widen(positions, triangles[i] as number);
  const farthest = Math.max(...([0, 1, 2] as const).map((axis) => Math.max(box.low[axis], -box.high[axis])));
  return triangleCount > 0 && farthest > LOST * box.diagonal;
}

class Box {
  readonly low: [number, number, number] = [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY];
  readonly high: [number, number, number] = [Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY];

  get diagonal(): number {
    return Math.hypot(...this.high.map((most, axis) => most - (this.low[axis] as number)));
  }

  widen(positions: ArrayLike<number>, vertex: number): void {
    for (const axis of [0, 1, 2] as const) {
      const x = positions[3 * vertex + axis] as number;
      if (x < this.low[axis]) this.low[axis] = x;
      if (x > this.high[axis]) this.high[axis] = x;
    }
  }
}
