import type { Mesh, Object3D } from 'three';
import type { LiveMaking } from './live-geometry.ts';

/** What shows an object's deformation beyond positions and normals, fetched where there is something of its kind: most models have none. */
export async function fetchMaking(object: Object3D): Promise<LiveMaking> {
  const has = { tangents: false, morphs: false, instances: false };
  object.traverse((node) => {
    const { geometry } = node as Partial<Mesh>;
    has.tangents ||= geometry?.hasAttribute('tangent') ?? false;
    has.morphs ||= Object.keys(geometry?.morphAttributes ?? {}).length > 0;
    has.instances ||= 'isInstancedMesh' in node || 'isBatchedMesh' in node;
  });
  const [tangents, morphs, instances] = await Promise.all([
    has.tangents ? import('./turned-tangents.ts') : undefined,
    has.morphs ? import('./live-morphs.ts') : undefined,
    has.instances ? import('./instances-as-mesh.ts') : undefined,
  ]);
  return {
    ...(tangents && { tangentsOf: tangents.TurnedTangents.of }),
    ...(morphs && { Morphs: morphs.LiveMorphs }),
    ...(instances && { standFor: instances.standFor }),
  };
}
