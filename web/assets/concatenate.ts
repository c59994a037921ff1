/**
 * Joins the primitives of a scene into the one mesh that the solver sees. The glTF-Transform reader and the three.js adapters both
 * end here, so that the same file gives the same positions, to the last bit, and the same hash.
 */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { Mesh } from '../../wasm/ts/types.ts';
import { determinant3, IDENTITY, isIdentity, type Matrix, type Sixteen } from './transform.ts';

/** More would need more memory than a page has; a file of a few bytes can ask for it by naming one mesh a million times. */
export const MAX_VERTICES = 1 << 24;
const MAX_TRIANGLES = 1 << 25;

/** Topology numbers as in glTF: points, triangles, strip, fan. */
export type PartMode = 0 | 4 | 5 | 6;

/** A primitive in its own space. */
export interface MeshPart {
  /** n×3. */
  readonly positions: Float32Array;
  /** Vertices in drawing order; without it, as stored. */
  readonly indices?: ArrayLike<number> | undefined;
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
 * Parts that are all points give a cloud: a mesh without triangles.
 *
 * Throws 'mesh-no-triangles', 'mesh-too-large', or 'mesh-index-out-of-range' naming the triangle.
 */
export function concatenate(parts: readonly MeshPart[]): { mesh: Mesh; ranges: MeshRange[] } {
  let [vertices, triangles] = [0, 0];
  const ranges = parts.map(({ positions, indices, mode = 4 }) => {
    const count = positions.length / 3;
    const corners = indices?.length ?? count;
    const triangleCount = mode === 0 ? 0 : mode === 4 ? Math.floor(corners / 3) : Math.max(corners - 2, 0);
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
  const mesh = { positions: new Float32Array(vertices * 3), triangles: new Uint32Array(triangles * 3) };
  parts.forEach((part, i) => {
    const range = ranges[i] as MeshRange;
    transformInto(mesh.positions, range.start * 3, part.positions, part.matrix ?? IDENTITY);
    renumberInto(mesh.triangles, part, range);
  });
  return { mesh, ranges };
}

function transformInto(out: Float32Array, offset: number, points: Float32Array, m: Matrix): void {
  if (isIdentity(m)) {
    out.set(points, offset);
    return;
  }
  const [m0, m1, m2, , m4, m5, m6, , m8, m9, m10, , m12, m13, m14] = Array.from(m) as Sixteen;
  for (let i = 0; i < points.length; i += 3) {
    const x = points[i] as number;
    const y = points[i + 1] as number;
    const z = points[i + 2] as number;
    out[offset + i] = m0 * x + m4 * y + m8 * z + m12;
    out[offset + i + 1] = m1 * x + m5 * y + m9 * z + m13;
    out[offset + i + 2] = m2 * x + m6 * y + m10 * z + m14;
  }
}

function renumberInto(out: Uint32Array, { indices, mode = 4, matrix = IDENTITY }: MeshPart, range: MeshRange): void {
  const { start, count, firstTriangle, triangleCount } = range;
  const mirrored = determinant3(matrix) < 0;
  for (let t = 0; t < triangleCount; t++) {
    // glTF 2.0, 3.7.2.1: every second triangle of a strip is turned round.
    const [i, j, k] =
      mode === 4 ? [3 * t, 3 * t + 1, 3 * t + 2] : mode === 5 ? [t, t + 1 + (t % 2), t + 2 - (t % 2)] : [0, t + 1, t + 2];
    for (const [corner, at] of [i, mirrored ? k : j, mirrored ? j : k].entries()) {
      const vertex = indices ? (indices[at] as number) : at;
      if (!(vertex < count)) {
        throw new HandlebodyError('mesh-index-out-of-range', {
          message: `Triangle ${firstTriangle + t} uses vertex ${vertex} of a part that has ${count} vertices.`,
          remedy: 'The file is damaged: export it again.',
          culprit: { kind: 'triangle', index: firstTriangle + t },
        });
      }
      out[(firstTriangle + t) * 3 + corner] = start + vertex;
    }
  }
}
