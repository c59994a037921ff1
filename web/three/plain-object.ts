import type { Object3D, Mesh as ThreeMesh } from 'three';
import type { Vec3 } from '../../wasm/ts/types.ts';
import { concatenate, type MeshRange } from '../assets/concatenate.ts';
import type { SceneChoices } from '../assets/scene-choices.ts';
import { IDENTITY, type Matrix, multiplyMatrices } from '../assets/transform.ts';
import { decode } from './decode.ts';
import { collectNormals, isMesh, isSkinned, type ObjectMesh } from './object-part.ts';

/**
 * What `meshFromObject` gives for an object of nothing but plain meshes, all of them drawn whole and as stored, which most models are;
 * undefined for others. Pages fetch the rest of it only for those. `known`: the origin that it had when it was read before.
 */
export function plainObject(object: Object3D, known?: Vec3): ObjectMesh | undefined {
  const found: { mesh: ThreeMesh; matrix: Matrix }[] = [];
  let isPlain = true;
  const visit = (node: Object3D, parent: Matrix) => {
    if (node.matrixAutoUpdate) node.updateMatrix();
    const matrix = node === object ? IDENTITY : multiplyMatrices(parent, node.matrix.elements);
    if (isMesh(node)) {
      isPlain &&= isDrawnAsStored(node);
      if (isPlain) found.push({ mesh: node, matrix });
    }
    isPlain &&= (node.visible || node === object) && !SPECIAL.some((name) => name in node);
    for (const child of node.children) visit(child, matrix);
  };
  visit(object, IDENTITY);
  if (!isPlain || found.length === 0) return undefined;
  const { mesh, ranges } = concatenate(
    found.map(({ mesh: { geometry }, matrix }) => ({
      positions: decode(geometry.getAttribute('position')),
      indices: geometry.index?.array,
      matrix,
    })),
    { origin: known },
  );
  // Vertices that are no numbers, which nothing may use, want a place.
  if (!(mesh.positions as Float32Array).every(Number.isFinite)) return undefined;
  const { origin } = mesh;
  const parts = found.map((part, i) => {
    const { start, count } = ranges[i] as MeshRange;
    return { ...part, start, count, ...(origin && { origin }) };
  });
  return { mesh, parts, normals: collectNormals(parts) };
}

/** Whether choices ask for more than what is drawn: for what was drawn once, or for warnings. */
export function asksForMore({ reading = {}, onWarning }: SceneChoices): boolean {
  return onWarning !== undefined || Object.keys(reading).some((name) => name !== 'origin');
}

const SPECIAL = ['isPoints', 'isLine', 'isSprite', 'isLOD', 'isInstancedMesh', 'isBatchedMesh'];

function isDrawnAsStored(mesh: ThreeMesh): boolean {
  const { geometry, material } = mesh;
  const { start, count } = geometry.drawRange;
  const stored = geometry.getAttribute('position');
  return (
    !isSkinned(mesh) &&
    !Array.isArray(material) &&
    material.visible &&
    start === 0 &&
    count === Number.POSITIVE_INFINITY &&
    stored !== undefined &&
    !('isGLBufferAttribute' in stored) &&
    !('isInstancedBufferGeometry' in geometry) &&
    (mesh.morphTargetInfluences ?? []).every((weight) => weight === 0)
  );
}
