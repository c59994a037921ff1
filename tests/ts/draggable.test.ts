/** A baked model under handles in three.js: spaces, refusals, and what is left behind. */
import { Group, Mesh, MeshBasicMaterial, PerspectiveCamera, Vector3 } from 'three';
import { CapsuleGeometry } from 'three/src/geometries/CapsuleGeometry.js';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import type { BodyData, Handlebody } from '../../wasm/ts/index.ts';
import { load } from '../../wasm/ts/index.ts';
import { draggable, meshFromObject } from '../../web/three/index.ts';
import { FakeElement, fakeDocument } from './support/fake-element.ts';
import { single as model } from './support/objects.ts';

let hb: Handlebody;
let body: BodyData;

let restore: () => void;

beforeAll(async () => {
  restore = fakeDocument();
  hb = await load();
  body = await hb.bake(meshFromObject(model()).mesh, { centers: 30, resolution: 24, spheres: 4 });
});

afterAll(() => restore());

function make(object = model()) {
  const camera = new PerspectiveCamera(40, 1, 0.1, 50);
  camera.position.set(0, 0, 6);
  camera.updateMatrixWorld();
  return draggable(object, body, { hb, camera, container: new FakeElement() as unknown as HTMLElement });
}

/** Until it has settled. */
function settle(drag: ReturnType<typeof make>): void {
  for (let i = 0; i < 400 && drag.update(); i++);
}

describe('draggable', () => {
  it('spreads six handles over the body, and follows the one that is moved', () => {
    const drag = make();
    expect(drag.handles.length).toBe(6);
    const { vertex } = drag.handles[0] as { vertex: number };
    const to = drag.target(0).add(new Vector3(0.2, 0.1, 0));
    drag.setTarget(0, to);
    settle(drag);
    expect(drag.vertex(vertex).distanceTo(to)).toBeLessThan(0.01);
    expect(drag.overlay.description(0)).toMatch(/^moved by \d/);
    drag.reset();
    settle(drag);
    expect(drag.vertex(vertex).distanceTo(new Vector3().fromArray(body.mesh.positions, 3 * vertex))).toBeLessThan(0.01);
    expect(drag.overlay.description(0)).toBe('at rest');
    drag.dispose();
  });

  it('takes targets in the object’s space, wherever the object stands', () => {
    const [here, there] = [model(), model()];
    there.position.set(3, -2, 1);
    there.rotation.set(0.4, 1, -0.2);
    there.scale.setScalar(2.5);
    there.updateMatrixWorld();
    const drags = [make(here), make(there)];
    for (const drag of drags) {
      drag.setTarget(1, drag.target(1).add(new Vector3(0.1, 0, 0.1)));
      settle(drag);
    }
    expect(drags[1]?.positions).toEqual(drags[0]?.positions);
    for (const each of drags) each.dispose();
  });

  it('refuses a body of another mesh, and handles that lie outside; the former ones stay', () => {
    const other = new Group().add(new Mesh(new CapsuleGeometry(0.4, 1, 4, 12), new MeshBasicMaterial()));
    expect(() => make(other)).toThrow(/another mesh/);
    const drag = make();
    expect(() => drag.setHandles([{ at: [9, 9, 9] }])).toThrow();
    expect(drag.handles.length).toBe(6);
    settle(drag);
    drag.dispose();
  });

  it('adds a handle where its point is now, and the others keep their targets; or leaves all as it was', () => {
    const drag = make();
    drag.setTarget(0, drag.target(0).add(new Vector3(0.3, 0.1, 0)));
    settle(drag);
    const [to, before] = [drag.target(0), drag.vertex(70)];
    expect(before.distanceTo(new Vector3().fromArray(body.mesh.positions, 3 * 70))).toBeGreaterThan(0.02);
    drag.addHandle({ vertex: 70, name: 'Side' });
    settle(drag);
    expect([drag.handles.length, drag.overlay.count]).toEqual([7, 7]);
    expect(drag.target(0)).toEqual(to);
    expect(drag.target(6).distanceTo(before)).toBeLessThan(1e-6);
    expect(drag.vertex(70).distanceTo(before)).toBeLessThan(0.01);

    drag.addHandle({ at: [0, 0.1, 0] });
    settle(drag);
    expect(drag.target(7).distanceTo(new Vector3(0, 0.1, 0))).toBeGreaterThan(0.001);
    for (const refused of [{ at: [9, 9, 9] as const }, { vertex: 1e6 }]) {
      expect(() => drag.addHandle(refused)).toThrow(expect.objectContaining({ name: 'HandlebodyError' }));
      expect(drag.handles.length).toBe(8);
      expect(drag.target(0)).toEqual(to);
    }
    drag.reset();
    settle(drag);
    expect(drag.vertex(70).distanceTo(new Vector3().fromArray(body.mesh.positions, 3 * 70))).toBeLessThan(0.01);
    drag.dispose();
  });

  it('puts the object’s geometry back, and gives back the solver’s memory', () => {
    const object = model();
    const [mesh] = object.children as [Mesh];
    const { geometry } = mesh;
    const memory: number[] = [];
    for (let i = 0; i < 20; i++) {
      const drag = make(object);
      expect(mesh.geometry).not.toBe(geometry);
      drag.dispose();
      drag.dispose();
      expect(mesh.geometry).toBe(geometry);
      memory.push(hb.memory);
    }
    expect(memory.at(-1)).toBe(memory[4]);
  });

  it('moves a handle by a key before anything was placed from where its point is', () => {
    const object = model();
    object.position.set(3, -2, 1);
    const drag = make(object);
    const from = drag.target(2);
    const key = Object.assign(new Event('keydown', { cancelable: true }), { key: 'ArrowUp' });
    drag.overlay.element(2)?.dispatchEvent(key);
    const by = drag.target(2).distanceTo(from) / body.normalization.diagonal;
    expect(by).toBeGreaterThan(0);
    expect(by).toBeLessThan(0.02);
    drag.dispose();
  });

  it('shares a body among the copies on a page, whichever goes first', () => {
    const [first, second] = [make(), make()];
    first.setTarget(0, first.target(0).add(new Vector3(0, 0.2, 0)));
    settle(first);
    settle(second);
    const rest = second.vertex(0).clone();
    first.dispose();
    const third = make();
    second.dispose();
    settle(third);
    expect(third.vertex(0).distanceTo(rest)).toBeLessThan(1e-6);
    third.setTarget(0, third.target(0).add(new Vector3(0, 0.2, 0)));
    settle(third);
    expect(third.vertex(0).distanceTo(rest)).toBeGreaterThan(1e-3);
    third.dispose();
  });
});
