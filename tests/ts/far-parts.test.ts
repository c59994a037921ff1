// Far places in a scene: what is drawn alone says where an origin lies and which floats have lost their shape, and what was read is found again.
import { BoxGeometry, BufferAttribute, BufferGeometry, Group, Mesh, MeshBasicMaterial, MeshStandardMaterial, Texture } from 'three';
import { describe, expect, it } from 'vitest';
import type { SceneWarning } from '../../web/assets/scene-choices.ts';
import { meshFromObject } from '../../web/three/index.ts';
import { random } from './support/scattered.ts';

const SEEDS = Array.from({ length: 24 }, (_, i) => i + 1);

const warningsOf = (object: Group): SceneWarning[] => {
  const warnings: SceneWarning[] = [];
  meshFromObject(object, { onWarning: (warning) => warnings.push(warning) });
  return warnings;
};

/** A box of some size in floats about a place, and vertices that nothing uses. */
function boxAbout(place: readonly number[], size: number, strays: readonly number[] = []): BufferGeometry {
  const box = new BoxGeometry(size, size, size);
  const positions = Float32Array.from([...box.getAttribute('position').array, ...strays], (x, i) =>
    i < 72 ? x + (place[i % 3] as number) : x,
  );
  return new BufferGeometry().setAttribute('position', new BufferAttribute(positions, 3)).setIndex(box.index);
}

const meshOf = (geometry: BufferGeometry, name = '') => Object.assign(new Mesh(geometry, new MeshBasicMaterial()), { name });

describe('floats that have lost a shape', () => {
  it('are told of whatever else is stored and not drawn (seeds 1 to 24)', () => {
    for (const seed of SEEDS) {
      const { number } = random(seed);
      const size = 0.5 + Math.abs(number());
      const far = 2000 + 1e6 * Math.abs(number());
      const stray = seed % 2 === 0 ? [Number.NaN, 0, 0] : [0, 0, 0];
      const axis = seed % 3;
      const place = [0, 1, 2].map((k) => (k === axis ? far * size * 2 : 0));
      const codes = (strays: number[]) =>
        warningsOf(new Group().add(meshOf(boxAbout(place, size, strays)))).map(({ code }) => code);
      expect([codes([]), codes(stray)]).toEqual([['positions-coarse'], ['positions-coarse']]);
      // The other way round: nothing far is drawn.
      expect(warningsOf(new Group().add(meshOf(boxAbout([0, 0, 0], size, place))))).toEqual([]);
    }
  });

  it('since the parts lie far from one another, name the small one (seeds 1 to 24)', () => {
    for (const seed of SEEDS) {
      const { number } = random(seed);
      const size = 0.01 + Math.abs(number());
      const diagonals = seed % 2 === 0 ? 2e5 * (1.1 + Math.abs(number())) : 5e4 * (0.1 + Math.abs(number()));
      const [near, far] = [meshOf(boxAbout([0, 0, 0], 1), 'near'), meshOf(boxAbout([0, 0, 0], size), 'far')];
      far.position.setComponent(seed % 3, diagonals * size * Math.sqrt(3));
      const told = warningsOf(new Group().add(near, far));
      expect(told.map(({ code }) => code)).toEqual(seed % 2 === 0 ? ['positions-coarse'] : []);
      // All of it at one place, where it has no shape.
      far.geometry.scale(0, 0, 0);
      expect(warningsOf(new Group().add(near, far))).toEqual([]);
      if (seed % 2 === 0) expect(told[0]?.message).toMatch(/: "far"\.$/);
    }
  });
});

describe('an origin', () => {
  it('stays that of the first reading, whatever is drawn since (seeds 1 to 24)', () => {
    for (const seed of SEEDS) {
      const { number, numbers } = random(seed);
      const geometry = new BoxGeometry(1, 1, 1, 3, 3, 3);
      geometry.scale(1 + Math.abs(number()), 1, 1);
      const materials = Array.from({ length: 6 }, () => new MeshBasicMaterial({ visible: number() > -0.3 }));
      (materials[seed % 6] as MeshBasicMaterial).visible = true;
      const mesh = new Mesh(geometry, materials);
      mesh.position.fromArray(numbers(3)).multiplyScalar(1e6).addScalar(3e6);
      const object = new Group().add(mesh);
      const { mesh: first } = meshFromObject(object);
      expect(first.origin).toBeDefined();
      for (const material of materials) material.visible = number() > 0;
      geometry.setDrawRange(6 * (seed % 3), 30);
      const again = meshFromObject(object, { reading: JSON.parse(JSON.stringify(first.reading)) }).mesh;
      expect(again.origin).toEqual(first.origin);
      expect(again.positions).toEqual(first.positions);
      // Without materials to hide it is read the short way, which keeps it too.
      (mesh as Mesh).material = new MeshBasicMaterial();
      geometry.setDrawRange(0, Number.POSITIVE_INFINITY);
      expect(meshFromObject(object, { reading: first.reading }).mesh.positions).toEqual(first.positions);
    }
  });
});

describe('relief by a displacement map', () => {
  it('is named in a warning, where it is drawn', () => {
    const relief = () => new MeshStandardMaterial({ displacementMap: new Texture() });
    const standing = new Group().add(
      Object.assign(new Mesh(new BoxGeometry(), relief()), { name: 'wall' }),
      new Mesh(new BoxGeometry(), [relief()]),
      new Mesh(new BoxGeometry(), Object.assign(relief(), { displacementScale: 0 })),
      Object.assign(new Mesh(new BoxGeometry(), relief()), { visible: false }),
      new Mesh(new BoxGeometry(), new MeshStandardMaterial()),
    );
    const warnings = warningsOf(standing);
    expect(warnings.map(({ code }) => code)).toEqual(['left-out']);
    expect(warnings[0]?.message).toBe("What displacement maps add was left out: 2 of the object's parts (wall).");
  });
});
