// Poses, far places, and the order in which deformations end: what a reader of scenes meets besides drawing.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  Group,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  Points,
  type SkinnedMesh,
  Vector3,
} from 'three';
import { BoxGeometry } from 'three/src/geometries/BoxGeometry.js';
import { beforeAll, describe, expect, it } from 'vitest';
import { type Handlebody, load } from '../../wasm/ts/index.ts';
import type { SceneWarning } from '../../web/assets/scene-choices.ts';
import { DeformedGeometry, deformable, meshFromObject } from '../../web/three/index.ts';
import { drawnTriangles } from './support/drawn-triangles.ts';
import { bend } from './support/made-objects.ts';
import { meshesOf, skinned } from './support/objects.ts';
import { random } from './support/scattered.ts';

const box = () => new Mesh(new BoxGeometry(2, 1, 1, 6, 3, 3), new MeshBasicMaterial());

describe('a skin in a pose', () => {
  /** Bones turned by some angle: they carry vertices apart. */
  const posed = (seed: number) => {
    const object = skinned();
    const [mesh] = meshesOf(object) as [SkinnedMesh];
    const next = random(seed).number;
    for (const bone of mesh.skeleton.bones) bone.rotation.set(next(), next(), next());
    object.updateMatrixWorld(true);
    return { object, mesh };
  };

  it('is read through the matrix of its root bone, with a warning (24 poses, seeds from 1)', () => {
    for (let seed = 1; seed <= 24; seed++) {
      const { object, mesh } = posed(seed);
      const warnings: SceneWarning[] = [];
      const read = meshFromObject(object, { onWarning: (warning) => warnings.push(warning) });
      expect(warnings.map(({ code }) => code)).toEqual(['skin-posed']);
      const [root] = mesh.skeleton.bones;
      const frame = root?.matrixWorld
        .clone()
        .multiply(mesh.skeleton.boneInverses[0] as never)
        .multiply(mesh.bindMatrix);
      const stored = mesh.geometry.getAttribute('position');
      for (let v = 0; v < stored.count; v++) {
        const right = new Vector3().fromBufferAttribute(stored, v).applyMatrix4(frame as never);
        expect(right.distanceTo(new Vector3().fromArray(read.mesh.positions, 3 * v))).toBeLessThan(1e-6);
      }
    }
  });

  it('is deformed before it is posed, and the pose may change meanwhile (seeds from 1)', () => {
    for (let seed = 1; seed <= 24; seed++) {
      const { object, mesh } = posed(seed);
      const { mesh: read, parts } = meshFromObject(object);
      const shown = new DeformedGeometry(parts);
      for (const bone of mesh.skeleton.bones) bone.rotation.set(0, 0, 0);
      object.updateMatrixWorld(true);
      shown.update(Float32Array.from(read.positions));
      const stored = meshesOf(skinned())[0]?.geometry.getAttribute('position').array as Float32Array;
      const worst = stored.reduce(
        (most, x, i) => Math.max(most, Math.abs(x - (mesh.geometry.getAttribute('position').array[i] as number))),
        0,
      );
      expect(worst).toBeLessThan(1e-6);
      expect(meshFromObject(object, { reading: read.reading ?? {} }).mesh.positions.length).toBe(read.positions.length);
      shown.dispose();
    }
  });

  it('keeps the matrix it was read through: a body fits in whatever pose', () => {
    const { object, mesh } = posed(5);
    const { mesh: read } = meshFromObject(object);
    for (const bone of mesh.skeleton.bones) bone.rotation.set(0.3, -0.2, 0.1);
    expect(meshFromObject(object, { reading: read.reading ?? {} }).mesh.positions).toEqual(read.positions);
  });
});

