// The way of a model through the command, in every form that a file may have: baked and bent by handles that stay where they are, it is
// shown as it was, by three.js and by both readers, and each file on the way is sound.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { MeshoptDecoder } from 'meshoptimizer/decoder';
import { MeshoptEncoder } from 'meshoptimizer/encoder';
import { type Mesh, type Object3D, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { readGlb, readMesh } from '../../web/assets/index.ts';
import { runCommand } from '../../web/cli/command.ts';
import { STORAGES, store } from './support/made-gltf.ts';
import { FEATURES, STEERED } from './support/made-models.ts';
import { faultsOf } from './support/sound-glb.ts';

const folder = mkdtempSync(path.join(tmpdir(), 'handlebody-rest-'));
const at = (name: string) => path.join(folder, name);
const QUICK = ['--distance', 'euclidean', '--centers', '12', '--resolution', '8', '--spheres', '8', '-q'];

beforeAll(async () => {
  await MeshoptEncoder.ready;
  await MeshoptDecoder.ready;
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

/** Positions of all vertices in the world, as three.js shows them. */
async function shown(bytes: Uint8Array): Promise<number[]> {
  const { scene } = await new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).parseAsync(bytes.slice().buffer, '');
  scene.updateMatrixWorld(true);
  const out: number[] = [];
  scene.traverse((node: Object3D) => {
    const { geometry, isMesh } = node as Mesh;
    if (!geometry) return;
    for (let v = 0; v < geometry.getAttribute('position').count; v++) {
      const place = new Vector3().fromBufferAttribute(geometry.getAttribute('position'), v);
      if (isMesh) (node as Mesh).getVertexPosition(v, place);
      out.push(...place.applyMatrix4(node.matrixWorld).toArray());
    }
  });
  return out;
}

function expectSame(found: ArrayLike<number>, right: ArrayLike<number>) {
  const numbers = Array.from(right);
  const diagonal = Math.max(...numbers) - Math.min(...numbers);
  expect(found.length).toBe(right.length);
  expect(Math.max(...numbers.map((x, i) => Math.abs(x - (found[i] as number)))) / diagonal).toBeLessThan(1e-6);
}

const MODELS = Object.entries({ ...FEATURES, ...STEERED }).map(([name, make], i) => ({ name, make, i }));

describe.each(MODELS)('$name', ({ name, make, i }) => {
  // Each storage by a third of the models.
  it.each(STORAGES.filter((_, k) => (i + k) % 3 === 0))('stored %s (seed 11), rests where it was', async (storage) => {
    const seed = 11;
    for (const morphs of /morph/.test(name) ? (['rest', 'present'] as const) : (['present'] as const)) {
      const { bytes } = store(make(seed), { seed, storage, place: 'glb' });
      const [right, { mesh }] = [await shown(bytes), readMesh(await readGlb(bytes), { morphs })];
      writeFileSync(at('model.glb'), bytes);
      expect(await runCommand(['bake', at('model.glb'), '-o', at('body.glb'), '--morphs', morphs, ...QUICK])).toBe(0);
      const place = (v: number) => [0, 1, 2].map((axis) => mesh.positions[3 * v + axis]);
      const handles = [0, 7, 13].map((vertex) => ({ vertex, to: place(vertex) }));
      writeFileSync(at('handles.json'), JSON.stringify({ handles }));
      expect(await runCommand(['deform', at('body.glb'), '--handles', at('handles.json'), '-o', at('bent.glb'), '-q'])).toBe(0);
      for (const file of ['body.glb', 'bent.glb']) {
        const written = new Uint8Array(readFileSync(at(file)));
        expect(faultsOf(written)).toEqual([]);
        expectSame(await shown(written), right);
        expectSame(readMesh(await readGlb(written), { morphs }).mesh.positions, mesh.positions);
      }
      expect(await runCommand(['bake', at('bent.glb'), '-o', at('again.glb'), '--morphs', morphs, ...QUICK])).toBe(0);
    }
  });
});
