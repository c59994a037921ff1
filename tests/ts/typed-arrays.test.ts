import { expect, it } from 'vitest';
import { load, type TypedArray } from '../../wasm/ts/index.ts';
import { boxMesh } from './support/shapes.ts';

const KINDS = [
  Int8Array,
  Uint8Array,
  Uint8ClampedArray,
  Int16Array,
  Uint16Array,
  Int32Array,
  Uint32Array,
  Float32Array,
  Float64Array,
];

it.each(KINDS.map((kind) => [kind.name, kind] as const))('numbers in a %s are numbers', async (_, kind) => {
  const hb = await load();
  const points = kind.from([0, 1, 2]);
  expect(hb.shepard({ dimension: 1, points, values: kind.from([3, 5, 4]) }).evaluate(points)).toEqual(Float64Array.of(3, 5, 4));
  const { positions, triangles } = boxMesh([4, 4, 4], [2, 2, 2]);
  const whole = kind.from(Array.from(positions, (x) => Math.round(x) + 2));
  const body = await hb.bake({ positions: whole, triangles: kind.from(Array.from(triangles)) }, { resolution: 16, centers: 4 });
  expect(body.centers).toHaveLength(4);
});

it.each(KINDS.map((kind) => [kind.name, kind] as const))(
  'a %s takes results where it holds fractions, else is refused',
  async (_, kind) => {
    const hb = await load();
    const f = hb.shepard({ dimension: 1, points: [0, 1], values: [0, 1] });
    const out: TypedArray = new kind(1);
    if (kind === Float32Array || kind === Float64Array) expect(f.evaluate([0.5], out)[0]).toBe(0.5);
    else expect(() => f.evaluate([0.5], out)).toThrow(new RegExp(`is an? ${kind.name} of 1`));
  },
);
