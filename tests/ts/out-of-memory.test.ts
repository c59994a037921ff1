/** Memory that runs out is told, wherever it does: nothing else is lost, and all that was taken comes back. */
import { beforeAll, describe, expect, it } from 'vitest';
import { type BodyData, type Handlebody, load } from '../../wasm/ts/index.ts';
import { type Limited, littleMemory, MEGABYTES } from './support/little-memory.ts';
import { random } from './support/scattered.ts';
import { boxMesh } from './support/shapes.ts';

const LIMITS = Array.from({ length: 20 }, (_, i) => Math.round(600 * 1.68 ** i));

const { numbers } = random(1);
const COUNT = 60;
const data = { dimension: 2, points: numbers(2 * COUNT), values: numbers(COUNT), onWarning: () => {} };
const queries = numbers(40);
const centers = numbers(16);
const box = boxMesh([1, 1, 1], [5, 5, 5]);
const grid = gridMesh(12);
const corners = [{ vertex: 0 }, { vertex: 12 }, { vertex: 168 }];
const places = Array.from({ length: 30 }, (_, i) => ({ name: `${i}`, at: numbers(2), shape: numbers(20) }));
const skin = { dimension: 2 as const, positions: grid.positions, weights: grid.positions.map(() => 0.5) };
const bake = { centers: 30, resolution: 16, spheres: 8 };
const handles = [{ vertex: 0 }, { at: [0.5, 0.5, 0.5] as const, kind: 'rotation' as const }];

function gridMesh(n: number) {
  const positions: number[] = [];
  const triangles: number[] = [];
  for (let j = 0; j <= n; j++) for (let i = 0; i <= n; i++) positions.push(i / n, j / n + 0.01 * Math.sin(i));
  for (let j = 0; j < n; j++)
    for (let i = 0; i < n; i++) {
      const a = j * (n + 1) + i;
      triangles.push(a, a + 1, a + n + 2, a, a + n + 2, a + n + 1);
    }
  return { dimension: 2 as const, positions, triangles };
}

type Made = { dispose(): void };
const used = <T extends Made>(made: T, use: (made: T) => unknown): T => {
  try {
    use(made);
    return made;
  } catch (error) {
    made.dispose();
    throw error;
  }
};
const asked = <T extends Made & { evaluate(queries: number[]): unknown }>(made: T) => used(made, (f) => f.evaluate(queries));

let body: BodyData;
beforeAll(async () => {
  body = await (await load()).bake(box, bake);
});

