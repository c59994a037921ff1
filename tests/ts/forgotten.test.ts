/** What is forgotten, or disposed of, leaves nothing in the solver's memory. */
import { BoxGeometry, Mesh, PerspectiveCamera } from 'three';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { Handlebody } from '../../wasm/ts/handlebody.ts';
import { HandlebodyRuntime } from '../../wasm/ts/handlebody-runtime.ts';
import { type BodyData, load } from '../../wasm/ts/index.ts';
import { deformable, draggable, meshFromObject, poseDriver } from '../../web/three/index.ts';
import { collect } from './support/collect.ts';
import { counted } from './support/counted.ts';
import { FakeElement, fakeDocument } from './support/fake-element.ts';
import { boxMesh } from './support/shapes.ts';

const plane = { dimension: 2 as const, positions: [0, 0, 1, 0, 1, 1, 0, 1], triangles: [0, 1, 2, 0, 2, 3] };
const few = { dimension: 2, points: [0, 0, 1, 0, 0, 1, 1, 1], values: [0, 1, 1, 0] };
const skin = { dimension: 2 as const, positions: plane.positions, weights: [1, 1, 1, 1] };
const ends = [{ vertex: 0 }, { vertex: 2 }];
const box = boxMesh([1, 1, 1], [3, 3, 3]);
const small = { centers: 4, resolution: 8, spheres: 2 };
const shown = () => new Mesh(new BoxGeometry(1, 1, 1));

let body: BodyData;
let shownBody: BodyData;
let restore: () => void;
beforeAll(async () => {
  restore = fakeDocument();
  const hb = await load();
  body = await hb.bake(box, small);
  shownBody = await hb.bake(meshFromObject(shown()).mesh, small);
});
afterAll(() => restore());

const camera = new PerspectiveCamera(40, 1, 0.1, 50);
const face = { dimensions: [{ name: 'x', min: 0, max: 1 }], examples: [{ name: 'a', at: [0], weights: [1] }], meshes: [] };

/** How each of the solver's methods is called: one that is not here fails a test. */
const METHODS: Record<string, (hb: Handlebody) => object> = {
  irbf: (hb) => {
    const made = hb.irbf(body);
    made.setHandles([{ vertex: 0 }]);
    made.solve();
    return made;
  },
  poseSpace: (hb) => hb.poseSpace({ dimensions: ['x'], examples: [{ name: 'a', at: [0], shape: [1] }] }),
  rbf: (hb) => asked(hb.rbf(few)),
  findOutliers: (hb) => hb.findOutliers(few),
  simplexLinear: (hb) => asked(hb.simplexLinear(few)),
  naturalNeighbor: (hb) => asked(hb.naturalNeighbor(few)),
  shepard: (hb) => asked(hb.shepard(few)),
  movingLeastSquares: (hb) => asked(hb.movingLeastSquares(few)),
  tensionSpline: (hb) => asked(hb.tensionSpline(few)),
  linearBlend: (hb) => hb.linearBlend(skin),
  dualQuaternion: (hb) => hb.dualQuaternion(skin),
  bake: (hb) => hb.bake(box, small),
  discreteGreen: (hb) => hb.discreteGreen({ size: 8, samples: [1, 6], values: [0, 1] }),
  tetrahedralize: (hb) => hb.tetrahedralize(box, { resolution: 4 }),
  biharmonicWeights: (hb) => hb.biharmonicWeights(plane, ends),
  measureWeights: (hb) => hb.measureWeights(plane, [{ vertex: 0 }], [1, 1, 1, 1]),
  minimizeEnergy: (hb) => hb.minimizeEnergy(plane, ends, { energy: 'rigid' }),
};

/** Other ways to come by such objects. */
const WAYS: typeof METHODS = {
  'a shared irbf': (hb) => {
    const first = hb.irbf(body);
    const second = first.share();
    first.dispose();
    return second;
  },
  'an rbf with a kernel of the caller’s': (hb) => hb.rbf({ ...few, kernel: (s) => 1 / (1 + s) }),
  'an irbf with a kernel of the caller’s': (hb) => hb.irbf(body, { kernel: (s) => 1 / (1 + s * s) }),
  'an rbf that is refused': (hb) => refused(() => hb.rbf({ ...few, kernel: () => Number.NaN })),
  'weights that are refused': (hb) => refused(() => hb.biharmonicWeights(plane, [{ vertex: 0 }, { vertex: 0 }])),
  'a deformable object': (hb) => {
    const irbf = hb.irbf(shownBody);
    deformable(shown(), irbf);
    return irbf;
  },
  'a draggable object': (hb) =>
    draggable(shown(), shownBody, { hb, camera, container: new FakeElement() as unknown as HTMLElement }),
  'a driven face': (hb) => poseDriver(hb, face),
};

function asked<T extends { evaluate(queries: number[]): unknown }>(made: T): T {
  made.evaluate([0.2, 0.3]);
  return made;
}

function refused(work: () => unknown): object {
  expect(work).toThrow();
  return {};
}

const ALL = Object.entries({ ...METHODS, ...WAYS });
/** Of what makes no object that is held, and takes its time, a part of the number. */
const PART: Record<string, number> = { bake: 0.01, tetrahedralize: 0.02, findOutliers: 0.1, measureWeights: 0.1 };

describe('what is forgotten', () => {
  it('is tried for all that solvers make', () => {
    const named = [Handlebody, HandlebodyRuntime].flatMap(({ prototype }) =>
      Object.entries(Object.getOwnPropertyDescriptors(prototype))
        .filter(([name, { value }]) => typeof value === 'function' && name !== 'constructor' && name !== 'dispose')
        .map(([name]) => name),
    );
    expect(Object.keys(METHODS).sort()).toEqual(named.sort());
  });

  it.each(ALL)('comes back: %s', async (name, make) => {
    const { hb, blocks, objects } = await counted();
    const makeMany = async () => {
      for (let i = 0; i < 300 * (PART[name] ?? 1); i++) await make(hb);
    };
    const sizes: number[] = [];
    for (let round = 0; round < 20; round++) {
      await makeMany();
      await collect();
      sizes.push(hb.memory);
    }
    expect([blocks(), objects()]).toEqual([0, 0]);
    expect(new Set(sizes.slice(2)).size, String(sizes)).toBe(1);
  });

  it.each(Object.entries(METHODS))('need not be forgotten, but disposed of: %s', async (name, make) => {
    const { hb, blocks, objects } = await counted();
    let early = 0;
    for (let i = 0; i < 10_000 * (PART[name] ?? 1); i++) {
      const made = (await make(hb)) as { dispose?(): void };
      made.dispose?.();
      if (i === 50) early = hb.memory;
    }
    expect([blocks(), objects()]).toEqual([0, 0]);
    expect(hb.memory).toBe(early);
  });
});
