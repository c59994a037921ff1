/** Target shapes of spheres (paper 001, §2.4, eq. (11)), and spheres that may grow (§4.5). */
import { beforeAll, describe, expect, it } from 'vitest';
import { type BodyData, type Handlebody, HandlebodyError, type Irbf, type IrbfOptions, load } from '../../wasm/ts/index.ts';
import { readDog } from './support/dog.ts';
import { boxMesh, enclosedVolume } from './support/shapes.ts';

/** Spheres that count for more than smoothness, as shapes need it. */
/** Kernels no wider than a sphere, for shapes of one; all else as by default. */
const LOCAL = { relativeWidth: 2 } as const;
const IDENTITY = [1, 0, 0, 0, 1, 0, 0, 0, 1];

let hb: Handlebody;
let bar: BodyData;

beforeAll(async () => {
  hb = await load();
  bar = await hb.bake(boxMesh([10, 2, 2], [30, 6, 6]), { centers: 80, resolution: 48, spheres: 9 });
});

/** The bar, held at its eight corners. */
function held(options: IrbfOptions = {}) {
  const { positions } = bar.mesh;
  const irbf = hb.irbf(bar, options);
  const corners = [...Array(positions.length / 3).keys()].filter((v) =>
    [10, 2, 2].every((side, axis) => [0, side].includes(positions[3 * v + axis] as number)),
  );
  irbf.setHandles(corners.map((vertex) => ({ vertex })));
  return irbf;
}

function positionsOf(irbf: Irbf): Float32Array {
  const out = new Float32Array(irbf.vertexCount * 3);
  irbf.deform(out);
  return out;
}

/** Lengths, after and before, between the ends of a sphere's three edges, in model units. */
function stretches(irbf: Irbf, sphere: number): number[] {
  const { spheres, normalization } = irbf.body;
  const [x = 0, y = 0, z = 0, radius = 0] = spheres.subarray(4 * sphere, 4 * sphere + 4);
  return [0, 1, 2].map((axis) => {
    const ends = [-1, 1].flatMap((sign) =>
      [x, y, z].map(
        (c, k) => (normalization.center[k] as number) + normalization.diagonal * (c + (k === axis ? sign * radius : 0)),
      ),
    );
    const moved = irbf.evaluate(ends);
    const length = Math.hypot(...[0, 1, 2].map((k) => (moved[3 + k] as number) - (moved[k] as number)));
    return length / (2 * radius * normalization.diagonal);
  });
}