/** What builds something, or takes memory for a time. */
const CALLS: Record<string, (hb: Handlebody) => Made | Promise<unknown> | object> = {
  'rbf()': (hb) => asked(hb.rbf(data)),
  'rbf() and its gradient': (hb) => used(hb.rbf({ ...data, kernel: 'cubic' }), (f) => f.gradient(queries)),
  'rbf() and its weights': (hb) => used(hb.rbf({ ...data, kernel: 'gaussian', width: 0.3 }), (f) => f.weights(queries)),
  'rbf() and what leaves one out': (hb) => used(hb.rbf({ ...data, kernel: 'gaussian', width: 0.3 }), (f) => f.leaveOneOut()),
  'rbf() of a width that is searched': (hb) => asked(hb.rbf({ ...data, kernel: 'gaussian', width: 'leave-one-out' })),
  'rbf() of a width a point': (hb) => asked(hb.rbf({ ...data, kernel: 'gaussian', width: data.values.map(() => 0.3) })),
  'rbf() that smooths': (hb) => asked(hb.rbf({ ...data, smoothing: 0.1 })),
  'rbf() that decays': (hb) => asked(hb.rbf({ ...data, kernel: 'multiquadric', weightDecay: 0.1 })),
  'rbf() normalized': (hb) => asked(hb.rbf({ ...data, kernel: 'gaussian', width: 1, normalized: true })),
  'rbf() of few centers': (hb) => asked(hb.rbf({ ...data, kernel: 'gaussian', width: 1, centers })),
  'rbf() that trusts most': (hb) => asked(hb.rbf({ ...data, kernel: 'gaussian', width: 1, centers, robust: 'least-absolute' })),
  'rbf() that trusts half': (hb) => asked(hb.rbf({ ...data, kernel: 'gaussian', width: 1, centers, robust: 'least-median' })),
  'rbf() of a caller’s kernel': (hb) => asked(hb.rbf({ ...data, kernel: (s) => Math.exp(-s), degree: -1 })),
  ...Object.fromEntries(
    (['row-sum', 'leave-one-out', 'residual'] as const).map((method) => [
      `findOutliers() by ${method}`,
      (hb: Handlebody) => hb.findOutliers({ ...data, method }),
    ]),
  ),
  'shepard()': (hb) => asked(hb.shepard(data)),
  'movingLeastSquares()': (hb) => asked(hb.movingLeastSquares({ ...data, weight: 'wendland', degree: 2 })),
  'simplexLinear()': (hb) => asked(hb.simplexLinear(data)),
  'naturalNeighbor()': (hb) => asked(hb.naturalNeighbor(data)),
  'tensionSpline()': (hb) => asked(hb.tensionSpline({ ...data, alpha: 1, beta: 1 })),
  'poseSpace()': (hb) => used(hb.poseSpace({ dimensions: ['x', 'y'], examples: places }), (space) => space.evaluate([0, 0])),
  'poseSpace() normalized': (hb) => hb.poseSpace({ dimensions: ['x', 'y'], examples: places, method: 'normalized' }),
  'linearBlend()': (hb) => used(hb.linearBlend({ ...skin, compiled: true }), (made) => made.deform()),
  'dualQuaternion()': (hb) => used(hb.dualQuaternion(skin), (made) => made.deform()),
  'discreteGreen()': (hb) =>
    used(hb.discreteGreen({ size: 40, samples: [3, 20, 31], values: [0, 1, 0] }), (made) => [
      made.green,
      made.solveGrid(),
      made.solveRadial(),
    ]),
  'biharmonicWeights()': (hb) => hb.biharmonicWeights(grid, corners),
  'biharmonicWeights() bounded': (hb) => hb.biharmonicWeights(grid, corners, { bounded: true }),
  'biharmonicWeights() of order 3': (hb) => hb.biharmonicWeights(grid, corners, { order: 3 }),
  'measureWeights()': (hb) => hb.measureWeights(grid, [{ vertex: 0 }], Array(169).fill(1)),
  'tetrahedralize()': (hb) => hb.tetrahedralize(box, { resolution: 6 }),
  'minimizeEnergy()': (hb) =>
    used(hb.minimizeEnergy(grid, corners, { energy: 'rigid' }), (made) => made.deform(new Float32Array(338))),
  'irbf()': (hb) =>
    used(hb.irbf(body), (irbf) => {
      irbf.setHandles(handles);
      irbf.solve();
      irbf.evaluate([0, 0, 0]);
      irbf.report();
    }),
  'irbf() shared': (hb) => {
    const first = hb.irbf(body, { constraints: 'hard' });
    try {
      return used(first.share(), (irbf) => irbf.setHandles(handles));
    } finally {
      first.dispose();
    }
  },
  ...Object.fromEntries(
    (['fast-marching', 'heat', 'mean-value', 'euclidean'] as const).map((distance) => [
      `bake() by ${distance}`,
      (hb: Handlebody) => hb.bake(box, { ...bake, distance }),
    ]),
  ),
};