describe('a mesh far from the origin', () => {
  let hb: Handlebody;
  beforeAll(async () => {
    hb = await load();
  });
  const far = new Vector3(5e5, 4e6, 100);

  const standing = () => {
    const mesh = box();
    mesh.position.copy(far);
    return { object: new Group().add(mesh), mesh };
  };

  it('has an origin of its own, and keeps its edges', async () => {
    const { object, mesh } = standing();
    const read = meshFromObject(object).mesh;
    expect(read.origin?.every((x) => Math.fround(x) === x)).toBe(true);
    const stored = mesh.geometry.getAttribute('position');
    for (let i = 0; i < read.positions.length; i++) {
      const right = (stored.array[i] as number) + far.getComponent(i % 3) - (read.origin?.[i % 3] as number);
      expect(Math.abs((read.positions[i] as number) - right)).toBeLessThan(1e-7);
    }
  });

  it('takes handles and targets in the units of the model, and is shown where they are', async () => {
    const { object, mesh } = standing();
    const body = await hb.bake(meshFromObject(object).mesh, { centers: 20, resolution: 16, spheres: 20 });
    const shape = deformable(object, hb.irbf(body));
    const end = far.clone().add(new Vector3(0.9, 0, 0));
    shape.irbf.setHandles([
      {
        at: far
          .clone()
          .add(new Vector3(-0.9, 0, 0))
          .toArray(),
      },
      { at: end.toArray() },
      { vertex: 0 },
    ]);
    expect([...shape.irbf.targets.subarray(10, 13)]).toEqual(end.toArray());
    const corner = [...shape.irbf.targets.subarray(20, 23)];
    expect(corner).toEqual([far.x + 1, far.y + 0.5, far.z + 0.5]);
    shape.irbf.targets.set([end.x, end.y + 0.25, end.z], 10);
    shape.irbf.solve();
    const [x, y, z] = shape.irbf.evaluate(end.toArray()) as unknown as [number, number, number];
    expect(Math.hypot(x - end.x, y - end.y - 0.25, z - end.z)).toBeLessThan(1e-4);
    shape.deform();
    const highest = Math.max(...(mesh.geometry.getAttribute('position').array as Float32Array).filter((_, i) => i % 3 === 1));
    expect(highest).toBeGreaterThan(0.6);
    expect(highest).toBeLessThan(1);
  });

  it.each([
    ['a surface', (positions: Float64Array, triangles: number[]) => ({ positions, triangles: Uint32Array.from(triangles) })],
    ['a cloud', (positions: Float64Array) => ({ positions })],
    ['a solid', (positions: Float64Array) => ({ positions, tetrahedra: Uint32Array.from(CUBE_TETRAHEDRA) })],
  ])('of doubles is baked as it would be at the origin: %s', async (_, make) => {
    const mesh = new BoxGeometry(2, 1, 1, 6, 3, 3);
    const corners = Float64Array.from({ length: 24 }, (_, i) => (Math.floor(i / 3) >> (i % 3)) & 1);
    const near = _ === 'a solid' ? corners : Float64Array.from(mesh.getAttribute('position').array);
    const away = near.map((x, i) => x + far.getComponent(i % 3));
    const options = { centers: 8, resolution: 16, spheres: 8, onWarning: () => {} };
    const triangles = Array.from(mesh.index?.array ?? []);
    const [one, other] = [await hb.bake(make(near, triangles), options), await hb.bake(make(away, triangles), options)];
    expect([one.mesh.origin, other.mesh.origin?.length]).toEqual([undefined, 3]);
    expect(other.voxels).toEqual(one.voxels);
    // What a double of that size is rounded to.
    for (let i = 0; i < away.length; i++)
      expect((other.mesh.positions[i] as number) + (other.mesh.origin?.[i % 3] as number)).toBeCloseTo(away[i] as number, 9);
  });

  it('says when the stored floats have lost the shape', () => {
    const mesh = box();
    mesh.geometry.translate(far.x, far.y, far.z);
    const codes: string[] = [];
    meshFromObject(new Group().add(mesh), { onWarning: ({ code }) => codes.push(code) });
    expect(codes).toEqual(['positions-coarse']);
  });

  it.each([999, 1001])('has one when it is more than 1,000 diagonals away: at %i', (diagonals) => {
    const mesh = new Mesh(new BoxGeometry(1, 1, 1), new MeshBasicMaterial());
    mesh.position.x = diagonals * Math.sqrt(3) + 0.5;
    expect(meshFromObject(new Group().add(mesh)).mesh.origin !== undefined).toBe(diagonals > 1000);
  });

  it('is not sent there by a vertex that no triangle uses', () => {
    const geometry = new BufferGeometry().setAttribute(
      'position',
      new BufferAttribute(Float32Array.from([1e7, 1e7, 1e7, 0, 0, 0, 1, 0, 0, 0, 1, 0]), 3),
    );
    geometry.setIndex([1, 2, 3]);
    expect(meshFromObject(new Mesh(geometry)).mesh.origin).toBeUndefined();
    const { positions } = meshFromObject(new Mesh(geometry)).mesh;
    expect(positions[0]).toBe(1e7);
  });
});

const CUBE_TETRAHEDRA = [0, 1, 3, 7, 0, 1, 5, 7, 0, 2, 3, 7, 0, 2, 6, 7, 0, 4, 5, 7, 0, 4, 6, 7];

describe('deformations of one mesh', () => {
  it('put back what was there, in whatever order they end (all orders of four)', () => {
    const orders = permutations([0, 1, 2, 3]);
    expect(orders).toHaveLength(24);
    for (const order of orders) {
      const mesh = box();
      const original = mesh.geometry;
      const { parts, mesh: read } = meshFromObject(new Group().add(mesh));
      const shown = order.map(() => new DeformedGeometry(parts));
      for (const [i, each] of shown.entries()) each.update(Float32Array.from(read.positions, (x) => x + i + 1));
      for (const i of order) shown[i]?.dispose();
      expect(mesh.geometry).toBe(original);
    }
  });

  it('leave a geometry alone that the mesh was given meanwhile', () => {
    const mesh = box();
    const shown = new DeformedGeometry(meshFromObject(new Group().add(mesh)).parts);
    const other = new BoxGeometry(1, 1, 1);
    mesh.geometry = other;
    shown.dispose();
    expect(mesh.geometry).toBe(other);
  });

  it('leave a clone, and its original, as they are', () => {
    const mesh = box();
    const clone = mesh.clone();
    const { parts, mesh: read } = meshFromObject(new Group().add(clone));
    const shown = new DeformedGeometry(parts);
    shown.update(bend(read.positions));
    expect(mesh.geometry.getAttribute('position').array).toEqual(box().geometry.getAttribute('position').array);
    shown.dispose();
    expect(clone.geometry).toBe(mesh.geometry);
  });
});

