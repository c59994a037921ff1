import type { Object3D, Mesh as ThreeMesh } from 'three';
import type { TangentsOf } from './live-geometry.ts';

/** What turns the tangents of an object's meshes, fetched where one has any: most models have none. */
export async function fetchTangents(object: Object3D): Promise<TangentsOf | undefined> {
  let hasSome = false;
  object.traverse((node) => {
    hasSome ||= (node as Partial<ThreeMesh>).geometry?.hasAttribute('tangent') ?? false;
  });
  return hasSome ? (await import('./turned-tangents.ts')).TurnedTangents.of : undefined;
}