/** Older objects: what each answers, and what changes it, which may fail. */
function witnesses(hb: Handlebody) {
  const [rbf, green] = [hb.rbf(data), hb.discreteGreen({ size: 20, samples: [1, 6], values: [0, 1] })];
  const space = hb.poseSpace({ dimensions: ['x', 'y'], examples: places });
  const blend = hb.linearBlend(skin);
  const weights = hb.biharmonicWeights(grid, corners);
  const irbf = hb.irbf(body);
  irbf.setHandles(handles);
  irbf.targets[0] = 0.3;
  irbf.solve();
  const moved = new Float32Array(box.positions.length);
  return {
    ask: () => {
      irbf.deform(moved);
      return [
        rbf.evaluate(queries),
        space.evaluate([0.1, 0.2]),
        blend.deform(),
        green.solveGrid(),
        irbf.evaluate([1, 0, 0]),
        moved.slice(),
        weights.weights,
      ].map((row) => Array.from(row as ArrayLike<number>));
    },
    changes: {
      'other handles of an irbf': () => irbf.setHandles([{ vertex: 3 }, { vertex: 9 }, { at: [0.4, 0.5, 0.5], kind: 'rotation' }]),
      'an irbf that is measured': () => irbf.report(),
      'other handles of weights': () => weights.setHandles([{ vertex: 5 }, { vertex: 80 }]),
    },
    undo: () => {
      irbf.setHandles(handles);
      irbf.targets[0] = 0.3;
      irbf.solve();
      weights.setHandles(corners);
    },
  };
}

const told = expect.objectContaining({ name: 'HandlebodyError', code: 'out-of-memory', remedy: expect.any(String) });

/** Runs it with so much memory; whether that was enough. Anything else but 'out-of-memory' fails. */
async function enough({ hb, leave }: Limited, bytes: number, call: (hb: Handlebody) => unknown): Promise<boolean> {
  const refill = leave(bytes);
  try {
    const made = (await call(hb)) as Partial<Made> | undefined;
    made?.dispose?.();
    return true;
  } catch (error) {
    expect(error).toEqual(told);
    return false;
  } finally {
    refill();
  }
}

describe('memory that runs out', () => {
  it.each(Object.entries(CALLS))('is told by %s at twenty limits, and older objects live on', async (_, call) => {
    const limited = await littleMemory(MEGABYTES(24));
    const { ask } = witnesses(limited.hb);
    const before = ask();
    const met: boolean[] = [];
    const round = async () => {
      met.length = 0;
      for (const limit of LIMITS) met.push(await enough(limited, limit, call));
      expect(ask()).toEqual(before);
      return limited.free();
    };
    const free = await round();
    for (let i = 0; i < 2; i++) expect(await round()).toBe(free);
    expect(limited.hb.usable).toBe(true);
    expect(met[0]).toBe(false);
    expect(met.at(-1)).toBe(true);
  });

  it('may run out again and again: nothing stays on the stack', async () => {
    const { hb, leave } = await littleMemory(MEGABYTES(24));
    const { ask } = witnesses(hb);
    const before = ask();
    const refill = leave(60_000);
    for (let i = 0; i < 4000; i++) expect(() => hb.rbf({ ...data, kernel: 'gaussian', width: 'leave-one-out' })).toThrow(told);
    refill();
    expect(ask()).toEqual(before);
  });

  it.each(['other handles of an irbf', 'an irbf that is measured', 'other handles of weights'] as const)(
    'leaves the object as it was: %s',
    async (name) => {
      const limited = await littleMemory(MEGABYTES(24));
      const { ask, changes, undo } = witnesses(limited.hb);
      undo();
      const before = ask();
      const met: boolean[] = [];
      for (const limit of LIMITS) {
        met.push(await enough(limited, limit, changes[name]));
        // What was refused changed nothing; what worked is undone.
        if (met.at(-1)) undo();
        for (const [i, row] of ask().entries())
          for (const [k, x] of row.entries()) expect(x, `${limit}`).toBeCloseTo(before[i]?.[k] as number, 4);
      }
      expect(met.at(-1)).toBe(true);
      expect(met).toContain(false);
    },
  );
});