describe('points', () => {
  it('that are not drawn lie where the first drawn one does, and are no part of the cloud', () => {
    const geometry = new BufferGeometry().setAttribute(
      'position',
      new BufferAttribute(Float32Array.from([9, 9, 9, 1, 2, 3, 4, 5, 6, 9, 9, 9]), 3),
    );
    geometry.setDrawRange(1, 2);
    expect([...meshFromObject(new Points(geometry)).mesh.positions]).toEqual([1, 2, 3, 1, 2, 3, 4, 5, 6, 1, 2, 3]);
  });

  it('beside a surface are named in a warning', () => {
    const messages: string[] = [];
    const geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(6), 3));
    meshFromObject(new Group().add(box(), new Points(geometry)), { onWarning: ({ code }) => messages.push(code) });
    expect(messages).toEqual(['left-out']);
  });
});

describe('instances', () => {
  const three = () => {
    const mesh = new InstancedMesh(new BoxGeometry(1, 1, 1, 3, 3, 3), new MeshBasicMaterial({ color: 'red' }), 3);
    for (const i of [0, 1, 2]) {
      mesh.setMatrixAt(i, new Matrix4().makeRotationZ(i).setPosition(3 * i, 0, 0));
      mesh.setColorAt(i, new Color(0.1 * (i + 1), 0.5, 0.25));
    }
    mesh.layers.set(3);
    return mesh;
  };

  it('are shown as one mesh in the place of theirs: one is bent, the others stay', () => {
    const mesh = three();
    const object = new Group().add(box(), mesh, box());
    const { mesh: read, parts } = meshFromObject(object);
    const before = drawnTriangles(mesh);
    const shown = new DeformedGeometry(parts);
    const second = parts[2] as (typeof parts)[number];
    expect(second.instance?.index).toBe(1);
    const bent = Float32Array.from(read.positions);
    for (let i = 3 * second.start; i < 3 * (second.start + second.count); i += 3) bent[i + 1] = (bent[i + 1] as number) + 0.5;
    shown.update(bent);
    const plain = object.children[1] as Mesh;
    expect([plain.type, plain.layers.mask, object.children.length]).toEqual(['Mesh', mesh.layers.mask, 3]);
    const after = drawnTriangles(plain);
    const moved = after.map((triangle, t) => Math.max(...triangle.map((x, k) => Math.abs(x - (before[t]?.[k] as number)))));
    const third = moved.length / 3;
    expect(Math.max(...moved.slice(0, third), ...moved.slice(2 * third))).toBeLessThan(1e-6);
    for (const each of moved.slice(third, 2 * third)) expect(each).toBeCloseTo(0.5, 6);
    const colors = plain.geometry.getAttribute('color');
    expect([0, 1, 2].map((i) => Number(colors.getX((i * colors.count) / 3).toFixed(6)))).toEqual([0.1, 0.2, 0.3]);
    expect((plain.material as MeshBasicMaterial).vertexColors).toBe(true);
    expect((mesh.material as MeshBasicMaterial).vertexColors).toBe(false);
    // Where the original is put, its stand goes.
    mesh.position.set(0, 7, 0);
    shown.update(bent);
    plain.updateMatrixWorld(true);
    expect(plain.matrixWorld.elements[13]).toBe(7);
    shown.dispose();
    expect(object.children[1]).toBe(mesh);
  });

  it('that are the whole object are shown below it, until they are back', () => {
    const mesh = three();
    const { mesh: read, parts } = meshFromObject(mesh);
    const shown = new DeformedGeometry(parts);
    shown.update(read.positions);
    expect([mesh.children.length, mesh.children[0]?.layers.mask, mesh.count]).toEqual([1, 8, 0]);
    expect(meshFromObject(mesh).mesh.positions).toEqual(read.positions);
    shown.dispose();
    expect([mesh.children.length, mesh.layers.mask, mesh.count]).toEqual([0, 8, 3]);
  });
});

function permutations(items: readonly number[]): number[][] {
  if (items.length === 0) return [[]];
  return items.flatMap((item) => permutations(items.filter((other) => other !== item)).map((rest) => [item, ...rest]));
}

it('a part that was hidden when the mesh was read stays out of it when all are shown', () => {
  const [one, two] = [box(), box()];
  one.visible = false;
  const object = new Group().add(one, two);
  const { mesh } = meshFromObject(object);
  one.visible = true;
  expect(meshFromObject(object, { reading: mesh.reading ?? {} }).mesh.positions).toEqual(mesh.positions);
  expect(meshFromObject(object).mesh.positions.length).toBe(2 * mesh.positions.length);
});
