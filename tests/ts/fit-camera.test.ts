// What a page's camera goes by is what is drawn: not what nothing uses, what is hidden, or what is stored before bones move it.
import {
  BufferAttribute,
  BufferGeometry,
  Group,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  PerspectiveCamera,
  Points,
  SphereGeometry,
  Vector3,
} from 'three';
import { describe, expect, it } from 'vitest';
import { drawnOf, fitCamera } from '../../web/stage/fit-camera.ts';
import { drawnTriangles } from './support/drawn-triangles.ts';
import { morphs, skins, transforms } from './support/made-objects.ts';
import { meshesOf } from './support/objects.ts';
import { random } from './support/scattered.ts';

const SEEDS = Array.from({ length: 20 }, (_, i) => i + 1);

/** Adds what is not drawn, of all kinds. */
function clutter(object: Object3D, seed: number): void {
  const { numbers, number } = random(seed);
  for (const mesh of meshesOf(object)) {
    const { geometry } = mesh;
    const count = geometry.getAttribute('position').count;
    if (!geometry.index) geometry.setIndex([...Array(count).keys()]);
    const stray = [...numbers(3).map((x) => 1e5 * x), ...(seed % 2 === 0 ? [Number.NaN, 0, 0] : [])];
    for (const attribute of [geometry, ...(geometry.morphAttributes.position ?? [])]) {
      const stored = attribute === geometry ? geometry.getAttribute('position') : (attribute as BufferAttribute);
      const longer = new BufferAttribute(Float32Array.from([...stored.array, ...stray]), 3);
      if (attribute === geometry) geometry.setAttribute('position', longer);
      else
        geometry.morphAttributes.position =
          geometry.morphAttributes.position?.map((each) => (each === attribute ? longer : each)) ?? [];
    }
    for (const name of ['skinIndex', 'skinWeight']) {
      const stored = geometry.getAttribute(name);
      if (!stored) continue;
      const Numbers = stored.array.constructor as Float32ArrayConstructor;
      geometry.setAttribute(name, new BufferAttribute(Numbers.from([...stored.array, ...new Array(8).fill(0)]), 4));
    }
    geometry.boundingBox = geometry.boundingSphere = null;
  }
  const hidden = new Mesh(new SphereGeometry(50), new MeshBasicMaterial());
  hidden.visible = false;
  object.add(hidden);
  const rest = new SphereGeometry(1, 40, 20);
  rest.translate(1000 * number(), 0, 0);
  rest.setDrawRange(0, 0);
  object.add(new Mesh(rest, new MeshBasicMaterial()));
}

describe.each(Object.entries({ transforms, morphs, skins }))('%s', (_, make) => {
  it('fill the view whatever is beside what is drawn (seeds 1 to 20)', () => {
    for (const seed of SEEDS) {
      const [object, cluttered] = [make(random(seed).number), make(random(seed).number)];
      clutter(cluttered, seed);
      const drawn = drawnTriangles(object).flatMap((triangle) => [0, 3, 6].map((k) => new Vector3().fromArray(triangle, k)));
      const { box, outline } = drawnOf(cluttered);
      const along = (axis: number) => drawn.map((place) => place.getComponent(axis));
      for (const axis of [0, 1, 2]) {
        expect(box.min.getComponent(axis)).toBeCloseTo(Math.min(...along(axis)), 5);
        expect(box.max.getComponent(axis)).toBeCloseTo(Math.max(...along(axis)), 5);
      }
      const camera = new PerspectiveCamera(40, 1.5, 0.01, 1e4);
      const center = box.getCenter(new Vector3());
      const { position, target } = fitCamera(outline, center, new Vector3(0.6, 0, 0.8), camera);
      camera.position.copy(position);
      camera.lookAt(target);
      camera.updateMatrixWorld();
      const seen = drawn.flatMap((place) => place.clone().project(camera).toArray().slice(0, 2));
      const most = Math.max(...seen.map(Math.abs));
      expect(most).toBeGreaterThan(0.6);
      expect(most).toBeLessThan(0.8);
    }
  });
});

it('a cloud of points fills the view as well', () => {
  const positions = Float32Array.from(random(3).numbers(300));
  const cloud = new Points(new BufferGeometry().setAttribute('position', new BufferAttribute(positions, 3)));
  expect(drawnOf(new Group().add(cloud)).outline).toHaveLength(100);
});
