/** The parts of an object's joined mesh, and what tells them apart. */
import type { Object3D, Points, SkinnedMesh, Mesh as ThreeMesh } from 'three';
import type { Mesh } from '../../wasm/ts/types.ts';
import { invertAffine, isIdentity, type Matrix, type Sixteen } from '../assets/transform.ts';
import { decode } from './decode.ts';
import type { ObjectInstance } from './instances.ts';

/** A three.js mesh, or one of its instances, and its vertices' place in the joined mesh. */
export interface ObjectPart {
  readonly mesh: ThreeMesh | Points;
  /** First vertex, and how many. */
  readonly start: number;
  readonly count: number;
  /** From the part's space to the object's: 16 numbers, column-major. */
  readonly matrix: Matrix;
  /** What the joined mesh is relative to, in the object's space, where it lies far away. */
  readonly origin?: Mesh['origin'];
  /** The weights of morph targets that are in the joined mesh, if any. */
  readonly weights?: readonly number[] | undefined;
  /** Of an InstancedMesh or a BatchedMesh: which copy, from the mesh's space to the object's, and whether the mesh is the object itself. */
  readonly instance?: (ObjectInstance & { readonly meshMatrix: Matrix; readonly isTop: boolean }) | undefined;
}

/** The joined mesh of an object, and where its parts are. */
export interface ObjectMesh {
  readonly mesh: Mesh;
  readonly parts: readonly ObjectPart[];
  /** n×3, when every part has normals: give them to `Irbf.setRestNormals`. */
  readonly normals: Float32Array | undefined;
}

/** Normals of a part's own, n×3; `meshFromObject` brings those of morphed shapes and of instances. */
type NormalsOf = (part: ObjectPart) => Float32Array;

const STORED: NormalsOf = ({ mesh }) => decode(mesh.geometry.getAttribute('normal'));

/** Those of all parts in the object's space; undefined where one has none. */
export function collectNormals(parts: readonly ObjectPart[], normalsOf = STORED): Float32Array | undefined {
  const hasNormals = ({ mesh: { geometry } }: ObjectPart) =>
    geometry.getAttribute('normal')?.count === geometry.getAttribute('position').count;
  if (!parts.every(hasNormals)) return undefined;
  const normals = new Float32Array(3 * parts.reduce((sum, { count }) => sum + count, 0));
  for (const part of parts) {
    const local = normalsOf(part);
    if (!isIdentity(part.matrix)) transformNormals(local, part.matrix);
    normals.set(local, part.start * 3);
  }
  return normals;
}

/** Normals go by the inverse transposed, which keeps them outward where the matrix mirrors. */
function transformNormals(normals: Float32Array, matrix: Matrix): void {
  const inverse = invertAffine(matrix);
  if (!inverse) return;
  const [i0, i1, i2, , i4, i5, i6, , i8, i9, i10] = inverse as Sixteen;
  for (let k = 0; k < normals.length; k += 3) {
    const [nx, ny, nz] = [normals[k] as number, normals[k + 1] as number, normals[k + 2] as number];
    const x = i0 * nx + i1 * ny + i2 * nz;
    const y = i4 * nx + i5 * ny + i6 * nz;
    const z = i8 * nx + i9 * ny + i10 * nz;
    const scale = 1 / (Math.hypot(x, y, z) || 1);
    normals[k] = x * scale;
    normals[k + 1] = y * scale;
    normals[k + 2] = z * scale;
  }
}

export function isMesh(node: Object3D): node is ThreeMesh {
  return (node as Partial<ThreeMesh>).isMesh === true;
}

export function isPoints(node: Object3D): node is Points {
  return (node as Partial<Points>).isPoints === true;
}

/** By a skeleton: without one nothing moves it. */
export function isSkinned(mesh: Object3D): mesh is SkinnedMesh {
  return (mesh as Partial<SkinnedMesh>).isSkinnedMesh === true && (mesh as Partial<SkinnedMesh>).skeleton !== undefined;
}
