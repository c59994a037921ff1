// The short way of reading, for what most models are, gives to the last bit what the whole way gives; and what comes after has bounds that hold.
import {
  type Box3,
  DoubleSide,
  Group,
  LOD,
  Mesh,
  type Object3D,
  Raycaster,
  SkinnedMesh,
  type Sphere,
  Triangle,
  Vector3,
} from 'three';
import { describe, expect, it } from 'vitest';
import { DeformedGeometry, meshFromObject } from '../../web/three/index.ts';
import { plainObject } from '../../web/three/plain-object.ts';
import { trianglesOf } from './support/drawn-triangles.ts';
import * as made from './support/made-objects.ts';
import { random } from './support/scattered.ts';

const { bend, ...kinds } = made;
const SEEDS = Array.from({ length: 24 }, (_, i) => i + 1);

describe('the short way', () => {
  it('gives what the whole way gives (60 objects, seeds from 1)', () => {
    let far = 0;
    for (let seed = 1; seed <= 60; seed++) {
      const next = random(seed).number;
      const object = new Group().add(made.transforms(next), made.transforms(next));
      // Steered to nothing, drawn whole, named or not: plain all the same.
      for (const child of object.children) if (seed % 5 === 0) child.position.set(3e6 + next(), -2e6, 5e5 * next());
      if (seed % 10 === 0) object.children.pop();
      object.visible = seed % 2 === 0;
      object.position.set(1, 2, 3);
      const short = plainObject(object);
      const whole = meshFromObject(object, { onWarning: () => {} });
      expect(short?.mesh).toEqual(whole.mesh);
      expect(short?.normals).toEqual(whole.normals);
      expect(
        short?.parts.map(({ mesh, start, count, matrix, origin }) => [mesh, start, count, [...Array.from(matrix)], origin]),
      ).toEqual(whole.parts.map(({ mesh, start, count, matrix, origin }) => [mesh, start, count, [...Array.from(matrix)], origin]));
      if (whole.mesh.origin) far++;
    }
    expect(far).toBeGreaterThan(4);
  });

  it('is taken for nothing that is drawn otherwise (seeds 1 to 24)', () => {
    for (const [name, make] of Object.entries(kinds)) {
      if (name === 'transforms') continue;
      for (const seed of SEEDS) {
        const object = make(random(seed).number);
        const short = plainObject(object);
        if (short) expect(short.mesh).toEqual(meshFromObject(object, { onWarning: () => {} }).mesh);
        // A draw range may be the whole, and what is hidden may be nothing.
        else continue;
        expect(['drawRanges', 'hidden']).toContain(name);
      }
    }
  });
});

describe.each(Object.entries(kinds))('the bounds of deformed %s', (_, make) => {
  it('hold what is drawn, and a ray finds it (seeds 1 to 24)', () => {
    let hits = 0;
    for (const seed of SEEDS) {
      const object = make(random(seed).number);
      const { mesh, parts } = meshFromObject(object, { morphs: seed % 2 === 0 ? 'present' : 'rest' });
      const shown = new DeformedGeometry(parts);
      const away = random(seed + 9)
        .numbers(3)
        .map((x) => 20 * x);
      // three.js works out bounds when it first needs them: those of the shape at rest must not stay.
      object.updateMatrixWorld(true);
      const early = new Raycaster(new Vector3(0, 0, 50), new Vector3(0, 0, -1));
      object.traverseVisible((node) => early.intersectObject(withMaterials(node), false));
      shown.update(bend(mesh.positions).map((x, i) => 1.7 * x + (away[i % 3] as number)));
      object.updateMatrixWorld(true);
      object.traverseVisible((node) => {
        if (!(node instanceof Mesh) || node.parent instanceof LOD) return;
        const drawn = trianglesOf(node).map((triangle) => [0, 3, 6].map((k) => new Vector3().fromArray(triangle, k)));
        if (drawn.length === 0) return;
        const owner = node instanceof SkinnedMesh ? node : node.geometry;
        if (node instanceof SkinnedMesh) {
          node.computeBoundingBox();
          node.computeBoundingSphere();
        }
        const sphere = (owner.boundingSphere as Sphere).clone();
        const box = (owner.boundingBox as Box3).clone().expandByScalar(1e-5);
        sphere.radius += 1e-5;
        for (const corner of drawn.flat()) {
          const local = node.worldToLocal(corner.clone());
          expect([box.containsPoint(local), sphere.containsPoint(local)]).toEqual([true, true]);
        }
        const [a, b, c] = (drawn[0] ?? []) as [Vector3, Vector3, Vector3];
        if (!a || new Triangle(a, b, c).getArea() < 1e-3) return;
        const middle = a.clone().add(b).add(c).divideScalar(3);
        // three.js' sphere in the world is too small below shearing parents: what it misses then is its own.
        if (!sphere.applyMatrix4(node.matrixWorld).containsPoint(middle)) return;
        const normal = new Triangle(a, b, c).getNormal(new Vector3());
        const ray = new Raycaster(middle.clone().addScaledVector(normal, 1e-3), normal.clone().negate(), 0, 0.1);
        hits++;
        expect(shown.pick(ray)?.point.distanceTo(middle)).toBeLessThan(1e-2);
      });
      shown.dispose();
    }
    expect(hits).toBeGreaterThan(10);
  });
});

/** Seen from both sides, and without gaps, on which three.js' raycasts fail. */
function withMaterials(node: Object3D): Object3D {
  if (!(node instanceof Mesh)) return node;
  for (const each of [node.material].flat()) if (each) each.side = DoubleSide;
  return Array.isArray(node.material) ? new Group() : node;
}
