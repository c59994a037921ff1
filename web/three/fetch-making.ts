import type { Mesh, Object3D } from 'three';
import type { LiveMaking } from './live-geometry.ts';

/** What shows an object's deformation beyond positions and normals, fetched where there is something of its kind: most models have none. */
export async function fetchMaking(object: Object3D): Promise<LiveMaking> {
  const nodes: Mesh[] = [];
  object.traverse((node) => nodes.push(node as Mesh));
  const [tangents, morphs, instances] = await Promise.all([
    nodes.some(({ geometry }) => (geometry as Mesh['geometry'] | undefined)?.attributes.tangent) && import('./turned-tangents.ts'),
    nodes.some(({ geometry }) => Object.keys(geometry?.morphAttributes ?? {}).length > 0) && import('./live-morphs.ts'),
    nodes.some((node) => 'isInstancedMesh' in node || 'isBatchedMesh' in node) && import('./instances-as-mesh.ts'),
  ]);
  return {
    ...(tangents && { tangentsOf: tangents.TurnedTangents.of }),
    ...(morphs && { Morphs: morphs.LiveMorphs }),
    ...(instances && { standFor: instances.standFor }),
  };
}
