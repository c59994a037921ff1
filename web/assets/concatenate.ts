/**
 * Joins the primitives of a scene into the one mesh that the solver sees. The glTF-Transform reader and the three.js adapters both
 * end here, so that the same file gives the same positions, to the last bit, and the same hash.
 */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { chooseOrigin } from '../../wasm/ts/origin.ts';
import type { Mesh, Vec3 } from '../../wasm/ts/types.ts';
import { determinant3, IDENTITY, isIdentity, type Matrix, type Sixteen } from './transform.ts';

/** More would need more memory than a page has; a file of a few bytes can ask for it by naming one mesh a million times. */
export const MAX_VERTICES = 1 << 24;
const MAX_TRIANGLES = 1 << 25;

/** A primitive in its own space. */
interface MeshPart {
  /** n×3. */
  readonly positions: Float32Array | Float64Array;
  /** Three vertices for each triangle; without it, as stored. A cloud has none. */
  readonly indices?: ArrayLike<number> | undefined;
  /** From the part's space to the mesh's: 16 numbers, column-major. */
  readonly matrix?: Matrix;
  /** For errors. */
  readonly name?: string;
}

interface ConcatenateOptions {
  readonly isCloud?: boolean;
  /** What the positions are to be relative to, whatever they are now. */
  readonly origin?: Vec3 | undefined;
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
 * counter-clockwise seen from outside. Left-over indices that make no whole triangle are ignored, as a renderer does. Of a cloud, a mesh
 * without triangles.
 *
 * A mesh far from the origin gets an `origin` of its own, which its positions are relative to, subtracted in double precision; or the one that it
 * had when it was read before.
 *
 * Throws 'mesh-no-triangles', 'mesh-too-large', or 'mesh-index-out-of-range' naming the triangle.
 */
export function concatenate(
  parts: readonly MeshPart[],
  { isCloud = false, origin: known }: ConcatenateOptions = {},
): { mesh: Mesh; ranges: MeshRange[] } {
  let [vertices, triangles] = [0, 0];
  const ranges = parts.map(({ positions, indices }) => {
    const count = positions.length / 3;
    const triangleCount = isCloud ? 0 : Math.floor((indices?.length ?? count) / 3);
    const range = { start: vertices, count, firstTriangle: triangles, triangleCount };
    vertices += count;
    triangles += triangleCount;
    return range;
  });
  if (isCloud ? vertices === 0 : triangles === 0) {
    throw new HandlebodyError('mesh-no-triangles', {
      message: 'The scene has no triangles.',
      remedy: 'Use a model with a surface or a point cloud: lines and empty scenes have no inside.',
    });
  }
  checkSize(vertices, triangles);
  const joined = { positions: new Float32Array(vertices * 3), triangles: new Uint32Array(triangles * 3) };
  const used = new Uint8Array(vertices).fill(isCloud ? 1 : 0);
  parts.forEach((part, i) => {
    renumberInto(joined.triangles, part, ranges[i] as MeshRange);
  });
  for (const vertex of joined.triangles) used[vertex] = 1;

  const each = (origin: Vec3, take: Take) =>
    parts.forEach((part, i) => {
      transformPart(part, { origin, start: (ranges[i] as MeshRange).start, take });
    });
  // Of what is used, before it is rounded.
  const low: [number, number, number] = [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY];
  const high: [number, number, number] = [Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY];
  each([0, 0, 0], (vertex, x, y, z) => {
    if (used[vertex] === 0) return;
    low[0] = Math.min(low[0], x);
    low[1] = Math.min(low[1], y);
    low[2] = Math.min(low[2], z);
    high[0] = Math.max(high[0], x);
    high[1] = Math.max(high[1], y);
    high[2] = Math.max(high[2], z);
  });
  const origin = known ?? chooseOrigin(low, high);
  each(origin ?? [0, 0, 0], (vertex, x, y, z) => {
    joined.positions[3 * vertex] = x;
    joined.positions[3 * vertex + 1] = y;
    joined.positions[3 * vertex + 2] = z;
  });
  return { mesh: { ...joined, ...(origin && { origin, reading: { origin } }) }, ranges };
}

/** Throws 'mesh-too-large'. */
export function checkSize(vertices: number, triangles: number): void {
  if (vertices <= MAX_VERTICES && triangles <= MAX_TRIANGLES) return;
  throw new HandlebodyError('mesh-too-large', {
    message: `The scene has ${vertices} vertices and ${triangles} triangles; at most ${MAX_VERTICES} and ${MAX_TRIANGLES} can be read.`,
    remedy: 'Simplify the model, or use one of its parts.',
  });
}

function renumberInto(out: Uint32Array, { indices, matrix = IDENTITY, name = '' }: MeshPart, range: MeshRange): void {
  const { start, count, firstTriangle, triangleCount } = range;
  const mirrored = determinant3(matrix) < 0;
  for (let k = 0; k < 3 * triangleCount; k++) {
    const corner = k % 3;
    const at = mirrored && corner > 0 ? k + (corner === 1 ? 1 : -1) : k;
    const vertex = indices ? (indices[at] as number) : at;
    if (!(vertex >= 0 && vertex < count)) {
      const triangle = firstTriangle + Math.floor(k / 3);
      throw new HandlebodyError('mesh-index-out-of-range', {
        message: `Triangle ${triangle} uses vertex ${vertex} of the part “${name}”, which has ${count} vertices.`,
        remedy: 'The file is damaged: export it again.',
        culprit: { kind: 'triangle', index: triangle },
      });
    }
    out[3 * firstTriangle + k] = start + vertex;
  }
}

type Take = (vertex: number, x: number, y: number, z: number) => void;

function transformPart(
  { positions, matrix = IDENTITY }: MeshPart,
  { origin: [ox, oy, oz], start, take }: { readonly origin: Vec3; readonly start: number; readonly take: Take },
): void {
  const still = isIdentity(matrix);
  const [m0, m1, m2, , m4, m5, m6, , m8, m9, m10, , m12, m13, m14] = Array.from(matrix) as Sixteen;
  for (let vertex = start, i = 0; i < positions.length; vertex++, i += 3) {
    const x = positions[i] as number;
    const y = positions[i + 1] as number;
    const z = positions[i + 2] as number;
    if (still) take(vertex, x - ox, y - oy, z - oz);
    else
      take(vertex, m0 * x + m4 * y + m8 * z + m12 - ox, m1 * x + m5 * y + m9 * z + m13 - oy, m2 * x + m6 * y + m10 * z + m14 - oz);
  }
}
