/** `hb.dispose()`: an instance ends with all that it made, at any moment, and its memory can be collected. */
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { beforeAll, describe, expect, it } from 'vitest';
import { type BodyData, type Handlebody, type HandlebodyRuntime, load } from '../../wasm/ts/index.ts';
import { load as loadRuntime } from '../../wasm/ts/runtime.ts';
import { boxMesh } from './support/shapes.ts';

const box = boxMesh([1, 1, 1], [3, 3, 3]);
const plane = { dimension: 2 as const, positions: [0, 0, 1, 0, 1, 1, 0, 1], triangles: [0, 1, 2, 0, 2, 3] };
const few = { dimension: 2, points: [0, 0, 1, 0, 0, 1, 1, 1], values: [0, 1, 1, 0] };
const skin = { dimension: 2 as const, positions: plane.positions, weights: [1, 1, 1, 1] };
const disposed = expect.objectContaining({ name: 'HandlebodyError', code: 'disposed', remedy: expect.any(String) });

let body: BodyData;
beforeAll(async () => {
  body = await (await load()).bake(box, { centers: 8, resolution: 16, spheres: 4 });
});

/** Everything that the runtime makes, with something that asks its memory. */
const MADE: Record<string, (hb: HandlebodyRuntime) => { dispose(): void; ask: () => unknown }> = {
  irbf: (hb) => {
    const made = hb.irbf(body);
    made.setHandles([{ vertex: 0 }]);
    return { dispose: () => made.dispose(), ask: () => made.solve() };
  },
  poseSpace: (hb) => {
    const made = hb.poseSpace({ dimensions: ['x'], examples: [{ name: 'a', at: [0], shape: [1] }] });
    return { dispose: () => made.dispose(), ask: () => made.evaluate([0]) };
  },
  linearBlend: (hb) => {
    const made = hb.linearBlend(skin);
    return { dispose: () => made.dispose(), ask: () => made.deform() };
  },
  dualQuaternion: (hb) => {
    const made = hb.dualQuaternion(skin);
    return { dispose: () => made.dispose(), ask: () => made.deform() };
  },
  ...Object.fromEntries(
    (['rbf', 'simplexLinear', 'naturalNeighbor', 'shepard', 'movingLeastSquares', 'tensionSpline'] as const).map((name) => [
      name,
      (hb: HandlebodyRuntime) => {
        const made = hb[name]({ ...few });
        return { dispose: () => made.dispose(), ask: () => made.evaluate([]) };
      },
    ]),
  ),
};

/** What the whole solver makes besides. */
const MADE_BY_ALL: Record<string, (hb: Handlebody) => { dispose(): void; ask: () => unknown }> = {
  discreteGreen: (hb) => {
    const made = hb.discreteGreen({ size: 8, samples: [1, 6], values: [0, 1] });
    expect(made.operator.rows).toBeGreaterThan(0);
    return { dispose: () => made.dispose(), ask: () => made.operator };
  },
  biharmonicWeights: (hb) => {
    const made = hb.biharmonicWeights(plane, [{ vertex: 0 }, { vertex: 2 }]);
    return { dispose: () => made.dispose(), ask: () => made.setHandles([{ vertex: 1 }]) };
  },
  minimizeEnergy: (hb) => {
    const made = hb.minimizeEnergy(plane, [{ vertex: 0 }, { vertex: 2 }], { energy: 'rigid' });
    return { dispose: () => made.dispose(), ask: () => made.deform(new Float32Array(8)) };
  },
};

const collectGarbage = (() => {
  setFlagsFromString('--expose-gc');
  return runInNewContext('gc') as () => void;
})();

