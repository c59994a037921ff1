import fc from 'fast-check';
import { beforeAll, describe, expect, it } from 'vitest';
import { type BodyData, type Handlebody, HandlebodyError, load, type Mesh } from '../../wasm/ts/index.ts';
import { readDog } from './support/dog.ts';
import { boxMesh, enclosedVolume } from './support/shapes.ts';

const SEED = 20261122;

let hb: Handlebody;
let bar: BodyData;
/** Vertex numbers of the bar's eight corners. */
let corners: number[];

beforeAll(async () => {
  hb = await load();
  const mesh = boxMesh([10, 2, 2], [30, 6, 6]);
  bar = await hb.bake(mesh, { centers: 80, resolution: 48, spheres: 9 });
  corners = [];
  for (let v = 0; v < mesh.positions.length / 3; v++) {
    const [x = 0, y = 0, z = 0] = mesh.positions.subarray(3 * v, 3 * v + 3);
    if ((x === 0 || x === 10) && (y === 0 || y === 2) && (z === 0 || z === 2)) corners.push(v);
  }
});

async function failure(run: () => unknown): Promise<HandlebodyError> {
  try {
    await run();
  } catch (error) {
    expect(error).toBeInstanceOf(HandlebodyError);
    const e = error as HandlebodyError;
    expect(e.message).toMatch(/[a-z].*\.$/);
    expect(e.remedy).toMatch(/[a-z].*\.$/);
    return e;
  }
  throw new Error('nothing was thrown');
}

describe('bake', () => {
  it('fills a bar: centers on vertices, spheres inside, distances from zero up', () => {
    expect(corners).toHaveLength(8);
    expect(bar.centers).toHaveLength(80);
    expect(new Set(bar.centers).size).toBe(80);
    expect(bar.distances).toHaveLength(80 * bar.voxels.length);
    expect(bar.spheres.length / 4).toBeGreaterThanOrEqual(5);
    for (let s = 0; s < bar.spheres.length; s += 4) {
      const [, y = 1, z = 1, r = 1] = bar.spheres.subarray(s, s + 4);
      const half = 1 / bar.normalization.diagonal;
      expect(Math.abs(y) + r).toBeLessThanOrEqual(half);
      expect(Math.abs(z) + r).toBeLessThanOrEqual(half);
    }
    // Straight through a convex shape: the interior distance is the Euclidean one, to the order of the marching.
    const [nx, ny] = bar.grid.dimensions;
    let worst = 0;
    for (let c = 0; c < bar.centers.length; c++) {
      const from = [0, 1, 2].map(
        (axis) =>
          ((bar.mesh.positions[3 * (bar.centers[c] ?? 0) + axis] ?? 0) - (bar.normalization.center[axis] ?? 0)) /
          bar.normalization.diagonal,
      );
      for (let v = 0; v < bar.voxels.length; v += 97) {
        const linear = bar.voxels[v] ?? 0;
        const index = [linear % nx, Math.floor(linear / nx) % ny, Math.floor(linear / (nx * ny))];
        const straight = Math.hypot(
          ...index.map((i, axis) => (bar.grid.origin[axis] ?? 0) + i * bar.grid.spacing - (from[axis] ?? 0)),
        );
        const interior = (bar.distances[c * bar.voxels.length + v] ?? 0) * bar.distanceScale;
        if (straight > 5 * bar.grid.spacing) worst = Math.max(worst, Math.abs(interior / straight - 1));
      }
    }
    expect(worst).toBeLessThan(0.03);
  });

  it('gives equal bytes twice, and reports rising progress', async () => {
    const mesh = boxMesh([3, 1, 1], [9, 3, 3]);
    const seen: number[] = [];
    const options = { centers: 20, resolution: 32, spheres: 8 };
    const first = await hb.bake(mesh, { ...options, onProgress: (part) => seen.push(part) });
    const second = await hb.bake(mesh, options);
    expect(second).toEqual(first);
    expect(seen.at(-1)).toBe(1);
    expect(seen).toEqual(seen.toSorted((a, b) => a - b));
  });

  it('can be cancelled, and leaves the instance usable', async () => {
    const control = new AbortController();
    const baking = hb.bake(bar.mesh, { centers: 400, resolution: 96, signal: control.signal, onProgress: () => control.abort() });
    await expect(baking).rejects.toMatchObject({ code: 'aborted' });
    const box = boxMesh([1, 1, 1], [2, 2, 2]);
    const options = { centers: 5, resolution: 16 };
    expect(await hb.bake(box, options)).toEqual(await (await load()).bake(box, options));
  });

  it('names what is wrong with a mesh', async () => {
    const box = boxMesh([1, 1, 1], [2, 2, 2]);
    const bake = (mesh: Partial<Mesh>, options = {}) =>
      failure(() => hb.bake({ ...box, ...mesh }, { centers: 5, resolution: 16, ...options }));
    const nan = Float64Array.from(box.positions);
    nan[3 * 7 + 2] = Number.NaN;
    expect(await bake({ positions: nan })).toMatchObject({ code: 'mesh-not-finite', culprit: { kind: 'vertex', index: 7 } });
    nan[3 * 7 + 2] = Number.NEGATIVE_INFINITY;
    expect(await bake({ positions: nan })).toMatchObject({ code: 'mesh-not-finite', culprit: { kind: 'vertex', index: 7 } });
    expect(await bake({ triangles: new Uint32Array() })).toMatchObject({ code: 'mesh-no-triangles' });
    expect(await bake({ positions: new Float32Array(3), triangles: new Uint32Array() })).toMatchObject({
      code: 'mesh-too-few-vertices',
    });
    expect(await bake({ positions: new Float32Array() })).toMatchObject({ code: 'mesh-too-few-vertices' });
    expect(await bake({ triangles: Uint32Array.of(0, 1, 999) })).toMatchObject({
      code: 'mesh-index-out-of-range',
      culprit: { kind: 'triangle', index: 0 },
    });
    expect(await bake({ positions: new Float32Array(24), triangles: Uint32Array.of(0, 1, 2) })).toMatchObject({
      code: 'mesh-zero-extent',
    });
    expect(await bake({ positions: box.positions.subarray(1) })).toMatchObject({ code: 'invalid-shape' });
    expect(await bake({}, { centers: 0 })).toMatchObject({ code: 'invalid-option' });
    expect(await bake({}, { centers: 1e9 })).toMatchObject({ code: 'invalid-option' });
    expect(await bake({}, { resolution: Number.NaN })).toMatchObject({ code: 'invalid-option' });
    expect(await bake({}, { distance: 'telepathy' })).toMatchObject({ code: 'invalid-option' });
    expect(await bake({ positions: box.positions.map((x, i) => (i % 3 === 1 ? 0 : x)) })).toMatchObject({
      code: 'mesh-no-interior',
    });
  });
});

