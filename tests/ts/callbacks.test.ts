/**
 * What callers are called back with may throw, end the solver, dispose of what calls it, or call the same again. Each such call ends as its
 * caller wants or in a typed error, gives back what it held, and the solver stays what it was. (Progress and signals: aborted-steps.test.ts.)
 */
import { readdirSync, readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { type BodyData, type Handlebody, load } from '../../wasm/ts/index.ts';
import { meshDocument, readGlb, readGltf, readMesh, writeGlb } from '../../web/assets/index.ts';
import { bakeInWorker } from '../../web/worker/index.ts';
import { collect } from './support/collect.ts';
import { counted } from './support/counted.ts';
import { boxMesh } from './support/shapes.ts';

const hb = await load();
const box = boxMesh([2, 1, 1], [4, 2, 2]);
const small = { centers: 6, resolution: 8, spheres: 3 };
const body: BodyData = await hb.bake(box, small);
/** A square, and a vertex that nothing uses. */
const loose = { dimension: 2 as const, positions: [0, 0, 1, 0, 1, 1, 0, 1, 9, 9], triangles: [0, 1, 2, 0, 2, 3] };
const ends = [{ vertex: 0 }, { vertex: 2 }];
const far = { dimension: 1, points: [0, 1, 2, 3], values: [0, 1, 0, 1] };
const flap = {
  positions: Float64Array.of(...box.positions, 3, 0, 0, 4, 0, 0, 3, 1, 0),
  triangles: Uint32Array.of(...box.triangles, ...[0, 1, 2].map((v) => v + box.positions.length / 3)),
};
const skin = { dimension: 2 as const, positions: [0, 0, 1, 0], weights: [1, 1, 2, 1] };
const dull = () => {};

/** Uses what is made, and gives it back. */
function used<T extends { dispose(): void }>(made: T, use: (made: T) => unknown): unknown {
  try {
    return use(made);
  } finally {
    made.dispose();
  }
}

/** Calls with one listener, which each of them calls; what comes of them is compared. By the file that declares the option. */
const LISTENERS: Record<string, (hb: Handlebody, on: () => void) => unknown> = {
  'interpolant.ts onWarning: rbf': (hb, onWarning) =>
    used(hb.rbf({ ...far, kernel: 'gaussian', width: 0.05, onWarning }), (f) => f.evaluate([0.5])),
  'interpolant.ts onWarning: tensionSpline': (hb, onWarning) =>
    used(hb.tensionSpline({ dimension: 1, points: [0, 1e-8, 1, 3], values: [0, 1, 2, 1], gamma: 1, onWarning }), (f) =>
      f.evaluate([0.5]),
    ),
  'skin.ts onWarning: linearBlend': (hb, onWarning) => used(hb.linearBlend({ ...skin, onWarning }), (made) => made.deform()),
  'skin.ts onWarning: dualQuaternion': (hb, onWarning) => used(hb.dualQuaternion({ ...skin, onWarning }), (made) => made.deform()),
  'mesh-warnings.ts onWarning: biharmonicWeights': (hb, onWarning) =>
    used(hb.biharmonicWeights(loose, ends, { onWarning }), ({ weights }) => weights.slice()),
  'mesh-warnings.ts onWarning: measureWeights': (hb, onWarning) =>
    hb.measureWeights(loose, ends, new Float64Array(10).fill(0.5), { onWarning }),
  'mesh-warnings.ts onWarning: minimizeEnergy': (hb, onWarning) =>
    used(hb.minimizeEnergy(loose, ends, { energy: 'rigid', onWarning }), (map) => map.deform(new Float32Array(10))),
  'mesh-warnings.ts onWarning: tetrahedralize': (hb, onWarning) => {
    const { positions, tetrahedra } = hb.tetrahedralize(
      { ...flap, triangles: Uint32Array.of(...box.triangles, 0, 0, 1) },
      { resolution: 4, onWarning },
    );
    return [positions, tetrahedra];
  },
  'types.ts onWarning: irbf': (hb, onWarning) =>
    used(hb.irbf(body, { onWarning }), (irbf) => {
      irbf.setHandles([{ at: [0.2, 0.5, 0.5] }, { at: [1, 0.5, 0.5] }, { at: [1.8, 0.5, 0.5] }]);
      return irbf.solve().energy;
    }),
  'types.ts onWarning: bake': (hb, onWarning) => hb.bake(flap, { ...small, onWarning }),
  'types.ts onProgress: bake': (hb, onProgress) => hb.bake(box, { ...small, onProgress }),
  'stepped.ts onProgress: bound': async (hb, onProgress) => {
    const weights = hb.biharmonicWeights(loose, ends);
    try {
      await weights.bound({ onProgress });
      return weights.weights.slice();
    } finally {
      weights.dispose();
    }
  },
  'in-worker.ts onFallback: bakeInWorker': (_, onFallback) => bakeInWorker(box, { ...small, onFallback }),
  'in-worker.ts onProgress: bakeInWorker': (_, onProgress) => bakeInWorker(box, { ...small, onProgress }),
  'in-worker.ts onWarning: bakeInWorker': (_, onWarning) => bakeInWorker(flap, { ...small, onWarning }),
  'gltf-warnings.ts onWarning: readGltf': async (_, onWarning) =>
    readMesh(await readGltf(gltf({ extensions: { X_a: { node: 0 } }, extensionsUsed: ['X_a'] }), { onWarning })).mesh,
  'gltf-warnings.ts resource: readGltf': async (_, on) => {
    const resource = async () => {
      on();
      return new Uint8Array(36);
    };
    return readMesh(await readGltf(gltf({ buffers: [{ byteLength: 36, uri: 'a.bin' }] }), { resource })).mesh;
  },
  'scene-choices.ts onWarning: readMesh': async (_, onWarning) => {
    const far = { ...box, positions: Float32Array.from(box.positions, (x) => x + 3e6) };
    const document = await readGlb(await writeGlb(meshDocument(far)));
    document.getRoot().listNodes()[0]?.setScale([0.1, 0.1, 0.1]);
    return readMesh(document, { onWarning }).mesh;
  },
};

const gltf = (more: object) =>
  new TextEncoder().encode(
    JSON.stringify({
      asset: { version: '2.0' },
      buffers: [{ byteLength: 36, uri: `data:;base64,${Buffer.alloc(36).toString('base64')}` }],
      bufferViews: [{ buffer: 0, byteLength: 36 }],
      accessors: [{ bufferView: 0, componentType: 5126, type: 'VEC3', count: 3, min: [0, 0, 0], max: [0, 0, 0] }],
      meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
      nodes: [{ mesh: 0 }],
      scenes: [{ nodes: [0] }],
      ...more,
    }),
  );

/** Whether it is the solver of the call, or one that the call makes or needs none. */
const ofSolver = (name: string) => !/^(in-worker|gltf-|scene-)/.test(name);

it('every callback that the solver, the workers and the readers take is tried', () => {
  const declared = ['wasm/ts', 'web/worker', 'web/assets'].flatMap((folder) =>
    readdirSync(folder).flatMap((file) =>
      [...readFileSync(`${folder}/${file}`, 'utf8').matchAll(/^ {2}readonly (on[A-Z]\w*|resource)\?: /gm)].map(
        ([, option]) => `${file} ${option}`,
      ),
    ),
  );
  const tried = Object.keys(LISTENERS).map((name) => name.split(':')[0]);
  expect([...new Set(declared)].sort()).toEqual([...new Set(tried)].sort());
});

describe.each(Object.keys(LISTENERS))('%s', (name) => {
  const call = async (solver: Handlebody, on: () => void) => (LISTENERS[name] as (typeof LISTENERS)[string])(solver, on);

  it('calls, and may throw: the call ends with that, and gives everything back', async () => {
    const { hb, blocks, objects } = await counted();
    const right = await call(hb, dull);
    const thrown = new Error('not now');
    let heard = 0;
    const failing = call(hb, () => {
      heard++;
      throw thrown;
    });
    // What is asked for a file that fails to come is missing, as it is where it was not found.
    if (name.includes('resource'))
      await expect(failing).rejects.toMatchObject({ name: 'HandlebodyError', code: 'file-unreadable' });
    else await expect(failing).rejects.toBe(thrown);
    expect(heard).toBeGreaterThan(0);
    await collect();
    expect([blocks(), objects()]).toEqual([0, 0]);
    expect(await call(hb, dull)).toEqual(right);
  });

  it('may call the same again: both give what one gives', async () => {
    const { hb, blocks, objects } = await counted();
    const right = await call(hb, dull);
    const inner: Promise<unknown>[] = [];
    expect(await call(hb, () => void inner.push(call(hb, dull)))).toEqual(right);
    expect(inner.length).toBeGreaterThan(0);
    for (const each of await Promise.all(inner)) expect(each).toEqual(right);
    await collect();
    expect([blocks(), objects()]).toEqual([0, 0]);
  });

  it.runIf(ofSolver(name))('may end the solver: the call is refused as all later ones, or was done', async () => {
    const { hb } = await counted();
    const right = await call(hb, dull);
    const ended = await call(hb, () => hb.dispose()).catch((error) => error);
    if (ended instanceof Error) expect(ended).toMatchObject({ name: 'HandlebodyError', code: 'disposed' });
    else expect(ended).toEqual(right);
    await expect(call(hb, dull)).rejects.toMatchObject({ name: 'HandlebodyError', code: 'disposed' });
  });
});

/** Calls with a kernel of the caller's. */
const KERNELS: Record<string, (hb: Handlebody, kernel: (s: number) => number) => unknown> = {
  rbf: (hb, kernel) => used(hb.rbf({ ...far, kernel, onWarning: dull }), (f) => [f.evaluate([0.5]), f.gradient([0.5])]),
  'rbf, its derivative': (hb, derivative) =>
    used(hb.rbf({ ...far, kernel: { value: (s) => 1 / (1 + s), derivative }, onWarning: dull }), (f) => f.gradient([0.5])),
  'rbf, its width chosen': (hb, kernel) =>
    used(hb.rbf({ ...far, kernel, width: 'leave-one-out', onWarning: dull }), (f) => f.evaluate([0.5])),
  findOutliers: (hb, kernel) => hb.findOutliers({ ...far, kernel }),
  irbf: (hb, kernel) =>
    used(hb.irbf(body, { kernel }), (irbf) => {
      irbf.setHandles(ends);
      irbf.solve();
      return [irbf.evaluate([1, 0.5, 0.5]), irbf.report().energy];
    }),
};
const smooth = (s: number) => 1 / (1 + s * s);

describe.each(Object.keys(KERNELS))('a kernel of %s', (name) => {
  const call = KERNELS[name] as (typeof KERNELS)[string];

  it.each<[string, (hb: Handlebody) => number, string, string]>([
    [
      'throws',
      () => {
        throw new Error('out of tea');
      },
      'kernel-failed',
      'out of tea',
    ],
    ['calls the same again', (hb) => (call(hb, smooth) ? 1 : 0), 'kernel-failed', 'called the solver'],
    ['gives no number', () => 'one' as unknown as number, 'kernel-failed', 'returned'],
    [
      'ends the solver',
      (hb) => {
        hb.dispose();
        return 1;
      },
      'disposed',
      'disposed',
    ],
  ])('that %s, in any of its calls', async (_, bad, code, told) => {
    const right = call(hb, smooth);
    let calls = 0;
    call(hb, (s) => {
      calls++;
      return smooth(s);
    });
    for (const k of new Set([0, 1, Math.floor(calls / 2), calls - 1])) {
      const { hb, blocks, objects } = await counted();
      let at = 0;
      const failing = () => call(hb, (s) => (at++ === k ? bad(hb) : smooth(s)));
      expect(failing, `in call ${k} of ${calls}`).toThrow(
        expect.objectContaining({ name: 'HandlebodyError', code, message: expect.stringContaining(told) }),
      );
      if (code === 'disposed') continue;
      await collect();
      expect([blocks(), objects()]).toEqual([0, 0]);
      expect(call(hb, smooth)).toEqual(right);
    }
  });
});

it('a signal whose listeners throw, or end in another work, ends what it is given to', async () => {
  const control = new AbortController();
  const heard: unknown[] = [];
  const hear = (error: unknown) => void heard.push(error);
  process.once('uncaughtException', hear);
  control.signal.addEventListener('abort', () => {
    void load({ signal: control.signal }).catch(hear);
    throw new Error('a listener of the page');
  });
  const work = hb.bake(box, { ...small, resolution: 24, signal: control.signal, onProgress: () => control.abort() });
  await expect(work).rejects.toMatchObject({ name: 'HandlebodyError', code: 'aborted' });
  await expect(load({ signal: control.signal })).rejects.toMatchObject({ code: 'aborted' });
  await new Promise((resolve) => setTimeout(resolve, 10));
  process.off('uncaughtException', hear);
  expect(heard).toMatchObject([{ message: 'a listener of the page' }, { code: 'aborted' }].slice(0, heard.length));
  expect(await hb.bake(box, small)).toEqual(body);
});
