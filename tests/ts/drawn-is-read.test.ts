// What three.js draws is what is read, and what is deformed is drawn once, in its place; three.js' own reckoning is the measure.
import { BatchedMesh, type Group, InstancedMesh, Mesh, type Object3D } from 'three';
import { describe, expect, it } from 'vitest';
import type { SceneWarning } from '../../web/assets/scene-choices.ts';
import { DeformedGeometry, meshFromObject } from '../../web/three/index.ts';
import { drawnTriangles, expectSame, joined } from './support/drawn-triangles.ts';
import * as made from './support/made-objects.ts';
import { random } from './support/scattered.ts';

const { bend, ...kinds } = made;
const VARIATIONS = 24;

describe.each(Object.entries(kinds))('%s', (_, make) => {
  const each = (work: (object: Group, seed: number) => void) => {
    for (let seed = 1; seed <= VARIATIONS; seed++) work(make(random(seed).number), seed);
  };

  it(`are read as three.js draws them (${VARIATIONS} variations, seeds from 1)`, () => {
    each((object) => {
      const right = drawnTriangles(object);
      const { mesh } = meshFromObject(object, { morphs: 'present' });
      expectSame(joined(mesh.triangles, mesh.positions), right);
    });
  });

  it(`are shown deformed, once, and are as they were afterwards (${VARIATIONS} variations, seeds from 1)`, () => {
    each((object, seed) => {
      const before = drawnTriangles(object);
      const tree: Object3D[] = [];
      object.traverse((node) => tree.push(node));
      const { mesh, parts } = meshFromObject(object, { morphs: seed % 2 === 0 ? 'present' : 'rest' });
      const present = meshFromObject(object, { morphs: 'present' }).mesh;
      const deformed = new DeformedGeometry(parts);
      const bent = bend(mesh.positions);
      deformed.update(bent, undefined);
      // What the morph targets add at rest comes on top of a body that was read without it.
      const expected = bent.map(
        (x, i) => x + (seed % 2 === 0 ? 0 : (present.positions[i] as number) - (mesh.positions[i] as number)),
      );
      expectSame(drawnTriangles(object), joined(mesh.triangles, expected));
      let plain = 0;
      object.traverse((node) => {
        if (node instanceof InstancedMesh || node instanceof BatchedMesh) plain--;
      });
      expect(plain).toBe(0);
      deformed.dispose();
      expect(drawnTriangles(object)).toEqual(before);
      const after: Object3D[] = [];
      object.traverse((node) => after.push(node));
      expect(after).toEqual(tree);
    });
  });

  it(`keep their numbers when a face is steered and parts are hidden later (${VARIATIONS} variations, seeds from 1)`, () => {
    each((object) => {
      const { mesh } = meshFromObject(object, { morphs: 'present' });
      object.traverse((node) => {
        if (node instanceof Mesh && node.morphTargetInfluences && !(node instanceof InstancedMesh))
          node.morphTargetInfluences.fill(0.7);
        if (node !== object && !(node.parent && 'isLOD' in node.parent)) node.visible = !node.visible;
      });
      const again = meshFromObject(object, { reading: mesh.reading ?? {} }).mesh;
      expect(again.positions).toEqual(mesh.positions);
    });
  });
});

describe('warnings', () => {
  const warningsOf = (object: Object3D) => {
    const warnings: SceneWarning[] = [];
    meshFromObject(object, { onWarning: (warning) => warnings.push(warning) });
    return warnings;
  };

  it('name a mesh whose morph targets have weights', () => {
    const object = made.morphs(random(3).number);
    expect(warningsOf(object).map(({ code }) => code)).toEqual(['morphs-at-rest']);
    expect(warningsOf(made.transforms(random(3).number))).toEqual([]);
  });
});