describe('irbf', () => {
  const prepare = () => {
    const irbf = hb.irbf(bar);
    irbf.setHandles(corners.map((vertex) => ({ vertex })));
    return irbf;
  };
  const positionsOf = (irbf: ReturnType<typeof prepare>) => {
    const out = new Float32Array(bar.mesh.positions.length);
    irbf.deform(out);
    return out;
  };

  it(`gives any rigid motion of the handles back (seed ${SEED})`, () => {
    const irbf = prepare();
    const rest = irbf.targets.slice();
    fc.assert(
      fc.property(fc.double({ min: -3, max: 3, noNaN: true }), fc.double({ min: -9, max: 9, noNaN: true }), (angle, shift) => {
        const [c, s] = [Math.cos(angle), Math.sin(angle)];
        const turn = ([x = 0, y = 0, z = 0]: ArrayLike<number> & Iterable<number>) => [
          c * x - s * y + shift,
          s * x + c * y,
          z - shift,
        ];
        for (let k = 0; k < corners.length; k++) irbf.targets.set(turn(rest.subarray(10 * k, 10 * k + 3)), 10 * k);
        irbf.solve();
        const out = positionsOf(irbf);
        for (let v = 0; v < out.length; v += 3) {
          const expected = turn(bar.mesh.positions.subarray(v, v + 3));
          for (let axis = 0; axis < 3; axis++)
            expect(Math.abs((out[v + axis] ?? 0) - (expected[axis] ?? 0))).toBeLessThan(1e-4 * bar.normalization.diagonal);
        }
      }),
      { seed: SEED, numRuns: 20 },
    );
    irbf.dispose();
  });

  it('bends a bar, keeps its volume, reaches its anchors, and returns to rest', () => {
    const irbf = prepare();
    const rest = irbf.targets.slice();
    corners.forEach((vertex, k) => {
      if ((bar.mesh.positions[3 * vertex] ?? 0) > 5) irbf.targets[10 * k + 1] = (rest[10 * k + 1] ?? 0) + 3;
    });
    const report = irbf.solve({ maxIterations: 200 });
    expect(report.anchorError).toBeLessThan(1e-3 * bar.normalization.diagonal);
    const ratio = enclosedVolume(positionsOf(irbf), bar.mesh.triangles) / enclosedVolume(bar.mesh.positions, bar.mesh.triangles);
    expect(Math.abs(ratio - 1)).toBeLessThan(0.05);
    irbf.targets.set(rest);
    irbf.solve({ maxIterations: 200 });
    const back = positionsOf(irbf);
    const worst = back.reduce((most, x, i) => Math.max(most, Math.abs(x - (bar.mesh.positions[i] ?? 0))), 0);
    expect(worst).toBeLessThan(1e-6 * bar.normalization.diagonal);
    irbf.dispose();
  });

  it('survives the growth of wasm memory between its calls', async () => {
    const irbf = prepare();
    irbf.targets[1] = (irbf.targets[1] ?? 0) + 1;
    irbf.solve();
    const before = positionsOf(irbf);
    const memory = hb.memory;
    const others = [];
    while (hb.memory === memory) others.push(hb.irbf(bar));
    expect(positionsOf(irbf)).toEqual(before);
    irbf.solve();
    expect(Number.isFinite(irbf.solve().energy)).toBe(true);
    for (const other of others) other.dispose();
    irbf.dispose();
  });

  it('gives all its memory back', () => {
    const settled = () => {
      for (let i = 0; i < 3; i++) prepare().dispose();
      return hb.memory;
    };
    const memory = settled();
    for (let i = 0; i < 30; i++) prepare().dispose();
    expect(hb.memory).toBe(memory);
  });

  it('is shared: copies of a body deform apart, and outlive each other', () => {
    const first = prepare();
    const rest = positionsOf(first);
    first.targets[1] = (first.targets[1] ?? 0) + 1;
    first.solve();
    const bent = positionsOf(first);
    const second = first.share();
    expect(second.handleCount).toBe(0);
    expect(positionsOf(second)).toEqual(rest);
    first.dispose();
    expect(() => first.share()).toThrowError(expect.objectContaining({ code: 'disposed' }));
    second.setHandles(corners.map((vertex) => ({ vertex })));
    second.targets[1] = (second.targets[1] ?? 0) + 1;
    second.solve();
    expect(positionsOf(second)).toEqual(bent);
    second.dispose();
  });

  it('takes at most a fifth of the memory for each copy that shares the served dog', async () => {
    const dog = await readDog();
    const alone = await load();
    const empty = alone.memory;
    const holding = (irbf: ReturnType<typeof prepare>) => {
      irbf.setHandles([{ vertex: 0 }, { vertex: 9000 }, { vertex: 18000 }, { vertex: 24000 }]);
      irbf.solve({ maxIterations: 1 });
      return irbf;
    };
    const first = holding(alone.irbf(dog));
    const one = alone.memory - empty;
    const copies = Array.from({ length: 10 }, () => holding(first.share()));
    expect(alone.memory - empty - one).toBeLessThan((10 / 5) * one);
    for (const irbf of [first, ...copies]) irbf.dispose();
  });

  it('solves and deforms frame after frame in the memory that it has', () => {
    const irbf = prepare();
    const [positions, normals] = [new Float32Array(bar.mesh.positions.length), new Float32Array(bar.mesh.positions.length)];
    const frame = (time: number) => {
      irbf.targets[1] = 2 + Math.sin(time);
      irbf.solve({ maxIterations: 5 });
      irbf.deform(positions, normals);
    };
    frame(0);
    const memory = hb.memory;
    for (let time = 1; time < 300; time++) frame(time);
    expect(hb.memory).toBe(memory);
    irbf.dispose();
  });

  it('evaluates anywhere, as the vertices do to the 1e-4 of fixed point', () => {
    const irbf = prepare();
    irbf.targets[0] = (irbf.targets[0] ?? 0) - 1;
    irbf.solve();
    const out = positionsOf(irbf);
    const reference = irbf.evaluate(bar.mesh.positions);
    reference.forEach((x, i) => {
      expect(Math.abs(x - (out[i] ?? 0))).toBeLessThan(1e-4 * bar.normalization.diagonal);
    });
    irbf.dispose();
  });

  it('names bad handles and targets, keeps the last solution, and refuses use after dispose', async () => {
    const irbf = prepare();
    irbf.targets[1] = (irbf.targets[1] ?? 0) + 0.5;
    irbf.solve();
    const before = positionsOf(irbf);

    expect(await failure(() => irbf.setHandles([{ vertex: 1 }, { vertex: 1e6 }]))).toMatchObject({
      code: 'handle-out-of-range',
      culprit: { kind: 'handle', index: 1 },
    });
    const outside = await failure(() => irbf.setHandles([{ at: [5, 40, 0] }]));
    expect(outside).toMatchObject({ code: 'handle-outside', culprit: { kind: 'handle', index: 0 } });
    expect(outside.message).toMatch(/^Handle 0 at \(5, 40, 0\) lies outside the model, which spans \(.*\) to \(.*\)\.$/);
    expect(await failure(() => irbf.setHandles([{ at: [5, Number.NaN, 0] }]))).toMatchObject({ code: 'handle-not-finite' });
    expect(irbf.handleCount).toBe(8);
    for (const bad of [Number.NaN, Number.POSITIVE_INFINITY, 1e300]) {
      irbf.targets[31] = bad;
      expect(await failure(() => irbf.solve())).toMatchObject({ code: 'target-not-finite', culprit: { kind: 'handle', index: 3 } });
    }
    expect(positionsOf(irbf)).toEqual(before);

    irbf.setHandles([{ vertex: 5 }, { vertex: 5 }]);
    irbf.targets[11] = (irbf.targets[11] ?? 0) + 1;
    expect(await failure(() => irbf.solve())).toMatchObject({ code: 'handle-conflict', culprit: { kind: 'handle', index: 1 } });
    irbf.setHandles([]);
    expect(await failure(() => irbf.solve())).toMatchObject({ code: 'handles-missing' });
    expect(await failure(() => irbf.deform(new Float32Array(3)))).toMatchObject({ code: 'invalid-shape' });

    irbf.dispose();
    irbf.dispose();
    expect(await failure(() => irbf.solve())).toMatchObject({ code: 'disposed' });
  });

  it('refuses bodies that contradict themselves', async () => {
    const bad = (change: Partial<BodyData>) => failure(() => hb.irbf({ ...bar, ...change }));
    expect(await bad({ distances: bar.distances.subarray(1) })).toMatchObject({ code: 'body-invalid' });
    expect(await bad({ voxels: bar.voxels.toReversed() })).toMatchObject({ code: 'body-invalid' });
    expect(await bad({ voxels: bar.voxels.map((v, i) => (i === bar.voxels.length - 1 ? 0xffffffff : v)) })).toMatchObject({
      code: 'body-invalid',
    });
    expect(await bad({ centers: bar.centers.map(() => 1e6) })).toMatchObject({ code: 'body-invalid' });
    expect(await bad({ grid: { ...bar.grid, dimensions: [0, 5, 5] } })).toMatchObject({ code: 'body-invalid' });
    expect(await bad({ grid: { ...bar.grid, spacing: Number.NaN } })).toMatchObject({ code: 'body-invalid' });
    expect(await bad({ spheres: new Float64Array() })).toMatchObject({ code: 'body-invalid' });
    expect(await bad({ distanceScale: 0 })).toMatchObject({ code: 'body-invalid' });
    const moved = Float64Array.from(bar.mesh.positions);
    moved[0] = (moved[0] ?? 0) + 1;
    expect(await bad({ mesh: { ...bar.mesh, positions: moved } })).toMatchObject({ code: 'body-mismatch' });
  });
});
