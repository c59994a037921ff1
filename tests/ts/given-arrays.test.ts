/**
 * Arrays that are given stay the caller's. Every public call that takes some, and what comes of it when they are overwritten, or handed to
 * another thread, afterwards or while it works: what would have come without. Arrays that are gone already are refused by a typed error.
 */
import { describe, expect, test } from 'vitest';
import { unshared } from '../../wasm/ts/copied.ts';
import { HandlebodyError, load, type SkinWarning, type TypedArray } from '../../wasm/ts/index.ts';
import { bakeInWorker } from '../../web/worker/index.ts';
import { weighInWorker } from '../../web/worker/weigh-in-worker.ts';
import { boxMesh } from './support/shapes.ts';

const hb = await load();
const NONE = new Float64Array();

/** What a call was given: every array, once. */
type Arrays = Record<string, TypedArray>;
/** Reads the result, as often as it is called. */
type Read = () => unknown;
/** `pause` is called each time that the call lets others have a turn. */
type Call = (given: Arrays, pause: () => void) => Read | Promise<Read>;

const mesh = () => {
  const { positions, triangles } = boxMesh([2, 1, 1], [4, 2, 2]);
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
};
const square = () => ({
  positions: Float64Array.from({ length: 50 }, (_, i) => (i % 2 ? Math.floor(i / 10) : (i / 2) % 5)),
  triangles: Uint32Array.from({ length: 16 }, (_, q) => Math.floor(q / 4) * 5 + (q % 4)).reduce<number[]>(
    (all, v) => all.concat([v, v + 1, v + 6, v, v + 6, v + 5]),
    [],
  ),
});
const scattered = () => ({
  points: Float64Array.of(0, 0, 1, 0.1, 0.2, 1, 1.1, 0.9, 0.5, 0.4, 0.3, 0.8),
  values: Float64Array.of(1, 2, 3, 5, 4, 0),
});
const queries = [0.4, 0.5, 0.7, 0.2];
const small = { centers: 8, resolution: 16, spheres: 6 };

const bakedArrays = async (): Promise<{ plain: Awaited<ReturnType<typeof hb.bake>>; arrays: Arrays }> => {
  const plain = await hb.bake(mesh(), small);
  const { voxels, centers, distances, spheres } = plain;
  return {
    plain,
    arrays: { positions: plain.mesh.positions, triangles: plain.mesh.triangles, voxels, centers, distances, spheres } as Arrays,
  };
};

