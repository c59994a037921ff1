/** Handles are where their vertices are seen, and take them where the hand goes, whatever carries those through the scene. */
import { Group, type Mesh, type Object3D, PerspectiveCamera, type SkinnedMesh, Vector3 } from 'three';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { type BodyData, type Handlebody, load } from '../../wasm/ts/index.ts';
import { type Draggable, draggable, meshFromObject } from '../../web/three/index.ts';
import { FakeElement, fakeDocument } from './support/fake-element.ts';
import { crossed, meshesOf, single, skinned } from './support/objects.ts';

let hb: Handlebody;
let restore: () => void;
const bodies = new Map<() => Group, BodyData>();
beforeAll(async () => {
  restore = fakeDocument();
  hb = await load();
  for (const make of [single, crossed, skinned])
    bodies.set(make, await hb.bake(meshFromObject(make()).mesh, { centers: 30, resolution: 24, spheres: 4 }));
});
afterAll(() => restore());

interface Scene {
  readonly make: () => Group;
  /** Of which the body is made: the group, or a mesh in it. */
  readonly object?: (made: Group) => Object3D;
  /** After the handles have come. */
  readonly pose: (made: Group) => void;
}

const away = (object: Object3D) => {
  object.position.set(0.5, -0.3, 0.4);
  object.rotation.set(0.4, 1, -0.2);
  object.scale.set(1.5, 1.5, 1.5);
};

const SCENES: Record<string, Scene> = {
  'at the origin': { make: single, pose: () => {} },
  'moved, turned and scaled': { make: single, pose: away },
  'below groups that are turned and scaled unevenly': {
    make: single,
    pose: (made) => {
      away(made);
      const [outer, inner] = [new Group(), new Group()];
      outer.scale.set(1.2, 0.7, -1);
      inner.rotation.set(0.5, -0.3, 0.8);
      inner.position.set(0.2, 0.1, 0);
      outer.add(inner.add(made));
    },
  },
  'a mesh of its own that is moved': {
    make: single,
    object: (made) => made.children[0] as Mesh,
    pose: ({ children }) => away(children[0] as Mesh),
  },
  'several meshes, of which one is moved later': {
    make: crossed,
    pose: (made) => {
      away(made);
      made.children[1]?.position.set(-0.4, 0.3, 0.2);
    },
  },
  'skinned, at rest': { make: skinned, pose: away },
  'skinned, with its bones bent': {
    make: skinned,
    pose: (made) => {
      away(made);
      for (const bone of (made.children[0] as SkinnedMesh).skeleton.bones) bone.rotation.set(0.2, 0.3, 0.7);
    },
  },
  'skinned, by itself': { make: skinned, object: (made) => made.children[0] as Mesh, pose: away },
};

function setUp({ make, object: find, pose }: Scene, handles: readonly { vertex: number }[]) {
  const made = make();
  const object = find?.(made) ?? made;
  const camera = new PerspectiveCamera(40, 1, 0.1, 50);
  camera.position.set(1, 2, 7);
  camera.lookAt(0, 0, 0);
  camera.updateMatrixWorld();
  const container = new FakeElement();
  const baked = find === undefined || make === skinned ? (bodies.get(make) as BodyData) : (bodies.get(single) as BodyData);
  const drag = draggable(object, baked, { hb, camera, container: container as unknown as HTMLElement, handles });
  pose(made);
  return { drag, object, camera };
}

function settle(drag: Draggable): void {
  for (let i = 0; i < 400 && drag.update(); i++);
}

/** Where three.js shows a vertex, in the world. */
function seen(object: Object3D, vertex: number): Vector3 {
  for (let root: Object3D | null = object; root; root = root.parent) if (!root.parent) root.updateMatrixWorld(true);
  let start = 0;
  for (const mesh of meshesOf(object)) {
    const { count } = mesh.geometry.getAttribute('position');
    if (vertex < start + count) return mesh.localToWorld(mesh.getVertexPosition(vertex - start, new Vector3()));
    start += count;
  }
  throw new Error(`there is no vertex ${vertex}`);
}

/** Where a handle stands, in parts of the view. */
function shown(drag: Draggable, i: number): [number, number] {
  const { left, top } = drag.overlay.element(i)?.style ?? {};
  return [Number.parseFloat(left ?? '') / 100, Number.parseFloat(top ?? '') / 100];
}

