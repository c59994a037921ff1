import type { Mesh } from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { meshFromObject } from '../../three/geometry.ts';
import { handlebodyPlugin } from '../../three/loader.ts';

/** The surface in a GLB. */
export async function readModel(file: ArrayBuffer): Promise<{ positions: Float32Array; triangles: Uint32Array }> {
  const gltf = await new GLTFLoader().register(handlebodyPlugin).parseAsync(file, '');
  const { mesh } = meshFromObject(gltf.scene);
  gltf.scene.traverse((part) => (part as Partial<Mesh>).geometry?.dispose());
  return { positions: Float32Array.from(mesh.positions), triangles: Uint32Array.from(mesh.triangles) };
}
