// Where a skin is read: as three.js shows it, however its mesh, its bones and the object hang, and whatever of it is not drawn.
import {
  BufferAttribute,
  type Float32BufferAttribute,
  Group,
  Matrix4,
  Mesh,
  type Object3D,
  Scene,
  type SkinnedMesh,
  Vector3,
} from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { describe, expect, it } from 'vitest';
import { hashPositions } from '../../wasm/ts/hash.ts';
import { readGlb, readMesh } from '../../web/assets/index.ts';
import type { SceneWarning } from '../../web/assets/scene-choices.ts';
import { meshFromObject } from '../../web/three/index.ts';
import { drawnTriangles, expectSame, joined } from './support/drawn-triangles.ts';
import { glb } from './support/made-gltf.ts';
import { skins } from './support/made-objects.ts';
import { meshesOf, skinned } from './support/objects.ts';
import { random } from './support/scattered.ts';

const SEEDS = Array.from({ length: 24 }, (_, i) => i + 1);

const read = (object: Object3D) => {
  const codes: string[] = [];
  const { mesh } = meshFromObject(object, { onWarning: ({ code }: SceneWarning) => codes.push(code) });
  return { mesh, codes };
};

function put<T extends Object3D>(node: T, next: () => number): T {
  node.position.set(next(), next(), next());
  node.rotation.set(3 * next(), 3 * next(), 3 * next());
  node.scale.set(1 + Math.abs(next()), next() > 0 ? 1 : -1.2, 0.7);
  return node;
}

describe('a skin that its bones carry alike', () => {
  const HANGINGS: Record<string, (made: Group, mesh: SkinnedMesh, next: () => number) => Object3D> = {
    'below parents that were moved': (made) => made,
    'by itself': (_, mesh) => mesh,
    'with its bones outside the object': (made, mesh) => {
      let scene: Object3D = made;
      while (scene.parent) scene = scene.parent;
      scene.attach(mesh.skeleton.bones[0] as Object3D);
      return made;
    },
    detached: (made, mesh, next) => {
      mesh.bindMode = 'detached';
      made.updateWorldMatrix(true, true);
      mesh.bind(
        mesh.skeleton,
        put(new Group(), next)
          .matrix.clone()
          .multiply(new Matrix4().makeTranslation(1, 2, 3)),
      );
      put(made.parent as Object3D, next);
      return made;
    },
  };
  it.each(Object.entries(HANGINGS))('%s, is read where it is shown (seeds 1 to 24)', (_, hang) => {
    for (const seed of SEEDS) {
      const next = random(seed).number;
      const made = put(skinned(), next);
      const scene = new Scene().add(put(new Group(), next).add(made));
      scene.updateMatrixWorld(true);
      const [mesh] = meshesOf(made) as [SkinnedMesh];
      const object = hang(made, mesh, next);
      scene.updateMatrixWorld(true);
      const found = read(object);
      const inverse = object.matrixWorld.clone().invert();
      const shown = drawnTriangles(mesh).map((triangle) =>
        [0, 3, 6].flatMap((k) => new Vector3().fromArray(triangle, k).applyMatrix4(inverse).toArray()),
      );
      expect(found.codes).toEqual([]);
      expectSame(joined(found.mesh.triangles, found.mesh.positions), shown, 1e-5);
    }
  });

  it('is not read otherwise for a vertex that nothing draws (seeds 1 to 24)', () => {
    for (const seed of SEEDS) {
      const next = random(seed).number;
      const [object, other] = [skins(random(seed).number), skins(random(seed).number)];
      const [mesh, twin] = [meshesOf(object)[0], meshesOf(other)[0]] as [SkinnedMesh, SkinnedMesh];
      // A pose of little more than nothing, in every second one.
      if (seed % 2 === 0) for (const each of [mesh, twin]) (each.skeleton.bones[2] as Object3D).position.x += 1e-3;
      const { geometry } = twin;
      if (!geometry.index) geometry.setIndex([...Array(geometry.getAttribute('position').count).keys()]);
      const stray = seed % 3 === 0 ? Number.NaN : 1e6 * next();
      for (const [name, row] of Object.entries({
        position: [stray, stray, 1],
        skinIndex: [2, 0, 0, 0],
        skinWeight: [1, 0, 0, 0],
      })) {
        const { array, itemSize } = geometry.getAttribute(name);
        const Numbers = array.constructor as Float32ArrayConstructor;
        geometry.setAttribute(name, new BufferAttribute(Numbers.from([...array, ...row]), itemSize));
      }
      const [right, found] = [read(object), read(other)];
      expect(found.codes).toEqual(seed % 2 === 0 ? ['skin-posed'] : []);
      expect(found.codes).toEqual(right.codes);
      expect(joined(found.mesh.triangles, found.mesh.positions)).toEqual(joined(right.mesh.triangles, right.mesh.positions));
    }
  });

  it('has a row of zeros with its first joint, as three.js loads it (seeds 1 to 24)', () => {
    for (const seed of SEEDS) {
      const object = skins(random(seed).number);
      const [mesh] = meshesOf(object) as [SkinnedMesh];
      const { skinIndex, skinWeight } = mesh.geometry.attributes;
      for (let v = 0; v < (skinIndex?.count ?? 0); v++) {
        skinIndex?.setXYZW(v, v === 3 && seed % 2 === 0 ? 2 : 0, 2, 2, 2);
        if (v === 3) skinWeight?.setXYZW(v, 0, 0, 0, 0);
        else skinWeight?.setXYZW(v, 1, 0, 0, 0);
      }
      (mesh.skeleton.bones[2] as Object3D).position.x += 1;
      expect(read(object).codes).toEqual(seed % 2 === 0 ? ['skin-posed'] : []);
    }
  });

  it('without a skeleton is a mesh like others', () => {
    const made = skinned();
    const [mesh] = meshesOf(made) as [SkinnedMesh];
    const plain = new Mesh(mesh.geometry);
    Object.assign(plain, { matrixAutoUpdate: false, matrix: mesh.matrix });
    (mesh as { skeleton: unknown }).skeleton = undefined;
    expect(read(made).mesh.positions).toEqual(read(new Group().add(plain)).mesh.positions);
  });
});