describe.each(Object.entries(SCENES))('an object %s', (_, scene) => {
  const last = scene.make === crossed ? 160 : 60;
  const handles = [{ vertex: 0 }, { vertex: 30 }, { vertex: last }];

  it('has its handles where their vertices are seen, at rest and pulled', () => {
    const { drag, object, camera } = setUp(scene, handles);
    const check = () => {
      for (const [i, { vertex }] of handles.entries()) {
        const at = seen(object, vertex).project(camera);
        const [x, y] = shown(drag, i);
        expect(x).toBeCloseTo((1 + at.x) / 2, 2);
        expect(y).toBeCloseTo((1 - at.y) / 2, 2);
      }
    };
    settle(drag);
    check();
    drag.setTarget(2, drag.target(2).add(new Vector3(0.1, 0.15, -0.05)));
    settle(drag);
    check();
    drag.dispose();
  });

  it.each(['ArrowRight', 'PageUp', '+'])('takes a vertex along by the key %s, as the view has it', (key) => {
    const { drag, object, camera } = setUp(scene, handles);
    settle(drag);
    const before = seen(object, last);
    const step = drag.overlay.step * (key === 'PageUp' ? 10 : 1);
    const element = drag.overlay.element(2) as unknown as FakeElement;
    element.dispatchEvent(Object.assign(new Event('keydown'), { key }));
    settle(drag);
    const axis = ['ArrowRight', 'PageUp', '+'].indexOf(key);
    const expected = new Vector3().setFromMatrixColumn(camera.matrixWorld, axis).normalize().multiplyScalar(step);
    const moved = seen(object, last).sub(before);
    expect(moved.distanceTo(expected)).toBeLessThan(0.1 * step);
    drag.dispose();
  });

  it('tells the vertex that is seen where a pointer is', () => {
    const { drag, object, camera } = setUp(scene, handles);
    drag.setTarget(2, drag.target(2).add(new Vector3(0.2, 0.2, 0)));
    settle(drag);
    let found = 0;
    for (let vertex = 0; vertex < drag.positions.length / 3; vertex++) {
      const world = seen(object, vertex);
      const at = world.clone().project(camera);
      const hit = drag.pick({ clientX: 50 * (1 + at.x), clientY: 50 * (1 - at.y) });
      // Only what faces the viewer is hit there.
      if (!hit || hit.point.distanceTo(world) > 0.02) continue;
      found++;
      expect(seen(object, hit.vertex).distanceTo(world)).toBeLessThan(1e-3);
    }
    expect(found).toBeGreaterThan(20);
    expect(drag.pick({ clientX: 0, clientY: 0 })).toBeUndefined();
    drag.dispose();
  });
});

describe('a handle inside', () => {
  it('goes with the vertex next to it, and so with the bones', () => {
    const { drag, object, camera } = setUp(SCENES['skinned, with its bones bent'] as Scene, [{ vertex: 0 }]);
    const { positions } = (bodies.get(skinned) as BodyData).mesh;
    // The middle of the upper half.
    const high = [...positions.keys()].filter((i) => i % 3 === 1 && (positions[i] as number) > 0.6);
    const middle = [0, 1, 2].map((axis) => high.reduce((sum, i) => sum + (positions[i - 1 + axis] as number), 0) / high.length) as [
      number,
      number,
      number,
    ];
    drag.setHandles([{ at: middle }]);
    settle(drag);
    const around = high.map((i) => seen(object, (i - 1) / 3));
    const center = around.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(around.length);
    const at = center.project(camera);
    expect(Math.hypot(shown(drag, 0)[0] - (1 + at.x) / 2, shown(drag, 0)[1] - (1 - at.y) / 2)).toBeLessThan(0.03);
    drag.dispose();
  });

  it('stays where an object is scaled to nothing', () => {
    const { drag, object } = setUp(SCENES['at the origin'] as Scene, [{ vertex: 0 }]);
    settle(drag);
    const before = drag.target(0);
    object.scale.setScalar(0);
    (drag.overlay.element(0) as unknown as FakeElement).dispatchEvent(Object.assign(new Event('keydown'), { key: 'ArrowRight' }));
    expect(drag.target(0)).toEqual(before);
    drag.dispose();
  });
});
