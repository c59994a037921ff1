/** The copies that three.js' InstancedMesh and BatchedMesh draw. */
import { type BatchedMesh, type BufferGeometry, type InstancedMesh, Matrix4, Mesh, type Object3D } from 'three';
import type { DrawnRun } from '../assets/drawn-corners.ts';
import type { Matrix } from '../assets/transform.ts';

/** One copy. */
export interface ObjectInstance {
  /** Its number in three.js' mesh. */
  readonly index: number;
  readonly visible: boolean;
  /** From the geometry's space to the mesh's. */
  readonly matrix: Matrix;
  /** Its vertices in the geometry, and its run of the index, or of the vertices where there is none; undefined for all of them. */
  readonly range: { readonly vertices: DrawnRun; readonly run: DrawnRun } | undefined;
  /** Weights of the morph targets, where they are its own. */
  readonly weights: readonly number[] | undefined;
}

export type Instanced = InstancedMesh | BatchedMesh;

export function isInstanced(mesh: Object3D): mesh is Instanced {
  return 'isInstancedMesh' in mesh || 'isBatchedMesh' in mesh;
}

/** Undefined where this version of three.js does not tell. */
export function instancesOf(mesh: Instanced): ObjectInstance[] | undefined {
  if (!('isBatchedMesh' in mesh)) return copiesOf(mesh as InstancedMesh);
  return 'getGeometryRangeAt' in mesh ? batchOf(mesh as BatchedMesh) : undefined;
}

function copiesOf(mesh: InstancedMesh): ObjectInstance[] {
  const own = mesh.morphTexture ? new Mesh() : undefined;
  // three.js gives an InstancedMesh no weights of its own to count.
  const [targets = []] = Object.values(mesh.geometry.morphAttributes);
  return Array.from({ length: Math.min(mesh.count, mesh.instanceMatrix.count) }, (_, index) => {
    const matrix = new Matrix4();
    mesh.getMatrixAt(index, matrix);
    if (own) {
      own.morphTargetInfluences = targets.map(() => 0);
      mesh.getMorphAt(index, own);
    }
    return { index, visible: true, matrix: matrix.toArray(), range: undefined, weights: own?.morphTargetInfluences };
  });
}

function batchOf(mesh: BatchedMesh): ObjectInstance[] {
  const found: ObjectInstance[] = [];
  const matrix = new Matrix4();
  // Numbers of instances that were deleted are free, and asking for one throws.
  for (let index = 0; index < mesh.maxInstanceCount && found.length < mesh.instanceCount; index++) {
    try {
      mesh.getMatrixAt(index, matrix);
    } catch {
      continue;
    }
    const range = mesh.getGeometryRangeAt(mesh.getGeometryIdAt(index));
    if (!range) continue;
    const { vertexStart, vertexCount, start, count } = range;
    found.push({
      index,
      visible: mesh.getVisibleAt(index),
      matrix: matrix.toArray(),
      range: { vertices: { start: vertexStart, count: vertexCount }, run: { start, count } },
      weights: undefined,
    });
  }
  return found;
}

/** Has none of them drawn; returns what has them drawn again. */
export function hideInstances(mesh: Instanced): () => void {
  if (!('isBatchedMesh' in mesh)) {
    const { count } = mesh;
    mesh.count = 0;
    return () => {
      mesh.count = count;
    };
  }
  const batch = mesh as BatchedMesh;
  const visible = batchOf(batch).filter((instance) => instance.visible);
  for (const { index } of visible) batch.setVisibleAt(index, false);
  return () => {
    for (const { index } of visible) batch.setVisibleAt(index, true);
  };
}

/** The run of a geometry's index that an instance draws, in numbers of its own vertices; undefined where it has no index. */
export function indicesOf(
  { index }: BufferGeometry,
  { vertices, run }: NonNullable<ObjectInstance['range']>,
): Uint32Array | undefined {
  return index ? Uint32Array.from({ length: run.count }, (_, i) => index.getX(run.start + i) - vertices.start) : undefined;
}
