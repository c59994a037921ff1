import { LAYOUT } from './abi.generated.ts';
import { HandlebodyError } from './errors.ts';
import type { Heap, Scratch } from './heap.ts';

/**
 * Triangles in the plane or in space, or tetrahedra: one of `triangles` (m×3) and `tetrahedra` (m×4), indices into `positions`. Vertices at
 * one place are one, and what has no area or volume is left out, unless `MeshOptions` say otherwise.
 */
export interface SimplexMesh {
  /** n × dimension, row-major. */
  readonly positions: ArrayLike<number>;
  /** 3 unless said otherwise. */
  readonly dimension?: 2 | 3;
  readonly triangles?: ArrayLike<number>;
  readonly tetrahedra?: ArrayLike<number>;
}

/** A mesh whose arrays fit together. @internal */
export interface CheckedMesh {
  readonly positions: ArrayLike<number>;
  readonly dimension: 2 | 3;
  readonly vertexCount: number;
  readonly simplices: ArrayLike<number>;
  readonly corners: 3 | 4;
  readonly simplexCount: number;
}

/** @internal */
export function checkSimplexMesh(mesh: SimplexMesh): CheckedMesh {
  const { positions, dimension = 3, triangles, tetrahedra } = mesh;
  const simplices = triangles ?? tetrahedra;
  if (!simplices || (triangles && tetrahedra)) {
    throw new HandlebodyError('invalid-shape', {
      message: `The mesh has ${simplices ? 'triangles and tetrahedra' : 'neither triangles nor tetrahedra'}.`,
      remedy: 'Give one of the two.',
    });
  }
  if (dimension !== 3 && !(dimension === 2 && triangles)) {
    throw new HandlebodyError('invalid-shape', {
      message: `A mesh of ${triangles ? 'triangles' : 'tetrahedra'} cannot have ${dimension} dimensions.`,
      remedy: 'Use 2 or 3 for triangles, 3 for tetrahedra.',
    });
  }
  if (positions.length === 0 || positions.length % dimension !== 0) {
    throw new HandlebodyError('invalid-shape', {
      message: `${positions.length} numbers are no list of positions in ${dimension} dimensions.`,
      remedy: 'Give dimension numbers a vertex, and say the dimension where it is not 3.',
    });
  }
  const corners = triangles ? 3 : 4;
  if (simplices.length % corners !== 0) {
    throw new HandlebodyError('invalid-shape', {
      message: `${simplices.length} indices are no list of ${triangles ? 'triangles' : 'tetrahedra'}.`,
      remedy: `Give ${corners} indices each.`,
    });
  }
  return {
    positions,
    dimension,
    vertexCount: positions.length / dimension,
    simplices,
    corners,
    simplexCount: simplices.length / corners,
  };
}

/** @internal Puts the mesh into scratch memory, as the solver takes it, and returns its address. */
export function putMesh(heap: Heap, scratch: Scratch, mesh: CheckedMesh): number {
  const layout = LAYOUT.hb_simplex_mesh;
  const positions = scratch.putF64(mesh.positions);
  const simplices = scratch.putU32(mesh.simplices);
  const at = scratch.reserve(layout.sizeof);
  const words = heap.u32(at, layout.sizeof / 4);
  words[layout.positions / 4] = positions;
  words[layout.simplices / 4] = simplices;
  words[layout.vertex_count / 4] = mesh.vertexCount;
  words[layout.dimension / 4] = mesh.dimension;
  words[layout.simplex_count / 4] = mesh.simplexCount;
  words[layout.corners / 4] = mesh.corners;
  return at;
}
