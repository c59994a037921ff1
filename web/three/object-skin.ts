/** A skinned mesh of three.js as both readers see it. */
import type { Bone, Object3D, SkinnedMesh } from 'three';
import type { PartSkin } from '../assets/skin-frame.ts';
import { invertAffine, isIdentity, type Matrix, multiplyMatrices } from '../assets/transform.ts';
import { decode } from './decode.ts';
import type { Places } from './places.ts';

/** Undefined where the mesh has no weights, and so no skin. */
export function skinOf(mesh: SkinnedMesh, places: Places): PartSkin | undefined {
  const { skinIndex, skinWeight } = mesh.geometry.attributes;
  const { bones, boneInverses } = mesh.skeleton ?? { bones: [], boneInverses: [] };
  if (!skinIndex || !skinWeight || bones.length === 0) return undefined;
  const bind = mesh.bindMatrix.elements;
  const matrices = bones.map((bone, i) =>
    multiplyMatrices(multiplyMatrices(placeOf(bone, mesh, places), boneInverses[i]?.elements ?? []), bind),
  );
  return { matrices, root: rootOf(bones), joints: decode(skinIndex, 4), weights: decode(skinWeight, 4) };
}

/** From what a bone carries to the object. */
function placeOf(bone: Bone, mesh: SkinnedMesh, places: Places): Matrix {
  // A detached skeleton stands in a world of its own, which the mesh carries along.
  if (mesh.bindMode === 'detached') {
    const inverse = invertAffine(mesh.bindMatrix.elements) ?? mesh.bindMatrixInverse.elements;
    return multiplyMatrices(multiplyMatrices(places.inObject(mesh), inverse), places.inWorld(bone));
  }
  if (places.isInside(bone)) return places.inObject(bone);
  const world = places.inWorld(bone);
  const object = places.inWorld(places.object);
  return isIdentity(object) ? world : multiplyMatrices(invertAffine(object) ?? object, world);
}

/** The first that hangs below no other one. */
function rootOf(bones: readonly Bone[]): number {
  const isBelowAnother = (bone: Object3D) => {
    for (let above = bone.parent; above; above = above.parent) if (bones.includes(above as Bone)) return true;
    return false;
  };
  return Math.max(
    bones.findIndex((bone) => !isBelowAnother(bone)),
    0,
  );
}
