/** three.js object trees to the solver's typed arrays. */
import type { BufferAttribute, InterleavedBufferAttribute, Object3D, Points, SkinnedMesh, Mesh as ThreeMesh } from 'three';
import type { Mesh } from '../../wasm/ts/types.ts';
import { concatenate, type MeshPart } from '../assets/concatenate.ts';
import { IDENTITY, invertAffine, isIdentity, type Matrix, multiplyMatrices, type Sixteen } from '../assets/transform.ts';

/** A three.js mesh and its vertices' place in the joined mesh. */
export interface ObjectPart {
  readonly mesh: ThreeMesh | Points;
  /** First vertex, and how many. */
  readonly start: number;
  readonly count: number;
  /** From the part's space to the object's: 16 numbers, column-major. */
  readonly matrix: Matrix;
}

/** The joined mesh of an object, and where its parts are. */
export interface ObjectMesh {
  readonly mesh: Mesh;
  readonly parts: readonly ObjectPart[];
  /** n×3, when every part has normals: give them to `Irbf.setRestNormals`. */
  readonly normals: Float32Array | undefined;
}

/**
 * The triangles below an object as one mesh, in depth-first order; for the scene that GLTFLoader gives this is the scene order of the
 * file. Positions are in the space of `object`, whose own transform does not count: a model may be moved after it was baked. Vertices
 * are copied as stored, quantized ones decoded; morph targets are at rest; lines and sprites are skipped, and so are points, unless there
 * is nothing else: then it is a cloud, a mesh without triangles.
 *
 * A skinned mesh is taken in its bind space, before skinning: its own transform does not move it.
 *
 * Throws 'mesh-no-triangles', 'mesh-too-large' or 'mesh-index-out-of-range'.
 *
 * ```ts
 * const { mesh, parts } = meshFromObject(gltf.scene);
 * const body = await hb.bake(mesh);
 * ```
 */
export function meshFromObject(object: Object3D): ObjectMesh {
  const found: { mesh: ThreeMesh | Points; matrix: Matrix }[] = [];
  const visit = (node: Object3D, parent: Matrix, isRoot: boolean) => {
    if (node.matrixAutoUpdate) node.updateMatrix();
    const matrix = isRoot ? IDENTITY : multiplyMatrices(parent, node.matrix.elements);
    if ((isMesh(node) || isPoints(node)) && node.geometry.getAttribute('position')) {
      found.push({ mesh: node, matrix: isSkinned(node) ? [...node.bindMatrix.elements] : matrix });
    }
    for (const child of node.children) visit(child, matrix, false);
  };
  visit(object, IDENTITY, true);

  const surface = found.filter(({ mesh }) => !isPoints(mesh));
  const taken = surface.length > 0 ? surface : found;
  const { mesh, ranges } = concatenate(taken.map(({ mesh, matrix }) => partOf(mesh, matrix)));
  const parts = taken.map((part, i) => ({ ...part, start: ranges[i]?.start ?? 0, count: ranges[i]?.count ?? 0 }));
  return { mesh, parts, normals: collectNormals(parts, mesh.positions.length) };
}

function partOf(mesh: ThreeMesh | Points, matrix: Matrix): MeshPart {
  const positions = decode(mesh.geometry.getAttribute('position'));
  return { positions, indices: mesh.geometry.index?.array, mode: isPoints(mesh) ? 0 : 4, matrix };
}

/** Three numbers a vertex, whatever the attribute's layout. */
export function decode(attribute: BufferAttribute | InterleavedBufferAttribute): Float32Array {
  const out = new Float32Array(attribute.count * 3);
  for (let i = 0; i < attribute.count; i++) {
    out[3 * i] = attribute.getX(i);
    out[3 * i + 1] = attribute.getY(i);
    out[3 * i + 2] = attribute.getZ(i);
  }
  return out;
}

function collectNormals(parts: readonly ObjectPart[], length: number): Float32Array | undefined {
  if (!parts.every(({ mesh, count }) => mesh.geometry.getAttribute('normal')?.count === count)) return undefined;
  const normals = new Float32Array(length);
  for (const { mesh, start, matrix } of parts) {
    const local = decode(mesh.geometry.getAttribute('normal'));
    if (!isIdentity(matrix)) transformNormals(local, matrix);
    normals.set(local, start * 3);
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

function isMesh(node: Object3D): node is ThreeMesh {
  return (node as Partial<ThreeMesh>).isMesh === true;
}

export function isPoints(node: Object3D): node is Points {
  return (node as Partial<Points>).isPoints === true;
}

export function isSkinned(mesh: Object3D): mesh is SkinnedMesh {
  return (mesh as Partial<SkinnedMesh>).isSkinnedMesh === true;
}
