/** What is drawn of a primitive, whatever its topology: the corners of its triangles, or the points of a cloud. */
import { HandlebodyError } from '../../wasm/ts/errors.ts';

/** Topology numbers as in glTF: points, triangles, strip, fan. */
export type PartMode = 0 | 4 | 5 | 6;

/** A run of a part's indices, or of its vertices where it has none. */
export interface DrawnRun {
  readonly start: number;
  readonly count: number;
}

interface Drawing {
  /** Vertices in drawing order; without it, as stored. */
  readonly indices: ArrayLike<number> | undefined;
  /** What of it is drawn; all, where nothing is said. Of triangles and points only. */
  readonly drawn?: readonly DrawnRun[] | undefined;
  readonly mode: PartMode;
}

/** How many triangles are drawn. */
export function countTriangles(drawing: Drawing, vertexCount: number): number {
  return runsOf(drawing, vertexCount).reduce((sum, { count }) => sum + trianglesIn(count, drawing.mode), 0);
}

function trianglesIn(count: number, mode: PartMode): number {
  return mode === 0 ? 0 : mode === 4 ? Math.floor(count / 3) : Math.max(count - 2, 0);
}

/** Three vertices for each triangle; undefined where that is what is stored. */
export function cornersOf({ indices, drawn, mode }: Drawing, vertexCount: number): ArrayLike<number> | undefined {
  if (mode === 4 && !drawn) return indices;
  const runs = runsOf({ indices, drawn, mode }, vertexCount);
  const corners = new Float64Array(3 * countTriangles({ indices, drawn, mode }, vertexCount));
  let end = 0;
  for (const { start, count } of runs) {
    for (let t = 0; t < trianglesIn(count, mode); t++) {
      // glTF 2.0, 3.7.2.1: every second triangle of a strip is turned round.
      const [i, j, k] =
        mode === 4 ? [3 * t, 3 * t + 1, 3 * t + 2] : mode === 5 ? [t, t + 1 + (t % 2), t + 2 - (t % 2)] : [0, t + 1, t + 2];
      for (const at of [i, j, k]) corners[end++] = indices ? (indices[start + at] as number) : start + at;
    }
  }
  return corners;
}

/**
 * A cloud has no triangles to say which of its points count: those that are not drawn are put where the first drawn one is. `positions` are
 * the part's own of the joined cloud.
 */
export function gatherUndrawn(positions: Float32Array, drawing: Drawing & { readonly name?: string }): void {
  const count = positions.length / 3;
  const drawn = new Uint8Array(count);
  let first = -1;
  for (const run of runsOf(drawing, count)) {
    for (let at = run.start; at < run.start + run.count; at++) {
      const vertex = drawing.indices ? (drawing.indices[at] as number) : at;
      if (!(vertex >= 0 && vertex < count)) {
        throw new HandlebodyError('mesh-index-out-of-range', {
          message: `Point ${at} uses vertex ${vertex} of the part “${drawing.name ?? ''}”, which has ${count} vertices.`,
          remedy: 'The file is damaged: export it again.',
          culprit: { kind: 'point', index: at },
        });
      }
      drawn[vertex] = 1;
      if (first === -1) first = vertex;
    }
  }
  if (first === -1) return;
  for (let vertex = 0; vertex < count; vertex++)
    if (drawn[vertex] === 0) positions.copyWithin(3 * vertex, 3 * first, 3 * first + 3);
}

/** What is drawn of a part, within what it has. */
function runsOf({ indices, drawn }: Drawing, vertexCount: number): DrawnRun[] {
  const end = indices?.length ?? vertexCount;
  return (drawn ?? [{ start: 0, count: end }]).map((run) => {
    const start = Math.min(Math.max(run.start, 0), end);
    return { start, count: Math.max(Math.min(run.start + run.count, end) - start, 0) };
  });
}
