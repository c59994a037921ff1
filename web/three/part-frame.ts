import { Matrix4, type SkinnedMesh } from 'three';
import { isSkinned, type ObjectPart } from './geometry.ts';

const bone = new Matrix4();

/** Brings a part's place in the world up to date, and that of the bones that carry it. */
export function updateFrame({ mesh }: ObjectPart): void {
  mesh.updateWorldMatrix(true, false);
  if (!isSkinned(mesh)) return;
  for (const each of mesh.skeleton.bones) each.updateWorldMatrix(true, false);
  // It also brings the inverse bind matrix up to date, which the method above does not.
  mesh.updateMatrixWorld();
}

/**
 * From the object's space, in which the body is, to the world, as a part's vertex is carried there: by its mesh, or by its bones, which
 * see it after it was deformed. `inverse` is that of the part's matrix. `updateFrame` comes first. Allocates nothing.
 */
export function worldFrame({ mesh }: ObjectPart, inverse: Matrix4, vertex: number, out: Matrix4): Matrix4 {
  if (!isSkinned(mesh)) return out.multiplyMatrices(mesh.matrixWorld, inverse);
  blendBones(mesh, vertex, out);
  return out.premultiply(mesh.bindMatrixInverse).premultiply(mesh.matrixWorld);
}

/** The sum of a vertex' bones by their weights, as three.js' shader has it. */
function blendBones({ geometry, skeleton }: SkinnedMesh, vertex: number, out: Matrix4): void {
  const { skinIndex, skinWeight } = geometry.attributes;
  const sum = out.elements.fill(0);
  for (let k = 0; k < 4; k++) {
    const weight = skinWeight?.getComponent(vertex, k) ?? 0;
    const index = skinIndex?.getComponent(vertex, k) ?? 0;
    const [moved, inverse] = [skeleton.bones[index], skeleton.boneInverses[index]];
    if (weight === 0 || !moved || !inverse) continue;
    const { elements } = bone.multiplyMatrices(moved.matrixWorld, inverse);
    for (let i = 0; i < 16; i++) sum[i] = (sum[i] as number) + weight * (elements[i] as number);
  }
  sum[15] = 1;
}
