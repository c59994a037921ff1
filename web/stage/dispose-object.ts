import { type Material, type Mesh, type Object3D, Texture } from 'three';

/** Gives back the graphics memory of everything below an object. */
export function disposeObject(object: Object3D): void {
  object.traverse((part) => {
    const { geometry, material } = part as Partial<Mesh>;
    geometry?.dispose();
    for (const each of [material ?? []].flat() as Material[]) {
      for (const value of Object.values(each)) if (value instanceof Texture) value.dispose();
      each.dispose();
    }
  });
}