const CALLS: Record<string, { arrays: () => Arrays | Promise<Arrays>; call: Call; long?: boolean }> = {
  'bake, of a mesh': {
    long: true,
    arrays: () => ({ ...mesh(), density: new Float64Array(mesh().positions.length / 3).fill(1) }),
    call: async ({ density, ...shape }, pause) => {
      const body = await hb.bake(shape as never, { ...small, density: density as TypedArray, onProgress: pause });
      return () => body;
    },
  },
  'bake, of a solid': {
    long: true,
    arrays: () => ({ positions: Float64Array.of(0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2), tetrahedra: Uint32Array.of(0, 1, 2, 3) }),
    call: async (shape, pause) => {
      const body = await hb.bake(shape as never, { ...small, onProgress: pause });
      return () => body;
    },
  },
  'bake, of a cloud': {
    long: true,
    arrays: () => ({ positions: Float64Array.from(boxMesh([2, 1, 1], [24, 12, 12]).positions) }),
    call: async (shape, pause) => {
      const body = await hb.bake(shape as never, { ...small, onProgress: pause });
      return () => body;
    },
  },
  'bake, of a volume': {
    long: true,
    arrays: () => ({ inside: new Uint8Array(6 * 5 * 4).fill(1) }),
    call: async ({ inside }, pause) => {
      const volume = { dimensions: [6, 5, 4] as const, spacing: 1, origin: [0, 0, 0] as const, inside: inside as TypedArray };
      const body = await hb.bake(volume, { ...small, onProgress: pause });
      return () => body;
    },
  },
  'bakeInWorker, where there are none': {
    long: true,
    arrays: mesh,
    call: async (shape, pause) => {
      const body = await bakeInWorker(shape as never, { ...small, onFallback: pause, onProgress: pause });
      return () => body;
    },
  },
  'weighInWorker, where there are none': {
    long: true,
    arrays: mesh,
    call: async (surface, pause) => {
      const handles = [{ at: [0.2, 0.5, 0.5] }, { at: [1.8, 0.5, 0.5] }] as const;
      const question = { surface: surface as never, handles, resolution: 8, order: 2, bounded: true } as const;
      const { weights } = await weighInWorker(question, { onFallback: pause, onProgress: pause });
      return () => weights;
    },
  },
  'irbf, its handles and its copies': {
    arrays: async () => (await bakedArrays()).arrays,
    call: async ({ positions, triangles, ...rest }) => {
      const { plain } = await bakedArrays();
      const irbf = hb.irbf({ ...plain, ...rest, mesh: { positions: positions as TypedArray, triangles: triangles as TypedArray } });
      return () =>
        [irbf, irbf.share()].map((one) => {
          one.setHandles([{ vertex: 0 }, { vertex: 30 }, { at: [1, 0.5, 0.5] }]);
          one.targets[0] = (one.targets[0] ?? 0) + 0.2;
          one.solve({ maxIterations: 20 });
          const out = new Float32Array(3 * one.vertexCount);
          one.deform(out, new Float32Array(out.length));
          return [Array.from(out), one.evaluate([1, 0.5, 0.5]), one.report().volumeRatio];
        });
    },
  },
  'irbf, rest normals': {
    arrays: () => ({ normals: Float32Array.from(mesh().positions, (_, i) => (i % 3 === 1 ? 1 : 0)) }),
    call: async ({ normals }) => {
      const irbf = hb.irbf((await bakedArrays()).plain);
      irbf.setHandles([{ vertex: 0 }]);
      irbf.setRestNormals(normals as TypedArray);
      return () => {
        const out = new Float32Array((normals as TypedArray).length || 3 * irbf.vertexCount);
        const positions = new Float32Array(3 * irbf.vertexCount);
        irbf.deform(positions, out);
        return out;
      };
    },
  },
  poseSpace: {
    arrays: () => ({ a: Float64Array.of(0, 0), b: Float64Array.of(1, 1), c: Float64Array.of(0, 1), d: Float32Array.of(5, 6) }),
    call: ({ a = NONE, b = NONE, c = NONE, d = NONE }) => {
      const examples = [a, b, c].map((at, i) => ({ name: `${i}`, at, shape: i === 2 ? d : Float64Array.of(i, 2) }));
      const space = hb.poseSpace({ dimensions: ['u', 'v'], examples });
      return () => [space.weights([0.4, 0.6]), space.evaluate([0.4, 0.6])];
    },
  },
  rbf: {
    arrays: () => ({ ...scattered(), centers: Float64Array.of(0, 0, 1, 1, 0.2, 0.9), widths: Float64Array.of(1, 1, 1) }),
    call: ({ points = NONE, values = NONE, centers = NONE, widths = NONE }) => {
      const one = hb.rbf({ dimension: 2, points, values, kernel: 'gaussian', width: 0.7, onWarning: () => {} });
      const other = hb.rbf({
        dimension: 2,
        points,
        values,
        kernel: 'gaussian',
        width: widths,
        centers,
        onWarning: () => {},
      } as never);
      return () => [one.evaluate(queries), other.evaluate(queries), one.report(), one.coefficients(), other.coefficients()];
    },
  },
  ...Object.fromEntries(
    (['shepard', 'movingLeastSquares', 'naturalNeighbor', 'simplexLinear'] as const).map((name) => [
      name,
      {
        arrays: scattered,
        call: ({ points = NONE, values = NONE }: Arrays) => {
          const f = hb[name]({ dimension: 2, points, values } as never);
          return () => [f.evaluate(queries), f.weights(queries)];
        },
      },
    ]),
  ),
  tensionSpline: {
    arrays: scattered,
    call: ({ points = NONE, values = NONE }) => {
      const f = hb.tensionSpline({ dimension: 2, points, values, onWarning: () => {} });
      return () => [f.evaluate(queries), f.report()];
    },
  },
  findOutliers: {
    arrays: scattered,
    call: ({ points = NONE, values = NONE }) => {
      const found = hb.findOutliers({ dimension: 2, points, values, kernel: 'gaussian', width: 0.7 });
      return () => found;
    },
  },
  discreteGreen: {
    arrays: () => ({ samples: Uint32Array.of(1, 5, 9), values: Float64Array.of(1, 0, 2) }),
    call: ({ samples = NONE, values = NONE }) => {
      const green = hb.discreteGreen({ size: 12, samples, values });
      return () => [green.solveGrid(), green.solveRadial()];
    },
  },
  ...Object.fromEntries(
    (['linearBlend', 'dualQuaternion'] as const).map((name) => [
      name,
      {
        arrays: () => ({ positions: Float32Array.of(1, 2, 3, 4, 5, 6), weights: Float32Array.of(0.5, 0.3, 0.2, 0.8) }),
        call: ({ positions = NONE, weights = NONE }: Arrays) => {
          const told: SkinWarning[] = [];
          const skin = hb[name]({ positions, weights, onWarning: (warning) => told.push(warning) });
          skin.transforms[3] = 2;
          return () => [skin.deform(), told];
        },
      },
    ]),
  ),
  minimizeEnergy: {
    arrays: () => ({ positions: square().positions, triangles: Uint32Array.from(square().triangles) }),
    call: ({ positions = NONE, triangles = NONE }) => {
      const map = hb.minimizeEnergy({ positions, dimension: 2, triangles } as never, [{ vertex: 0 }, { vertex: 24 }], {
        energy: 'rigid',
      });
      map.transforms[2] = 0.5;
      const out = new Float32Array(map.vertexCount * 2);
      map.deform(out);
      return () => {
        // On from where it was is not the same again.
        map.transforms[2] = 0.5;
        return Array.from(out);
      };
    },
  },
  'biharmonicWeights, bounded in steps': {
    long: true,
    arrays: () => ({ positions: square().positions, triangles: Uint32Array.from(square().triangles) }),
    call: async ({ positions = NONE, triangles = NONE }, pause) => {
      const weights = hb.biharmonicWeights({ positions, dimension: 2, triangles } as never, [
        { vertex: 0 },
        { vertex: 12 },
        { vertex: 24 },
      ]);
      const free = weights.weights.slice();
      await weights.bound({ onProgress: pause });
      return () => [free, weights.weights, weights.mass];
    },
  },
  measureWeights: {
    arrays: () => ({
      positions: square().positions,
      triangles: Uint32Array.from(square().triangles),
      weights: new Float64Array(50).fill(0.5),
    }),
    call: ({ positions = NONE, triangles = NONE, weights = NONE }) => {
      const measures = hb.measureWeights({ positions, dimension: 2, triangles } as never, [{ vertex: 0 }, { vertex: 24 }], weights);
      return () => measures;
    },
  },
  tetrahedralize: {
    arrays: mesh,
    call: (surface) => {
      const solid = hb.tetrahedralize(surface as never, { resolution: 8 });
      return () => [solid.positions, solid.tetrahedra, solid.sample(solid.positions)];
    },
  },
};