describe.each([
  ['handlebody', load],
  ['handlebody/runtime', loadRuntime],
] as const)('dispose() of %s', (entry, load) => {
  it('ends all that it made: its calls throw, and its own dispose() does not', async () => {
    const hb = await load();
    const makers = entry === 'handlebody' ? { ...MADE, ...MADE_BY_ALL } : MADE;
    const made = Object.entries(makers).map(([name, make]) => ({ name, ...make(hb as Handlebody) }));
    expect(hb.memory).toBeGreaterThan(0);
    hb.dispose();
    expect(hb.memory).toBe(0);
    for (const { name, ask, dispose } of made) {
      expect(ask, name).toThrow(disposed);
      dispose();
      dispose();
      expect(ask, name).toThrow(disposed);
    }
  });

  it('makes nothing any more, and may be called again', async () => {
    const hb = await load();
    hb.dispose();
    hb.dispose();
    for (const [name, make] of Object.entries(MADE)) expect(() => make(hb), name).toThrow(disposed);
    expect(() => hb.findOutliers(few)).toThrow(disposed);
  });

  it('happens at the end of a block that says `using`', async () => {
    let kept: HandlebodyRuntime;
    {
      using hb = await load();
      kept = hb;
      expect(kept.memory).toBeGreaterThan(0);
    }
    expect(kept.memory).toBe(0);
  });

  it('lets the memory be collected, though what it made is still held', async () => {
    const { instantiate } = WebAssembly;
    let memory: WeakRef<object> | undefined;
    // Not a mock, which would keep what it returned.
    WebAssembly.instantiate = (async (module: WebAssembly.Module, imports: WebAssembly.Imports) => {
      const instance = await instantiate(module, imports);
      memory = new WeakRef(instance.exports.memory as object);
      return instance;
    }) as typeof instantiate;
    const hb = await load().finally(() => {
      WebAssembly.instantiate = instantiate;
    });
    const made = Object.values(MADE).map((make) => make(hb));
    const isThere = async () => {
      for (let i = 0; i < 5; i++) {
        collectGarbage();
        await new Promise((resolve) => setImmediate(resolve));
      }
      return memory?.deref() !== undefined;
    };
    expect(await isThere()).toBe(true);
    hb.dispose();
    expect(await isThere()).toBe(false);
    expect(made.length).toBeGreaterThan(0);
  });
});

describe('work under way', () => {
  it('rejects a bake that the instance does not outlive, in a step or between two', async () => {
    const hb = await load();
    const inStep = hb.bake(box, { centers: 60, resolution: 48, onProgress: () => hb.dispose() });
    await expect(inStep).rejects.toThrow(disposed);

    const other = await load();
    const between = other.bake(box, { centers: 60, resolution: 48 });
    other.dispose();
    await expect(between).rejects.toThrow(disposed);
    await expect(other.bake(box)).rejects.toThrow(disposed);
    expect(() => other.tetrahedralize(box)).toThrow(disposed);
    expect(() => other.measureWeights(plane, [{ vertex: 0 }], [1, 1, 1, 1])).toThrow(disposed);
  });

  it('rejects the bounding of weights', async () => {
    const hb = await load();
    const weights = hb.biharmonicWeights(box, [{ vertex: 0 }, { vertex: 20 }, { vertex: 40 }]);
    const bounding = weights.bound({ tolerance: 1e-12 });
    hb.dispose();
    await expect(bounding).rejects.toThrow(disposed);
    expect(weights.weights.length).toBeGreaterThan(0);
  });

  it('may be ended by the kernel that it calls: the call fails, and all later ones', async () => {
    const hb = await load();
    const kernel = (s: number) => {
      hb.dispose();
      return 1 / (1 + s);
    };
    expect(() => hb.rbf({ ...few, kernel })).toThrow(disposed);
    expect(() => hb.rbf(few)).toThrow(disposed);
  });

  it('leaves another instance as it is', async () => {
    const [hb, other] = await Promise.all([load(), load()]);
    const { ask } = MADE.irbf?.(other) ?? {};
    hb.dispose();
    expect(ask).not.toThrow();
    other.dispose();
  });
});