describe('shapes', () => {
  it('are the identity at first, nine numbers a sphere, and keep everything', () => {
    const irbf = held();
    expect([...irbf.shapes]).toEqual(Array.from({ length: bar.spheres.length / 4 }, () => IDENTITY).flat());
    irbf.solve();
    positionsOf(irbf).forEach((x, i) => {
      expect(x).toBeCloseTo(bar.mesh.positions[i] as number, 5);
    });
    irbf.dispose();
  });

  it('stretch a sphere along an axis, and leave distant ones as they are', () => {
    const irbf = held(LOCAL);
    const middle = [...Array(bar.spheres.length / 4).keys()].sort(
      (a, b) => Math.abs(bar.spheres[4 * a] as number) - Math.abs(bar.spheres[4 * b] as number),
    );
    const [first = 0, last = 0] = [middle[0], middle.at(-1)];
    irbf.shapes.set([1, 0, 0, 0, 1.5, 0, 0, 0, 1], 9 * first);
    expect(irbf.solve().converged).toBe(true);
    const [x, y, z] = stretches(irbf, first);
    expect(y).toBeGreaterThan(1.47);
    expect(y).toBeLessThan(1.53);
    for (const other of [x, z]) expect(other).toBeCloseTo(1, 1);
    for (const other of stretches(irbf, last)) expect(Math.abs(other - 1)).toBeLessThan(0.01);
    irbf.shapes.set(IDENTITY, 9 * first);
    irbf.solve();
    for (const other of stretches(irbf, first)) expect(other).toBeCloseTo(1, 3);
    irbf.dispose();
  });

  it('inflate the served dog about its largest sphere, by half along an axis', async () => {
    const body = await readDog();
    const irbf = hb.irbf(body, LOCAL);
    const radius = (s: number) => body.spheres[4 * s + 3] as number;
    const largest = [...Array(body.spheres.length / 4).keys()].reduce((a, b) => (radius(b) > radius(a) ? b : a));
    const { positions } = body.mesh;
    // The lowest and highest vertices of all three axes.
    const ends = [0, 1, 2].flatMap((axis) => {
      const order = [...Array(positions.length / 3).keys()].sort(
        (a, b) => (positions[3 * a + axis] as number) - (positions[3 * b + axis] as number),
      );
      return [order[0] as number, order.at(-1) as number];
    });
    irbf.setHandles([...new Set(ends)].map((vertex) => ({ vertex })));
    irbf.shapes.set([1, 0, 0, 0, 1.5, 0, 0, 0, 1], 9 * largest);
    irbf.solve();
    const stretched = stretches(irbf, largest)[1] as number;
    expect(stretched).toBeGreaterThan(1.47);
    expect(stretched).toBeLessThan(1.53);
    irbf.dispose();
  });

  it('that turn inside out or are no numbers are refused by their sphere; the last solution stays', () => {
    const irbf = held();
    irbf.solve();
    const before = positionsOf(irbf);
    const refusal = (shape: readonly number[]) => {
      irbf.shapes.set(shape, 9 * 3);
      try {
        irbf.solve();
      } catch (error) {
        return error as HandlebodyError;
      }
      throw new Error('nothing was thrown');
    };
    const inverted = refusal([1, 0, 0, 0, 1, 0, 0, 0, -1]);
    expect(inverted).toBeInstanceOf(HandlebodyError);
    expect(inverted).toMatchObject({ code: 'shape-inverted', culprit: { kind: 'sphere', index: 3 } });
    expect(refusal([1, 0, 0, 0, Number.NaN, 0, 0, 0, 1])).toMatchObject({ code: 'target-not-finite', culprit: { index: 3 } });
    expect(positionsOf(irbf)).toEqual(before);
    irbf.shapes.set(IDENTITY, 9 * 3);
    irbf.solve();
    irbf.dispose();
  });

  it('belong to one of several deformations that share a body', () => {
    const irbf = held();
    irbf.shapes.set([2, 0, 0, 0, 2, 0, 0, 0, 2], 0);
    const shared = irbf.share();
    expect([...shared.shapes.subarray(0, 9)]).toEqual(IDENTITY);
    shared.dispose();
    irbf.dispose();
    expect(irbf.shapes[0]).toBe(2);
  });
});

describe("sphereFit: 'similarity'", () => {
  it('lets handles that are scaled about a point scale the model: volume 3.375, no energy', () => {
    const volume = enclosedVolume(bar.mesh.positions, bar.mesh.triangles as Uint32Array);
    const [similar, rigid] = [held({ sphereFit: 'similarity' }), held()];
    for (const irbf of [similar, rigid])
      for (let k = 0; k < irbf.handleCount; k++)
        for (let axis = 0; axis < 3; axis++) irbf.targets[10 * k + axis] = 1.5 * ((irbf.targets[10 * k + axis] as number) - 1) + 1;
    const [free, stiff] = [similar.solve(), rigid.solve()];
    expect(free.energy).toBeLessThan(1e-9);
    expect(stiff.energy).toBeGreaterThan(1e-4);
    const grown = (irbf: Irbf) => enclosedVolume(positionsOf(irbf), bar.mesh.triangles as Uint32Array) / volume;
    expect(Math.abs(grown(similar) / 3.375 - 1)).toBeLessThan(1e-4);
    expect(grown(rigid)).toBeLessThan(0.9 * 3.375);
    for (const irbf of [similar, rigid]) irbf.dispose();
  });
});
