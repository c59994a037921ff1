// The instances of a mesh under deformation: one plain mesh in their place, which goes where they go and leaves nothing behind.
import {
  BatchedMesh,
  BoxGeometry,
  Color,
  Group,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  Scene,
} from 'three';
import { describe, expect, it } from 'vitest';
import { DeformedGeometry, meshFromObject } from '../../web/three/index.ts';
import { drawnTriangles, expectSame, joined } from './support/drawn-triangles.ts';
import { batches, bend, instances, type Made } from './support/made-objects.ts';
import { random } from './support/scattered.ts';

const VARIATIONS = 24;
const KINDS: Record<string, Made> = { InstancedMesh: instances, BatchedMesh: batches };

function instanced(object: Object3D): InstancedMesh | BatchedMesh {
  let found: Object3D | undefined;
  object.traverse((node) => {
    if (node instanceof InstancedMesh || node instanceof BatchedMesh) found = node;
  });
  return found as InstancedMesh | BatchedMesh;
}

/** By itself, where it is made. */
function alone(made: Group): Object3D {
  const mesh = instanced(made);
  mesh.removeFromParent();
  new Matrix4().decompose(mesh.position, mesh.quaternion, mesh.scale);
  return mesh;
}

/** What can be seen of an object: its nodes, whose children they are, and what each one has. */
function stateOf(object: Object3D): unknown[] {
  const state: unknown[] = [];
  object.traverse((node) => {
    const { geometry, material, count, morphTargetInfluences, boundingSphere } = node as InstancedMesh;
    state.push(node.uuid, node.parent?.uuid, node.children.length, node.layers.mask, node.visible, node.userData);
    state.push(geometry?.uuid, material, count, morphTargetInfluences && [...morphTargetInfluences], boundingSphere);
    if (node instanceof BatchedMesh)
      state.push(meshFromObject(node, { hidden: 'take' }).parts.map((part) => part.instance?.visible));
  });
  return state;
}

const ORDERS = [0, 1, 2].flatMap((a) => [0, 1, 2].filter((b) => b !== a).map((b) => [a, b, 3 - a - b]));

describe.each(Object.entries(KINDS))('%s', (_, make) => {
  it.each(['below an object', 'as the object itself'])(
    `%s: the last of three deformations that is alive is shown (${VARIATIONS} variations, seeds from 1)`,
    (where) => {
      for (let seed = 1; seed <= VARIATIONS; seed++) {
        const made = make(random(seed).number);
        const object = where === 'below an object' ? made : alone(made);
        const { mesh, parts } = meshFromObject(object);
        const present = meshFromObject(object, { morphs: 'present' }).mesh.positions as Float32Array;
        const before = stateOf(object);
        const shapes = [0, 1, 2].map((k) => bend(mesh.positions).map((x) => x + k));
        const shown = shapes.map(() => new DeformedGeometry(parts));
        for (const [k, shape] of shapes.entries()) shown[k]?.update(shape);
        const alive = new Set([0, 1, 2]);
        for (const k of ORDERS[seed % ORDERS.length] as number[]) {
          const shape = shapes[Math.max(...alive)] as Float32Array;
          const right = shape.map((x, i) => x + (present[i] as number) - (mesh.positions[i] as number));
          expectSame(drawnTriangles(object), joined(mesh.triangles, right));
          shown[k]?.dispose();
          alive.delete(k);
        }
        expect(stateOf(object)).toEqual(before);
      }
    },
  );

  it(`is moved and hidden by who holds it, with what is below it, while nothing else happens (${VARIATIONS} variations, seeds from 1)`, () => {
    for (let seed = 1; seed <= VARIATIONS; seed++) {
      const [made, same] = [make(random(seed).number), make(random(seed).number)];
      const scene = new Scene().add(made, new Mesh(new BoxGeometry(), new MeshBasicMaterial()));
      const originals = [instanced(made), instanced(same)];
      const place = random(seed + 100).numbers(3);
      const { mesh, parts } = meshFromObject(seed % 2 === 0 ? made : (originals[0] as Object3D));
      const shown = new DeformedGeometry(parts);
      shown.update(Float32Array.from(mesh.positions));
      const reference = new Scene().add(same, new Mesh(new BoxGeometry(), new MeshBasicMaterial()));
      for (const each of originals) {
        each.position.fromArray(place);
        each.rotation.y = place[0] as number;
        each.scale.x = -1.5;
      }
      expectSame(drawnTriangles(scene), drawnTriangles(reference));
      for (const each of originals) each.visible = false;
      expectSame(drawnTriangles(scene), drawnTriangles(reference));
      shown.dispose();
      for (const each of originals) each.visible = true;
      expectSame(drawnTriangles(scene), drawnTriangles(reference));
    }
  });

  it('that is the object itself leaves the scene when it is taken out', () => {
    const made = make(random(2).number);
    const [object, scene] = [alone(made), new Scene()];
    scene.add(object);
    const shown = new DeformedGeometry(meshFromObject(object).parts);
    scene.remove(object);
    expect(scene.children).toEqual([]);
    shown.dispose();
  });
});

describe('weights of morph targets that are an instance’s own', () => {
  it(`may change after a body was made of them (${VARIATIONS} variations, seeds from 1)`, () => {
    let steered = 0;
    for (let seed = 1; seed <= VARIATIONS; seed++) {
      const object = instances(random(seed).number);
      const mesh = instanced(object) as InstancedMesh;
      const { reading } = meshFromObject(object, { morphs: 'present' }).mesh;
      if (!mesh.morphTexture) continue;
      for (let i = 0; i < 3; i++) {
        const weights = new Mesh(mesh.geometry);
        weights.morphTargetInfluences = random(seed + i).numbers(2);
        mesh.setMorphAt(i, weights);
      }
      const right = drawnTriangles(object);
      const { mesh: read, parts } = meshFromObject(object, { reading: reading ?? {} });
      const shown = new DeformedGeometry(parts);
      shown.update(Float32Array.from(read.positions));
      expectSame(drawnTriangles(object), right);
      shown.dispose();
      steered++;
    }
    expect(steered).toBeGreaterThan(5);
  });
});

describe('what is not drawn of instances', () => {
  it('is read where hidden parts are asked for, and stays hidden', () => {
    for (let seed = 1; seed <= VARIATIONS; seed++) {
      const object = batches(random(seed).number);
      const before = drawnTriangles(object);
      const { mesh, parts } = meshFromObject(object, { hidden: 'take' });
      const shown = new DeformedGeometry(parts);
      shown.update(Float32Array.from(mesh.positions));
      expectSame(drawnTriangles(object), before);
      shown.dispose();
    }
  });

  it('may be a group without a material', () => {
    const geometry = new BoxGeometry(1, 1, 1);
    const mesh = new InstancedMesh(geometry, [], 2);
    (mesh.material as MeshBasicMaterial[])[1] = new MeshBasicMaterial();
    (mesh.material as unknown[])[2] = undefined;
    for (const i of [0, 1]) mesh.setMatrixAt(i, new Matrix4().setPosition(3 * i, 0, 0));
    mesh.setColorAt(0, new Color('red'));
    const object = new Group().add(mesh);
    const before = drawnTriangles(object);
    const { mesh: read, parts } = meshFromObject(object);
    const shown = new DeformedGeometry(parts);
    shown.update(Float32Array.from(read.positions));
    expectSame(drawnTriangles(object), before);
    shown.dispose();
    expect(drawnTriangles(object)).toEqual(before);
  });
});
