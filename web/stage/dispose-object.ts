import { type InstancedMesh, type Material, type Mesh, type Object3D, Texture } from 'three';

/** Gives back the graphics memory of everything below an object. */
export function disposeObject(object: Object3D): void {
  object.traverse((part) => {
    const { geometry, material, isInstancedMesh } = part as Partial<InstancedMesh>;
    geometry?.dispose();
    if (material) disposeMaterial(material);
    if (isInstancedMesh) (part as InstancedMesh).dispose();
  });
}

/** Of a mesh's material, or of all that it has. */
export function disposeMaterial(material: Mesh['material']): void {
  for (const each of [material].flat() as Material[]) {
    for (const value of Object.values(each)) if (value instanceof Texture) value.dispose();
    each.dispose();
  }
}
