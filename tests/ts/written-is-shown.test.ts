// What is written back into a file is shown once, in its place, and goes on being steered: three.js shows of the file what it shows of a
// scene under DeformedGeometry, which is another way to the same picture.
import { Document } from '@gltf-transform/core';
import { MeshoptDecoder } from 'meshoptimizer/decoder';
import { MeshoptEncoder } from 'meshoptimizer/encoder';
import { type Mesh, type Object3D, type SkinnedMesh, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { beforeAll, describe, expect, it } from 'vitest';
import { readGlb, readMesh, writeGlb } from '../../web/assets/index.ts';
import { sceneNormals, writeShape } from '../../web/cli/write-shape.ts';
import { DeformedGeometry, meshFromObject } from '../../web/three/index.ts';
import { store } from './support/made-gltf.ts';
import { FEATURES, STEERED } from './support/made-models.ts';
import { bend } from './support/made-objects.ts';
import { random } from './support/scattered.ts';

const SEEDS = Array.from({ length: 20 }, (_, i) => i + 1);

beforeAll(async () => {
  await MeshoptEncoder.ready;
  await MeshoptDecoder.ready;
});

const load = async (bytes: Uint8Array) =>
  (await new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).parseAsync(bytes.slice().buffer, '')).scene;

function meshesOf(scene: Object3D): Mesh[] {
  const found: Mesh[] = [];
  scene.traverse((node) => {
    if ((node as Mesh).isMesh || 'isPoints' in node) found.push(node as Mesh);
  });
  return found;
}

/** All vertices in the world, by three.js' own reckoning of morph targets and bones. */
function shownBy(scene: Object3D): number[] {
  scene.updateMatrixWorld(true);
  return meshesOf(scene).flatMap((mesh) => {
    const stored = mesh.geometry.getAttribute('position');
    return Array.from({ length: stored.count }, (_, v) => {
      const place = new Vector3();
      if ('isPoints' in mesh) place.fromBufferAttribute(stored, v);
      else mesh.getVertexPosition(v, place);
      return place.applyMatrix4(mesh.matrixWorld).toArray();
    }).flat();
  });
}

function expectNear(got: ArrayLike<number>, right: ArrayLike<number>): void {
  expect(got.length).toBe(right.length);
  const numbers = Array.from(right);
  const size = Math.max(...numbers) - Math.min(...numbers);
  const worst = numbers.reduce((most, x, i) => Math.max(most, Math.abs(x - (got[i] as number))), 0);
  expect(worst / size).toBeLessThan(1e-5);
}

describe.each(Object.entries({ ...FEATURES, ...STEERED }))('%s', (name, make) => {
  it.each(['present', 'rest'] as const)(
    `is shown bent, once, and steered afterwards (morphs: %s; seeds 1 to ${SEEDS.length})`,
    async (morphs) => {
      for (const seed of SEEDS) {
        const { bytes } = store(make(seed), { seed, storage: seed % 2 === 0 ? 'packed' : 'meshopt', place: 'glb' });
        const document = await readGlb(bytes);
        const { mesh, ranges } = readMesh(document, { morphs });
        const positions = bend(mesh.positions);
        writeShape(document, ranges, { positions, normals: sceneNormals(ranges) ?? new Float32Array(positions.length) });
        const written = await load(await writeGlb(document));

        const scene = await load(bytes);
        const atRest = shownBy(scene);
        const { parts } = meshFromObject(scene, { morphs });
        const shown = new DeformedGeometry(parts);
        shown.update(positions);
        expectNear(shownBy(written), shownBy(scene));
        // Nothing else moves these.
        if (!/skin (in a pose|with morph|whose joints hang)/.test(name) && (morphs === 'present' || !name.includes('weights')))
          expectNear(shownBy(written), positions);
        const { number } = random(seed + 500);
        const [one, other] = [meshesOf(written), meshesOf(scene)];
        one.forEach((each, i) => {
          const twin = other[i] as Mesh;
          each.morphTargetInfluences = each.morphTargetInfluences?.map(number) as number[];
          if (twin.morphTargetInfluences) twin.morphTargetInfluences = [...(each.morphTargetInfluences ?? [])];
          const bones = (each as SkinnedMesh).skeleton?.bones ?? [];
          for (const [k, bone] of bones.entries()) {
            bone.rotation.set(number(), number(), number());
            (twin as SkinnedMesh).skeleton.bones[k]?.rotation.copy(bone.rotation);
          }
        });
        expectNear(shownBy(written), shownBy(scene));
        shown.dispose();
        expect(shownBy(await load(bytes))).toEqual(atRest);
      }
    },
  );
});

it('primitives of the same positions are written apart where other targets move them (seeds 1 to 20)', async () => {
  for (const seed of SEEDS) {
    const { numbers } = random(seed);
    const document = new Document();
    const buffer = document.createBuffer();
    const vec3 = (count: number) =>
      document
        .createAccessor('', buffer)
        .setType('VEC3')
        .setArray(Float32Array.from(numbers(count)));
    const [position, normal] = [vec3(12), vec3(12)];
    const [moved, twin] = [vec3(12), vec3(12)];
    const indices = document.createAccessor('', buffer).setArray(Uint16Array.of(0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3));
    const mesh = document.createMesh().setWeights(numbers(1));
    for (const target of [moved, twin, moved])
      mesh.addPrimitive(
        document
          .createPrimitive()
          .setIndices(indices)
          .setAttribute('POSITION', position)
          .setAttribute('NORMAL', normal)
          .addTarget(document.createPrimitiveTarget().setAttribute('POSITION', target)),
      );
    document.getRoot().setDefaultScene(document.createScene().addChild(document.createNode().setMesh(mesh)));
    const { mesh: read, ranges } = readMesh(document, { morphs: 'present' });
    const positions = bend(read.positions);
    writeShape(document, ranges, { positions, normals: sceneNormals(ranges) as Float32Array });
    expectNear(shownBy(await load(await writeGlb(document))), positions);
    // What is equal stays one.
    const [first, , third] = document.getRoot().listMeshes()[0]?.listPrimitives() ?? [];
    expect(first?.getAttribute('POSITION')).toBe(third?.getAttribute('POSITION'));
  }
});