const overwrite = (arrays: Arrays) => {
  for (const array of Object.values(arrays)) array.fill(1);
};
const handOver = (arrays: Arrays) => {
  for (const array of Object.values(arrays))
    if (array.buffer.byteLength > 0) structuredClone(null, { transfer: [array.buffer as ArrayBuffer] });
};

/** What arrays are called where they are given, if not by that name. */
const NAMES: Record<string, string> = { a: 'at', b: 'at', c: 'at', d: 'shape', widths: 'width' };

const names = Object.keys(CALLS);
const callOf = (name: string) => CALLS[name] as NonNullable<(typeof CALLS)[string]>;
const untouched = async (name: string) => {
  const { arrays, call } = callOf(name);
  return (await call(await arrays(), () => {}))();
};

describe.each(names)('%s', (name) => {
  const { arrays, call, long } = callOf(name);

  test.each([
    ['overwritten', overwrite],
    ['handed over', handOver],
  ])('arrays that are %s afterwards change nothing', async (_, change) => {
    const given = await arrays();
    const read = await call(given, () => {});
    change(given);
    expect(read()).toEqual(await untouched(name));
  });

  test('arrays are left as they are', async () => {
    const given = await arrays();
    const before = structuredClone(given);
    await call(given, () => {});
    expect(given).toEqual(before);
  });

  test('arrays that were handed over before are refused, by a typed error', async () => {
    const given = await arrays();
    handOver(given);
    await expect((async () => call(given, () => {}))()).rejects.toBeInstanceOf(HandlebodyError);
  });

  test('one that was handed over is refused by its name', async () => {
    for (const key of Object.keys(await arrays())) {
      const given = await arrays();
      handOver({ [key]: given[key] as TypedArray });
      const error = await (async () => call(given, () => {}))().catch((thrown) => thrown);
      expect(error, key).toBeInstanceOf(HandlebodyError);
      expect(error.message, key).toMatch(new RegExp(`memory of "[^"]*${NAMES[key] ?? key}" was handed to another thread`));
    }
  });

  test('arrays that threads share give the same', async () => {
    const shared = Object.fromEntries(
      Object.entries(await arrays()).map(([key, array]) => {
        const Kind = array.constructor as Float64ArrayConstructor;
        const copy = new Kind(new SharedArrayBuffer(array.byteLength) as unknown as ArrayBuffer);
        copy.set(array);
        return [key, copy];
      }),
    );
    const read = await call(shared, () => {});
    overwrite(shared);
    expect(read()).toEqual(await untouched(name));
  });

  if (!long) return;
  test.each([
    ['overwritten', overwrite],
    ['handed over', handOver],
  ])('arrays that are %s while it works change nothing', async (_, change) => {
    const given = await arrays();
    let paused = 0;
    const read = await call(given, () => {
      if (paused++ === 0) change(given);
    });
    expect(paused).toBeGreaterThan(0);
    expect(read()).toEqual(await untouched(name));
  });

  test.each([
    ['overwritten', overwrite],
    ['handed over', handOver],
  ])('arrays that are %s as soon as it was called change nothing', async (_, change) => {
    const given = await arrays();
    const called = call(given, () => {});
    change(given);
    expect((await called)()).toEqual(await untouched(name));
  });
});

