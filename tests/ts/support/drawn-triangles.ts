/** What three.js draws of an object, by its own reckoning of morph targets and bones: the independent reading that ours is held against. */
import {
  type BatchedMesh,
  type BufferGeometry,
  type InstancedMesh,
  type LOD,
  Matrix4,
  type Mesh,
  type Object3D,
  Vector3,
} from 'three';
import { expect } from 'vitest';

/** Nine numbers for each triangle that is drawn, in world space, in the order of the tree. */
export function drawnTriangles(object: Object3D): number[][] {
  object.updateMatrixWorld(true);
  const triangles: number[][] = [];
  const visit = (node: Object3D) => {
    if (!node.visible) return;
    if ('isMesh' in node) triangles.push(...trianglesOf(node as Mesh));
    const others = 'isLOD' in node ? (node as LOD).levels.slice(1).map((level) => level.object) : [];
    for (const child of node.children) if (!others.includes(child)) visit(child);
  };
  visit(object);
  return triangles;
}

/** Those of one mesh, where the matrices of the world have it. */
export function trianglesOf(mesh: Mesh): number[][] {
  const { geometry, material, matrixWorld } = mesh;
  if ('isBatchedMesh' in mesh) return batch(mesh as unknown as BatchedMesh);
  const runs = Array.isArray(material)
    ? geometry.groups.filter(({ materialIndex }) => material[materialIndex ?? 0]?.visible)
    : material.visible
      ? [{ start: 0, count: Number.POSITIVE_INFINITY }]
      : [];
  const { drawRange } = geometry;
  const end = geometry.index?.count ?? geometry.getAttribute('position').count;
  const triangles: number[][] = [];
  const copies = 'isInstancedMesh' in mesh ? (mesh as unknown as InstancedMesh).count : 1;
  for (let copy = 0; copy < copies; copy++) {
    const frame = matrixWorld.clone();
    const own = mesh.morphTargetInfluences;
    if ('isInstancedMesh' in mesh) {
      const instanced = mesh as unknown as InstancedMesh;
      const matrix = new Matrix4();
      instanced.getMatrixAt(copy, matrix);
      frame.multiply(matrix);
      if (instanced.morphTexture) {
        mesh.morphTargetInfluences = (geometry.morphAttributes.position ?? []).map(() => 0);
        instanced.getMorphAt(copy, mesh);
      }
    }
    // What is drawn in two materials is one triangle.
    const drawn = new Set<number>();
    for (const { start, count } of runs) {
      const last = Math.min(start + count, drawRange.start + drawRange.count, end);
      for (let at = Math.max(start, drawRange.start); at + 3 <= last; at += 3) drawn.add(at);
    }
    for (const at of [...drawn].sort((a, b) => a - b))
      triangles.push([0, 1, 2].flatMap((k) => cornerOf(mesh, geometry.index ? geometry.index.getX(at + k) : at + k, frame)));
    mesh.morphTargetInfluences = own as number[];
  }
  return triangles;
}

function cornerOf(mesh: Mesh, vertex: number, frame: Matrix4): number[] {
  // three.js' own: morph targets, then bones.
  return mesh.getVertexPosition(vertex, new Vector3()).applyMatrix4(frame).toArray();
}

function batch(mesh: BatchedMesh): number[][] {
  const triangles: number[][] = [];
  const geometry: BufferGeometry = mesh.geometry;
  for (let id = 0; id < mesh.maxInstanceCount; id++) {
    const matrix = new Matrix4();
    try {
      if (!mesh.getVisibleAt(id)) continue;
      mesh.getMatrixAt(id, matrix);
    } catch {
      continue;
    }
    const frame = mesh.matrixWorld.clone().multiply(matrix);
    const range = mesh.getGeometryRangeAt(mesh.getGeometryIdAt(id));
    for (let at = range?.start ?? 0; at < (range?.start ?? 0) + (range?.count ?? 0); at += 3)
      triangles.push(
        [0, 1, 2].flatMap((k) =>
          new Vector3()
            .fromBufferAttribute(geometry.getAttribute('position'), geometry.index ? geometry.index.getX(at + k) : at + k)
            .applyMatrix4(frame)
            .toArray(),
        ),
      );
  }
  return triangles;
}

/** Triangles of a joined mesh at these positions, which may be relative to an origin. */
export const joined = (triangles: ArrayLike<number>, positions: ArrayLike<number>, origin: readonly number[] = [0, 0, 0]) =>
  Array.from({ length: triangles.length / 3 }, (_, t) =>
    [0, 1, 2].flatMap((k) =>
      [0, 1, 2].map((axis) => (positions[3 * (triangles[3 * t + k] as number) + axis] as number) + (origin[axis] as number)),
    ),
  );

const ORDERS = [
  [0, 1, 2],
  [1, 2, 0],
  [2, 0, 1],
  [0, 2, 1],
  [2, 1, 0],
  [1, 0, 2],
];

/**
 * The same triangles in the same order to a part of the diagonal, each begun and turned as it may be: readers turn those of mirrored meshes
 * round. Floats of two reckonings differ a little, and three.js', which stays in the world, a little more.
 */
export function expectSame(got: readonly number[][], right: readonly number[][], tolerance = 1e-6): void {
  expect(got.length).toBe(right.length);
  expect(right.length).toBeGreaterThan(0);
  const all = right.flat();
  const along = (axis: number) => all.filter((_, i) => i % 3 === axis);
  const diagonal = Math.hypot(
    ...[0, 1, 2].map((axis) => along(axis).reduce((a, b) => Math.max(a, b)) - along(axis).reduce((a, b) => Math.min(a, b))),
  );
  const worst = got.reduce((most, triangle, t) => {
    const other = right[t] as number[];
    const apart = ORDERS.map((order) =>
      triangle.reduce(
        (far, x, i) => Math.max(far, Math.abs(x - (other[3 * (order[Math.floor(i / 3)] as number) + (i % 3)] as number))),
        0,
      ),
    );
    return Math.max(most, Math.min(...apart));
  }, 0);
  expect(worst / diagonal).toBeLessThan(tolerance);
}
