/** Where floats are too far apart for a shape: what a reader warns of. */
import { chooseOrigin } from '../../wasm/ts/origin.ts';
import type { Mesh } from '../../wasm/ts/types.ts';
import type { DrawnRun, MeshRange } from './concatenate.ts';

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

/** Whether stored floats lie more than 1,000 of their diagonals from their origin. */
export function isCoarse(positions: ArrayLike<number>, drawn: Uint8Array): boolean {
  const box = new Box();
  for (let vertex = 0; vertex < drawn.length; vertex++) if (drawn[vertex] === 1) box.widen(positions, vertex);
  return chooseOrigin(box.low, box.high) !== undefined;
}

/** As many of its diagonals away from the others' middle a part is a few hundred floats long. */
const LOST = 1e5;

/** Whether a part of a joined mesh is so small, and so far from the rest, that the joined floats have lost its shape. */
export function isLostInScene({ positions, triangles }: Mesh, { firstTriangle, triangleCount }: MeshRange): boolean {
  const box = new Box();
  for (let i = 3 * firstTriangle; i < 3 * (firstTriangle + triangleCount); i++) box.widen(positions, triangles[i] as number);
  const { low, high } = box;
  const axes = [0, 1, 2] as const;
  const diagonal = Math.hypot(...axes.map((axis) => high[axis] - low[axis]));
  const farthest = Math.max(...axes.map((axis) => Math.max(low[axis], -high[axis])));
  return triangleCount > 0 && farthest > LOST * diagonal;
}

class Box {
  readonly low: [number, number, number] = [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY];
  readonly high: [number, number, number] = [Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY];

  widen(positions: ArrayLike<number>, vertex: number): void {
    for (const axis of [0, 1, 2] as const) {
      const x = positions[3 * vertex + axis] as number;
      if (x < this.low[axis]) this.low[axis] = x;
      if (x > this.high[axis]) this.high[axis] = x;
    }
  }
}
