/**
 * Joins the primitives of a scene into the one mesh that the solver sees. The glTF-Transform reader and the three.js adapters both
 * end here, so that the same file gives the same positions, to the last bit, and the same hash.
 */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { chooseOrigin } from '../../wasm/ts/origin.ts';
import { placeUnheld } from '../../wasm/ts/placed-vertices.ts';
import type { Mesh, Vec3 } from '../../wasm/ts/types.ts';
import { determinant3, IDENTITY, isIdentity, type Matrix, type Sixteen } from './transform.ts';

/** More would need more memory than a page has; a file of a few bytes can ask for it by naming one mesh a million times. */
export const MAX_VERTICES = 1 << 24;
const MAX_TRIANGLES = 1 << 25;

/** Topology numbers as in glTF: points, triangles, strip, fan. */
export type PartMode = 0 | 4 | 5 | 6;

/** A run of a part's indices, or of its vertices where it has none. */
export interface DrawnRun {
  readonly start: number;
  readonly count: number;
}

/** A primitive in its own space. */
interface MeshPart {
  /** n×3. */
  readonly positions: Float32Array | Float64Array;
  /** Vertices in drawing order; without it, as stored. */
  readonly indices?: ArrayLike<number> | undefined;
  /** What of it is drawn; all, where nothing is said. Of triangles and points only. */
  readonly drawn?: readonly DrawnRun[] | undefined;
  readonly mode?: PartMode;
  /** From the part's space to the mesh's: 16 numbers, column-major. */
  readonly matrix?: Matrix;
}

/** Where a part's vertices and triangles lie in the joined mesh. */
export interface MeshRange {
  readonly start: number;
  readonly count: number;
  readonly firstTriangle: number;
  readonly triangleCount: number;
}

/**
 * Vertices in the order of the parts, transformed; triangles renumbered, and turned round where a matrix mirrors, so that they stay
 * counter-clockwise seen from outside. Left-over indices that make no whole triangle are ignored, as a renderer does.
 *
 * Parts that are all points give a cloud: a mesh without triangles. In a cloud a point that is not drawn lies where the first drawn one does.
 *
 * A mesh far from the origin gets an `origin` of its own, which its positions are relative to; they are subtracted in double precision.
 *
 * Throws 'mesh-no-triangles', 'mesh-too-large', or 'mesh-index-out-of-range' naming the triangle.
 */
export function concatenate(parts: readonly MeshPart[]): { mesh: Mesh; ranges: MeshRange[] } {
  const runs = parts.map(runsOf);
  let [vertices, triangles] = [0, 0];
  const ranges = parts.map(({ positions, mode = 4 }, i) => {
    const count = positions.length / 3;
    const triangleCount = (runs[i] as DrawnRun[]).reduce((sum, run) => sum + trianglesIn(run, mode), 0);
    const range = { start: vertices, count, firstTriangle: triangles, triangleCount };
    vertices += count;
    triangles += triangleCount;
    return range;
  });
  const isCloud = vertices > 0 && parts.every(({ mode }) => mode === 0);
  if (triangles === 0 && !isCloud) {
    throw new HandlebodyError('mesh-no-triangles', {
      message: 'The scene has no triangles.',
      remedy: 'Use a model with a surface or a point cloud: lines and empty scenes have no inside.',
    });
  }
  if (vertices > MAX_VERTICES || triangles > MAX_TRIANGLES) {
    throw new HandlebodyError('mesh-too-large', {
      message: `The scene has ${vertices} vertices and ${triangles} triangles; at most ${MAX_VERTICES} and ${MAX_TRIANGLES} can be read.`,
      remedy: 'Simplify the model, or use one of its parts.',
    });
  }
  const joined = { positions: new Float32Array(vertices * 3), triangles: new Uint32Array(triangles * 3) };
  parts.forEach((part, i) => {
    renumberInto(joined.triangles, part, { range: ranges[i] as MeshRange, runs: runs[i] as DrawnRun[] });
  });
  const used = isCloud ? undefined : usedVertices(joined.triangles, vertices);
  const box = boxOf(parts, used);
  const origin = chooseOrigin(box.low, box.high);
  parts.forEach((part, i) => {
    const { start } = ranges[i] as MeshRange;
    transformPart(part, origin, (vertex, x, y, z) => {
      const at = (start + vertex) * 3;
      joined.positions[at] = x;
      joined.positions[at + 1] = y;
      joined.positions[at + 2] = z;
    });
    if (isCloud) gatherUndrawn(joined.positions, part, { start, runs: runs[i] as DrawnRun[] });
  });
  if (!isCloud) placeUnheld(joined.positions, joined.triangles);
  return { mesh: { ...joined, ...(origin && { origin }) }, ranges };
}

