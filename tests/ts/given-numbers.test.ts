/** Numbers that methods are given: those that threads share are read, and those that are gone are refused by their name. */
import { describe, expect, test } from 'vitest';
import { load, type TypedArray } from '../../wasm/ts/index.ts';
import { boxMesh } from './support/shapes.ts';

const hb = await load();
const box = boxMesh([2, 1, 1], [4, 2, 2]);
const body = await hb.bake(box, { centers: 8, resolution: 16, spheres: 6 });
const irbf = hb.irbf(body);
irbf.setHandles([{ vertex: 0 }, { vertex: 30 }]);
irbf.solve();
const f = hb.rbf({ dimension: 2, points: [0, 0, 1, 0.1, 0.2, 1, 1.1, 0.9], values: [1, 2, 3, 5], onWarning: () => {} });
const space = hb.poseSpace({ dimensions: ['u'], examples: [0, 1].map((u) => ({ name: `${u}`, at: [u], shape: [u] })) });
const solid = hb.tetrahedralize(box, { resolution: 4 });
const flat = {
  dimension: 2 as const,
  positions: [0, 0, 1, 0, 2, 0, 0, 1, 1, 1, 2, 1],
  triangles: [0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4],
};
const weights = hb.biharmonicWeights(flat, [{ vertex: 0 }, { vertex: 5 }]);
/** Methods: what their numbers are called, such numbers, and what comes of them. */
const METHODS: Record<string, [name: string, numbers: TypedArray, run: (numbers: TypedArray) => unknown]> = {
  'Interpolant.evaluate': ['queries', Float64Array.of(0.4, 0.5, 0.7, 0.2), (given) => f.evaluate(given)],
  'Interpolant.gradient': ['queries', Float64Array.of(0.4, 0.5, 0.7, 0.2), (given) => f.gradient(given)],
  'Interpolant.weights': ['queries', Float64Array.of(0.4, 0.5, 0.7, 0.2), (given) => f.weights(given)],
  'Irbf.evaluate': ['points', Float64Array.of(1, 0.5, 0.5), (given) => irbf.evaluate(given)],
  'Irbf.report': ['tetrahedra', Uint32Array.of(0, 1, 5, 12), (given) => irbf.report(given)],
  'Irbf.setRestNormals': [
    'normals',
    Float32Array.from(box.positions, (_, i) => (i % 3 === 1 ? 1 : 0)),
    (given) => {
      const [out, turned] = [new Float32Array(given.length), new Float32Array(given.length)];
      irbf.setRestNormals(given);
      irbf.deform(out, turned);
      return [out, turned];
    },
  ],
  'Irbf.setHandles': [
    'at',
    Float64Array.of(1, 0.5, 0.5),
    (given) => {
      irbf.setHandles([{ vertex: 0 }, { at: given as never }]);
      return irbf.targets.slice();
    },
  ],
  'PoseSpace.weights': ['at', Float64Array.of(0.25), (given) => space.weights(given)],
  'PoseSpace.evaluate': ['at', Float64Array.of(0.25), (given) => space.evaluate(given)],
  'Tetrahedra.sample': ['values', Float64Array.from(solid.positions), (given) => solid.sample(given)],
  'BiharmonicWeights.setHandles': [
    'vertices',
    Uint32Array.of(4, 5),
    (given) => {
      weights.setHandles([{ vertex: 0 }, { vertices: given }]);
      return weights.weights.slice();
    },
  ],
};

describe.each(Object.keys(METHODS))('%s', (name) => {
  const [called, numbers, run] = METHODS[name] as (typeof METHODS)[string];

  test('numbers that threads share give the same', () => {
    const Kind = numbers.constructor as Float64ArrayConstructor;
    const shared = new Kind(new SharedArrayBuffer(numbers.byteLength) as unknown as ArrayBuffer);
    shared.set(numbers);
    expect(run(shared)).toEqual(run(numbers));
  });

  test('numbers that were handed over are refused by their name', () => {
    const gone = numbers.slice();
    structuredClone(null, { transfer: [gone.buffer as ArrayBuffer] });
    expect(() => run(gone)).toThrow(
      expect.objectContaining({
        name: 'HandlebodyError',
        message: expect.stringMatching(new RegExp(`"[^"]*${called}" was handed to another thread`)),
      }),
    );
  });
});
