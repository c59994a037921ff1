import { expect, test } from 'vitest';
import { load } from '../../wasm/ts/index.ts';
import { boxMesh } from './support/shapes.ts';

/** As Vue's `reactive` does: every object that is read comes wrapped as well. */
function reactive<T extends object>(raw: T): T {
  return new Proxy(raw, {
    get(target, key, receiver) {
      const value = Reflect.get(target, key, receiver) as unknown;
      return typeof value === 'object' && value !== null && !ArrayBuffer.isView(value) ? reactive(value) : value;
    },
  });
}

test.each([
  ['plain', <T extends object>(raw: T) => new Proxy(raw, {})],
  ['deep', reactive],
])('all that the solver makes works behind a %s proxy', async (_, wrap) => {
  const hb = wrap(await load());
  const f = wrap(hb.rbf({ dimension: 1, points: [0, 1, 3], values: [2, 0, 1] }));
  expect(f.evaluate([0, 1, 3])[2]).toBeCloseTo(1);
  expect(f.report().centers).toBe(3);
  const space = wrap(hb.poseSpace({ dimensions: ['x'], examples: [{ name: 'a', at: [0], shape: [7] }] }));
  expect(Array.from(space.evaluate([0.3]))).toEqual([7]);
  const mesh = boxMesh([2, 1, 1], [4, 2, 2]);
  const irbf = wrap(hb.irbf(await hb.bake(mesh, { centers: 10, resolution: 16, spheres: 10 })));
  irbf.setHandles([{ vertex: 0 }]);
  irbf.targets[0] = (irbf.targets[0] as number) + 0.1;
  irbf.solve();
  irbf.deform(new Float32Array(mesh.positions.length));
  const second = wrap(irbf.share());
  second.setHandles([{ vertex: 1 }]);
  const skin = wrap(hb.linearBlend({ dimension: 2, positions: [0, 0, 1, 0], weights: [1, 0, 0, 1] }));
  expect(Array.from(skin.deform())).toEqual([0, 0, 1, 0]);
  const weights = wrap(hb.biharmonicWeights(mesh, [{ vertex: 0 }, { vertex: 7 }]));
  expect(weights.weights.length).toBe((2 * mesh.positions.length) / 3);
  for (const made of [f, space, irbf, second, skin, weights]) made.dispose();
  expect(() => f.evaluate([0])).toThrow(/disposed/);
  expect(hb.memory).toBeGreaterThan(0);
  expect(Object.keys(f)).not.toContain('evaluate');
  hb.dispose();
  expect(hb.usable).toBe(false);
});
