import { isSkinned, type ObjectPart } from './object-part.ts';

/** Brings a part's place in the world up to date, and that of the bones that carry it. */
export function updateFrame({ mesh }: ObjectPart): void {
  mesh.updateWorldMatrix(true, false);
  if (!isSkinned(mesh)) return;
  for (const each of mesh.skeleton.bones) each.updateWorldMatrix(true, false);
  // It also brings the inverse bind matrix up to date, which the method above does not.
  mesh.updateMatrixWorld();
}
