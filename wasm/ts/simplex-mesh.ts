import { LAYOUT } from './abi.generated.ts';
import { checkNames, type Numbers, told } from './arguments.ts';
import { HandlebodyError } from './errors.ts';
import type { Heap, Scratch } from './heap.ts';
import { meshLike, readCorners, readPositions } from './mesh-arrays.ts';

/**
 * Triangles in the plane or in space, or tetrahedra: one of `triangles` (m×3) and `tetrahedra` (m×4), indices into `positions`. Vertices at
 * one place are one, and what has no area or volume is left out, unless `MeshOptions` say otherwise.
 */
export interface SimplexMesh {
  /** n × dimension, row-major; or n rows. */
  readonly positions: Numbers;
  /** 3 unless said otherwise. */
  readonly dimension?: 2 | 3;
  readonly triangles?: Numbers;
  readonly tetrahedra?: Numbers;
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
export function checkSimplexMesh(given: SimplexMesh, name: string): CheckedMesh {
  const mesh = meshLike(given, name);
  checkNames(mesh, NAMES, name);
  const { dimension = 3, triangles, tetrahedra } = mesh;
  const simplices = triangles ?? tetrahedra;
  if (simplices === undefined || (triangles !== undefined && tetrahedra !== undefined)) {
    throw new HandlebodyError('invalid-shape', {
      message: `The mesh has ${simplices === undefined ? 'neither triangles nor tetrahedra' : 'triangles and tetrahedra'}.`,
      remedy: 'Give one of the two.',
    });
  }
  if (dimension !== 3 && !(dimension === 2 && tetrahedra === undefined)) {
    throw new HandlebodyError('invalid-shape', {
      message: `The "dimension" of a mesh of ${tetrahedra === undefined ? 'triangles' : 'tetrahedra'} is ${told(dimension)}.`,
      remedy: 'Use 2 or 3 for triangles, 3 for tetrahedra.',
    });
  }
  const positions = readPositions(mesh, dimension);
  const vertexCount = positions.length / dimension;
  if (vertexCount === 0) {
    throw new HandlebodyError('invalid-shape', {
      message: "The mesh's positions are none.",
      remedy: 'Give dimension numbers a vertex, and say the dimension where it is not 3.',
    });
  }
  const corners = tetrahedra === undefined ? 3 : 4;
  const read = readCorners(simplices, corners === 3 ? 'triangles' : 'tetrahedra');
  return { positions, dimension, vertexCount, simplices: read, corners, simplexCount: read.length / corners };
}

const NAMES = { positions: 0, dimension: 0, triangles: 0, tetrahedra: 0 };

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
