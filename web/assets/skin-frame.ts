/** Where a skin is at rest: the one matrix that its vertices are read through, before skinning. */
import type { Matrix, Sixteen } from './transform.ts';

/** A skinned part, as both readers have it. */
export interface PartSkin {
  /** For each joint, from the stored vertices to the scene: its world matrix × its inverse bind matrix × the bind matrix. */
  readonly matrices: readonly Matrix[];
  /** The first joint that hangs below no other one. */
  readonly root: number;
  /** n×4: which joints move a vertex, and how much. */
  readonly joints: ArrayLike<number>;
  /** Where a row is of zeros, its first joint has the vertex. */
  readonly weights: ArrayLike<number>;
}

/** As a part of the diagonal: vertices that are moved less by any joint than that stand still. */
const SAME = 1e-5;

/**
 * The matrix of the first joint, where the skeleton carries every vertex as that one does: the viewer then shows the skin there. In a pose
 * that of the root joint, which leaves the rest shape as it is and puts it near its place. `drawn` is 1 for the vertices that count.
 */
export function skinFrame(
  positions: ArrayLike<number>,
  { matrices, root, joints, weights }: PartSkin,
  drawn: Uint8Array,
): { matrix: Matrix; posed: boolean } {
  const first = matrices[0] as Matrix;
  const place = new Float64Array(3);
  const other = new Float64Array(3);
  const [low, high] = [new Float64Array(3).fill(Number.POSITIVE_INFINITY), new Float64Array(3).fill(Number.NEGATIVE_INFINITY)];
  let farthest = 0;
  for (let vertex = 0; vertex < positions.length / 3; vertex++) {
    if (drawn[vertex] === 0) continue;
    carry(positions, vertex, first, place);
    for (let axis = 0; axis < 3; axis++) {
      const x = place[axis] as number;
      // A vertex that is not a number is beside the point here: baking says what is wrong with it.
      if (x < (low[axis] as number)) low[axis] = x;
      if (x > (high[axis] as number)) high[axis] = x;
    }
    let isBare = true;
    for (let k = 4 * vertex; k < 4 * vertex + 4; k++) if (weights[k] !== 0) isBare = false;
    for (let k = 4 * vertex; k < 4 * vertex + 4; k++) {
      const matrix = matrices[joints[k] as number];
      const isHeld = weights[k] !== 0 || (isBare && k === 4 * vertex);
      if (!isHeld || !matrix || matrix === first) continue;
      carry(positions, vertex, matrix, other);
      const apart = (axis: number) => (other[axis] as number) - (place[axis] as number);
      const distance = Math.hypot(apart(0), apart(1), apart(2));
      if (distance > farthest) farthest = distance;
    }
  }
  const diagonal = Math.hypot(...high.map((most, axis) => most - (low[axis] as number)));
  const posed = farthest > SAME * diagonal;
  return { matrix: posed ? (matrices[root] as Matrix) : first, posed };
}

function carry(positions: ArrayLike<number>, vertex: number, matrix: Matrix, out: Float64Array): void {
  const m = matrix as Sixteen;
  const x = positions[3 * vertex] as number;
  const y = positions[3 * vertex + 1] as number;
  const z = positions[3 * vertex + 2] as number;
  for (let axis = 0; axis < 3; axis++)
    out[axis] = (m[axis] as number) * x + (m[4 + axis] as number) * y + (m[8 + axis] as number) * z + (m[12 + axis] as number);
}
