// What three.js' GLTFLoader shows of a file is what is read of it, by either reader, to the last bit the same by both: the features of
// the Khronos sample assets, in the ways that they can be stored.
import { MeshoptDecoder } from 'meshoptimizer/decoder';
import { MeshoptEncoder } from 'meshoptimizer/encoder';
import { type Matrix4, type Mesh, type Object3D, type SkinnedMesh, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { beforeAll, describe, expect, it } from 'vitest';
import { hashPositions } from '../../wasm/ts/hash.ts';
import { readGlb, readMesh } from '../../web/assets/index.ts';
import { meshFromObject } from '../../web/three/index.ts';
import { STORAGES, store } from './support/made-gltf.ts';
import { FEATURES, STEERED } from './support/made-models.ts';

const SEEDS = [1, 2, 3, 4];

beforeAll(async () => {
  await MeshoptEncoder.ready;
  await MeshoptDecoder.ready;
});

/** By three.js alone: positions of all vertices in the world, morph targets and all; of a skin in a pose through its root joint. */
function shownBy(scene: Object3D, posed: boolean): number[] {
  scene.updateMatrixWorld(true);
  const out: number[] = [];
  scene.traverse((node) => {
    const mesh = node as SkinnedMesh;
    if (!mesh.isMesh && !('isPoints' in node)) return;
    const place = new Vector3();
    for (let v = 0; v < mesh.geometry.getAttribute('position').count; v++) {
      if (posed && mesh.isSkinnedMesh) {
        // The Mesh's own method, without the bones.
        Object.getPrototypeOf(Object.getPrototypeOf(mesh)).getVertexPosition.call(mesh, v, place);
        const { bones, boneInverses } = mesh.skeleton;
        const r = bones.findIndex((bone) => !bones.includes(bone.parent as never));
        place
          .applyMatrix4(mesh.bindMatrix)
          .applyMatrix4(boneInverses[r] as Matrix4)
          .applyMatrix4((bones[r] as Object3D).matrixWorld);
      } else if ('isPoints' in node)
        place.fromBufferAttribute((node as unknown as Mesh).geometry.getAttribute('position'), v).applyMatrix4(node.matrixWorld);
      else mesh.getVertexPosition(v, place).applyMatrix4(mesh.matrixWorld);
      out.push(...place.toArray());
    }
  });
  return out;
}

/** Each triangle begun with its least corner: three.js begins those of a strip elsewhere. */
function turned(triangles: ArrayLike<number>): number[] {
  return Array.from({ length: triangles.length / 3 }, (_, t) => {
    const corners = [0, 1, 2].map((k) => triangles[3 * t + k] as number);
    const first = corners.indexOf(Math.min(...corners));
    return [0, 1, 2].map((k) => corners[(first + k) % 3] as number);
  }).flat();
}

describe.each(Object.entries({ ...FEATURES, ...STEERED }))('%s', (name, make) => {
  it.each(STORAGES)(`stored %s, is read as three.js shows it (seeds ${SEEDS.join(', ')})`, async (storage) => {
    for (const seed of SEEDS) {
      const { bytes } = store(make(seed), { seed, storage, place: 'glb' });
      const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
      const { scene } = await loader.parseAsync(bytes.slice().buffer, '');
      const posed = /skin (in a pose|with morph|whose joints hang)/.test(name);
      const right = shownBy(scene, posed);
      const codes: string[] = [];
      const choices = { morphs: 'present', onWarning: ({ code }: { code: string }) => codes.push(code) } as const;
      const { mesh } = readMesh(await readGlb(bytes), choices);
      const positions = mesh.positions as Float32Array;
      const diagonal = Math.max(...right) - Math.min(...right);
      const worst = positions.reduce((most, x, i) => Math.max(most, Math.abs(x - (right[i] as number))), 0);
      expect(positions.length).toBe(right.length);
      expect(worst / diagonal).toBeLessThan(1e-6);
      expect(codes).toEqual(posed ? ['skin-posed'] : []);
      const other = meshFromObject(scene, { morphs: 'present' }).mesh;
      expect(hashPositions(other.positions)).toBe(hashPositions(positions));
      expect(turned(other.triangles)).toEqual(turned(mesh.triangles));
      expect(other.reading).toEqual(mesh.reading);
    }
  });
});