describe('joints of a file', () => {
  /** A forest of nodes, of which some are joints, some hang in no scene, and some are only animated. */
  function forest(seed: number): Uint8Array {
    const next = random(seed).number;
    const chance = (part: number) => (next() + 1) / 2 < part;
    const floats: number[][] = [];
    const accessors: object[] = [];
    const add = (numbers: number[], type: string, more: object = {}) => {
      floats.push(numbers);
      const width = { SCALAR: 1, VEC3: 3, VEC4: 4, MAT4: 16 }[type] as number;
      return (
        accessors.push({ bufferView: accessors.length, componentType: 5126, type, count: numbers.length / width, ...more }) - 1
      );
    };
    const rows = (count: number, row: (i: number) => number[]) => Array.from({ length: count }, (_, i) => row(i)).flat();
    const position = add(random(seed).numbers(27), 'VEC3', { min: [-1, -1, -1], max: [1, 1, 1] });
    const joint = add(
      rows(9, (i) => [i % 3, (i + 1) % 3, 0, 0]),
      'VEC4',
    );
    // One row of zeros in every third file.
    const weight = add(
      rows(9, (i) => (i === 4 && seed % 3 === 0 ? [0, 0, 0, 0] : [0.5, 0.5, 0, 0])),
      'VEC4',
    );
    const agree = chance(0.5);
    const nodes = Array.from({ length: 8 }, (_, i) => ({
      ...(i === 0 ? { mesh: 0, skin: 0 } : {}),
      ...(agree && i > 3 ? {} : { translation: [next(), next(), next()] }),
      children: [] as number[],
    }));
    const roots = [0];
    for (let i = 1; i < nodes.length; i++) {
      const above = Math.floor(((next() + 1) / 2) * i);
      if (chance(0.7) && above > 0) nodes[above]?.children.push(i);
      else roots.push(i);
    }
    const joints = random(seed + 50)
      .permutation(7)
      .slice(0, 3)
      .map((i) => i + 1);
    const inScene = roots.filter((root) => root === 0 || chance(0.5));
    const others = roots.filter((root) => !inScene.includes(root) && chance(0.3));
    const times = add([0, 1], 'SCALAR', { min: [0], max: [1] });
    const moves = add([0, 0, 0, 0, 0, 0], 'VEC3');
    const target = Math.floor(3 + 3 * Math.abs(next()));
    const animation = {
      samplers: [{ input: times, output: moves }],
      channels: [{ sampler: 0, target: { node: target, path: 'translation' } }],
    };
    const inverses = add(
      rows(3, () => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, next(), 0, 0, 1]),
      'MAT4',
    );
    const bin = new Uint8Array(Float32Array.from(floats.flat()).buffer);
    let byteOffset = 0;
    const bufferViews = floats.map(({ length }) => {
      byteOffset += 4 * length;
      return { buffer: 0, byteOffset: byteOffset - 4 * length, byteLength: 4 * length };
    });
    const json = {
      asset: { version: '2.0' },
      scene: 0,
      scenes: [{ nodes: inScene }, ...(others.length > 0 ? [{ nodes: others }] : [])],
      nodes: nodes.map(({ children, ...node }) => ({ ...node, ...(children.length > 0 && { children }) })),
      meshes: [{ primitives: [{ attributes: { POSITION: position, JOINTS_0: joint, WEIGHTS_0: weight } }] }],
      skins: [{ joints, inverseBindMatrices: inverses }],
      ...(chance(0.4) && { animations: [animation] }),
      ...{ accessors, bufferViews, buffers: [{ byteLength: bin.length }] },
    };
    return glb(withShorts(json, joint, bin), bin);
  }

  /** Joints are whole numbers. */
  function withShorts<Json extends { accessors: object[]; bufferViews: { byteOffset: number; byteLength: number }[] }>(
    json: Json,
    joint: number,
    bin: Uint8Array,
  ): Json {
    const { byteOffset, byteLength } = json.bufferViews[joint] as { byteOffset: number; byteLength: number };
    const numbers = new Float32Array(bin.slice(byteOffset, byteOffset + byteLength).buffer);
    bin.set(Uint8Array.from(numbers), byteOffset);
    Object.assign(json.accessors[joint] as object, { componentType: 5121 });
    return json;
  }

  it('hang as three.js hangs them, in a scene or in none (seeds 1 to 60)', async () => {
    let posed = 0;
    for (let seed = 1; seed <= 60; seed++) {
      const bytes = forest(seed);
      const codes: string[] = [];
      const { mesh } = readMesh(await readGlb(bytes), { onWarning: ({ code }) => codes.push(code) });
      const { scene } = await new GLTFLoader().parseAsync(bytes.slice().buffer, '');
      const other = read(scene);
      expect(hashPositions(mesh.positions)).toBe(hashPositions(other.mesh.positions));
      expect(mesh.reading).toEqual(other.mesh.reading);
      expect(codes).toEqual(other.codes);
      posed += codes.length;
      // By three.js alone.
      const shown = meshesOf(scene)[0] as SkinnedMesh;
      scene.updateMatrixWorld(true);
      const { bones, boneInverses } = shown.skeleton;
      for (const bone of bones) bone.updateWorldMatrix(true, false);
      const r = codes.length > 0 ? bones.findIndex((bone) => !isBelow(bone, bones)) : 0;
      const frame = bones[r]?.matrixWorld.clone().multiply(boneInverses[r] as Matrix4);
      const stored = shown.geometry.getAttribute('position') as Float32BufferAttribute;
      for (let v = 0; v < stored.count; v++) {
        const right = new Vector3().fromBufferAttribute(stored, v).applyMatrix4(frame as Matrix4);
        expect(right.distanceTo(new Vector3().fromArray(mesh.positions, 3 * v))).toBeLessThan(1e-5);
      }
    }
    expect(posed).toBeGreaterThan(20);
  });

  function isBelow(bone: Object3D, bones: readonly Object3D[]): boolean {
    for (let above = bone.parent; above; above = above.parent) if (bones.includes(above)) return true;
    return false;
  }
});