/** What is drawn of a part, within what it has. */
function runsOf({ positions, indices, drawn }: MeshPart): DrawnRun[] {
  const end = indices?.length ?? positions.length / 3;
  return (drawn ?? [{ start: 0, count: end }]).map((run) => {
    const start = Math.min(Math.max(run.start, 0), end);
    return { start, count: Math.max(Math.min(run.start + run.count, end) - start, 0) };
  });
}

function trianglesIn({ count }: DrawnRun, mode: PartMode): number {
  return mode === 0 ? 0 : mode === 4 ? Math.floor(count / 3) : Math.max(count - 2, 0);
}

function renumberInto(
  out: Uint32Array,
  { indices, mode = 4, matrix = IDENTITY }: MeshPart,
  { range, runs }: { range: MeshRange; runs: readonly DrawnRun[] },
): void {
  const mirrored = determinant3(matrix) < 0;
  let triangle = range.firstTriangle;
  for (const run of runs) {
    for (let t = 0; t < trianglesIn(run, mode); t++, triangle++) {
      // glTF 2.0, 3.7.2.1: every second triangle of a strip is turned round.
      const [i, j, k] =
        mode === 4 ? [3 * t, 3 * t + 1, 3 * t + 2] : mode === 5 ? [t, t + 1 + (t % 2), t + 2 - (t % 2)] : [0, t + 1, t + 2];
      for (const [corner, at] of [i, mirrored ? k : j, mirrored ? j : k].entries()) {
        const vertex = indices ? (indices[run.start + at] as number) : run.start + at;
        if (!(vertex >= 0 && vertex < range.count)) throw outOfRange('triangle', triangle, { vertex, count: range.count });
        out[triangle * 3 + corner] = range.start + vertex;
      }
    }
  }
}

function outOfRange(
  what: 'triangle' | 'point',
  index: number,
  { vertex, count }: { vertex: number; count: number },
): HandlebodyError {
  return new HandlebodyError('mesh-index-out-of-range', {
    message: `${what === 'triangle' ? 'Triangle' : 'Point'} ${index} uses vertex ${vertex} of a part that has ${count} vertices.`,
    remedy: 'The file is damaged: export it again.',
    culprit: { kind: what, index },
  });
}

function usedVertices(triangles: Uint32Array, count: number): Uint8Array {
  const used = new Uint8Array(count);
  for (const vertex of triangles) used[vertex] = 1;
  return used;
}

/** Of the vertices that are used, before they are rounded. */
function boxOf(parts: readonly MeshPart[], used: Uint8Array | undefined): { low: Vec3; high: Vec3 } {
  const low: [number, number, number] = [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY];
  const high: [number, number, number] = [Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY];
  let start = 0;
  for (const part of parts) {
    transformPart(part, undefined, (vertex, x, y, z) => {
      if (used && used[start + vertex] === 0) return;
      low[0] = Math.min(low[0], x);
      low[1] = Math.min(low[1], y);
      low[2] = Math.min(low[2], z);
      high[0] = Math.max(high[0], x);
      high[1] = Math.max(high[1], y);
      high[2] = Math.max(high[2], z);
    });
    start += part.positions.length / 3;
  }
  return { low, high };
}

type Take = (vertex: number, x: number, y: number, z: number) => void;

function transformPart({ positions, matrix = IDENTITY }: MeshPart, origin: Vec3 | undefined, take: Take): void {
  const [ox, oy, oz] = origin ?? [0, 0, 0];
  const still = isIdentity(matrix);
  const [m0, m1, m2, , m4, m5, m6, , m8, m9, m10, , m12, m13, m14] = Array.from(matrix) as Sixteen;
  for (let vertex = 0, i = 0; i < positions.length; vertex++, i += 3) {
    const x = positions[i] as number;
    const y = positions[i + 1] as number;
    const z = positions[i + 2] as number;
    if (still) take(vertex, x - ox, y - oy, z - oz);
    else
      take(vertex, m0 * x + m4 * y + m8 * z + m12 - ox, m1 * x + m5 * y + m9 * z + m13 - oy, m2 * x + m6 * y + m10 * z + m14 - oz);
  }
}

/** A cloud has no triangles to say which of its vertices count. */
function gatherUndrawn(
  positions: Float32Array,
  { positions: own, indices }: MeshPart,
  { start, runs }: { start: number; runs: readonly DrawnRun[] },
): void {
  const count = own.length / 3;
  const drawn = new Uint8Array(count);
  let first = -1;
  for (const run of runs) {
    for (let at = run.start; at < run.start + run.count; at++) {
      const vertex = indices ? (indices[at] as number) : at;
      if (!(vertex >= 0 && vertex < count)) throw outOfRange('point', at, { vertex, count });
      drawn[vertex] = 1;
      if (first === -1) first = vertex;
    }
  }
  if (first === -1) return;
  for (let vertex = 0; vertex < count; vertex++)
    if (drawn[vertex] === 0) positions.copyWithin((start + vertex) * 3, (start + first) * 3, (start + first) * 3 + 3);
}