test('options that change while a bake works are those that were given', async () => {
  const told: string[] = [];
  const parts: number[] = [];
  const options = {
    ...{ centers: 30, resolution: 64, spheres: 6, distance: 'fast-marching' },
    onWarning: ({ code }: { code: string }) => told.push(code),
    onProgress: (part: number) => parts.push(part),
  };
  // A flap without volume: the last thing that a bake finds out.
  const { positions, triangles } = mesh();
  const n = positions.length / 3;
  const given = {
    positions: Float64Array.of(...positions, 3, 0, 0, 4, 0, 0, 3, 1, 0),
    triangles: Uint32Array.of(...triangles, n, n + 1, n + 2, 0, 0, 1),
  };
  const work = hb.bake(given, options as never);
  expect(told).toEqual(['triangles-flat']);
  const other = () => told.push('another');
  Object.assign(options, { distance: 'heat', centers: 3, resolution: 8, onWarning: other, onProgress: other });
  const body = await work;
  expect([body.distance, body.centers.length, told]).toEqual(['fast-marching', 30, ['triangles-flat', 'part-outside']]);
  expect(parts.at(-1)).toBe(1);
});

test('arrays that other threads may write are read once, from a copy; others are read where they are', () => {
  const shared = new Float32Array(new SharedArrayBuffer(12));
  shared.set([1, 2, 3]);
  const copy = unshared(shared);
  shared.fill(0);
  expect(Array.from(copy)).toEqual([1, 2, 3]);
  const own = Float32Array.of(1, 2);
  expect(unshared(own)).toBe(own);
  const list = [1, 2];
  expect(unshared(list)).toBe(list);
});

test('a Node Buffer, which cuts no copies of itself, is copied as well', async () => {
  const bytes = Buffer.alloc(6 * 5 * 4, 1);
  const volume = { dimensions: [6, 5, 4] as const, spacing: 1, origin: [0, 0, 0] as const, inside: bytes };
  const cloud = { positions: Buffer.from(boxMesh([20, 10, 10], [20, 10, 10]).positions) };
  const [work, other] = [hb.bake(volume, small), hb.bake(cloud, small)];
  bytes.fill(0);
  cloud.positions.fill(9);
  expect((await work).voxels.length).toBe(120);
  expect(Math.max(...(await other).mesh.positions)).toBe(20);
});

test('a body whose mesh changed since it was baked is refused', async () => {
  const body = await hb.bake(mesh(), small);
  body.mesh.positions[4] = 0.25;
  expect(() => hb.irbf(body)).toThrow(expect.objectContaining({ code: 'body-mismatch' }));
});

test('places where results go that were handed over are refused', async () => {
  const gone = new Float32Array(6);
  handOver({ gone });
  const skin = hb.linearBlend({ positions: [1, 2, 3, 4, 5, 6], weights: [1, 1] });
  const f = hb.shepard({ dimension: 2, ...scattered() });
  const irbf = hb.irbf(await hb.bake(mesh(), small));
  for (const run of [
    () => skin.deform(gone),
    () => f.evaluate(queries, gone),
    () => f.evaluate(gone),
    () => irbf.deform(gone),
    () => irbf.setRestNormals(gone),
    () => irbf.evaluate([0, 0, 0], gone),
  ]) {
    let thrown: unknown;
    try {
      const result = run() as ArrayLike<number> | undefined;
      expect(result?.length).toBe(0); // no queries, no answers
    } catch (error) {
      thrown = error;
      expect(thrown).toBeInstanceOf(HandlebodyError);
    }
  }
});
