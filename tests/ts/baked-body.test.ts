/** How bodies are stored: without loss, small, the same bytes every time, and without harm when they are damaged. */
import { gzipSync } from 'node:zlib';
import { Document, Primitive } from '@gltf-transform/core';
import fc from 'fast-check';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { beforeAll, describe, expect, it, onTestFinished, vi } from 'vitest';
import { type BodyData, HandlebodyError, type Irbf, load } from '../../wasm/ts/index.ts';
import { decodeBody, encodeBody } from '../../web/assets/body-codec.ts';
import { checkGlb } from '../../web/assets/check-glb.ts';
import { attachBody, HANDLEBODY_BODY, readBody, readGlb, readMesh, writeGlb } from '../../web/assets/index.ts';
import { addPredictions, fromLanes, predictionMisses, toLanes } from '../../web/assets/predict-distances.ts';
import { parseBodyHeader } from '../../web/assets/schema.ts';
import { countInRuns, fromRuns, toRuns } from '../../web/assets/voxel-runs.ts';
import { inWordsAtOnce } from '../../web/assets/words-at-once.ts';
import { handlebodyData, handlebodyPlugin } from '../../web/three/index.ts';
import { loadModel } from '../../web/three/load-model.ts';
import { dogHandles, readDog, readDogBytes } from './support/dog.ts';
import { boxMesh } from './support/shapes.ts';

const SEED = 20260511;

/** Any voxels of any small grid, ascending, and any codes on them. */
const fields = fc
  .record({
    dimensions: fc.tuple(fc.integer({ min: 1, max: 7 }), fc.integer({ min: 1, max: 6 }), fc.integer({ min: 1, max: 5 })),
    part: fc.double({ min: 0.05, max: 1, noNaN: true }),
    centers: fc.integer({ min: 1, max: 6 }),
    noise: fc.infiniteStream(fc.nat(0xffff)),
  })
  .map(({ dimensions, part, centers, noise }) => {
    const next = () => noise.next().value as number;
    const cells = dimensions.reduce((product, n) => product * n, 1);
    const inside = Array.from({ length: cells }, (_, i) => i).filter(() => next() <= part * 0xffff);
    const voxels = Uint32Array.from(inside.length > 0 ? inside : [cells - 1]);
    return { dimensions, centers, voxels, codes: Uint16Array.from({ length: voxels.length * centers }, next) };
  });

describe('what a body is stored as', () => {
  it(`undoes itself, whatever the numbers (seed ${SEED})`, () => {
    fc.assert(
      fc.property(fields, ({ codes, ...layout }) => {
        const lanes = toLanes(predictionMisses(codes, layout));
        const back = fromLanes(lanes, codes.length);
        addPredictions(back, layout);
        expect(back).toEqual(codes);
        const runs = toRuns(layout.voxels);
        expect(countInRuns(runs, (layout.voxels.at(-1) ?? 0) + 1)).toBe(layout.voxels.length);
        expect(countInRuns(runs, layout.voxels.at(-1) ?? 0)).toBeNaN();
        expect(fromRuns(runs, layout.voxels.length)).toEqual(layout.voxels);
      }),
      { seed: SEED, numRuns: 300 },
    );
  });

  it('misses nothing where the field is a plane, but for its first voxel and line', () => {
    const dimensions = [6, 5, 4] as const;
    const voxels = Uint32Array.from({ length: 120 }, (_, i) => i);
    const codes = Uint16Array.from(voxels, (i) => 500 + 7 * (i % 6) + 11 * (Math.floor(i / 6) % 5) + 13 * Math.floor(i / 30));
    const misses = predictionMisses(codes, { voxels, dimensions, centers: 1 });
    // The first voxel has nothing before it; the second of a row, and the first of the second row and layer, have one voxel.
    expect([...misses].filter((miss) => miss !== 0)).toEqual([500, 7, 11, 13]);
  });
});

describe('the dog as served', async () => {
  const hb = await load();
  let bytes: Uint8Array;
  let served: BodyData;
  let stored: Awaited<ReturnType<typeof encodeBody>>;

  beforeAll(async () => {
    bytes = readDogBytes();
    served = await readDog();
    stored = await encodeBody(served);
  });

  it('takes 3 MB at most, gzipped, with its geometry and texture', () => {
    expect(served.version).toBe(2);
    expect(gzipSync(bytes, { level: 9 }).length).toBeLessThan(3_000_000);
  });

  it('gives the same bytes when it is read and written again', async () => {
    const document = await readGlb(bytes);
    const written = await writeGlb(document);
    await attachBody(document, (await readBody(document)) as BodyData);
    expect(Buffer.from(await writeGlb(document)).equals(written)).toBe(true);
    expect(Buffer.from(await writeGlb(await readGlb(written))).equals(written)).toBe(true);
  });

  it('names where it wants to be held', () => {
    expect(served.handles?.map(({ name }) => name)).toEqual([
      'Front right paw',
      'Front left paw',
      'Back right paw',
      'Back left paw',
      'Nose',
      'Tail tip',
    ]);
    const handles = [{ name: 'Chest', at: [0, 0.5, 0] }];
    expect(parseBodyHeader({ ...served, handles }).handles).toEqual(handles);
  });

  it.each<[unknown, RegExp]>([
    [{}, /no list of at most 1000 handles/],
    [Array.from({ length: 1001 }, () => ({ name: '', vertex: 0 })), /no list of at most 1000 handles/],
    [[{ vertex: 1 }], /handles\[0\]\.name/],
    [[{ name: 'a', vertex: -1 }], /handle 0 on no vertex, -1/],
    [[{ name: 'a', vertex: 1.5 }], /handle 0 on no vertex/],
    [[{ name: 'a', at: [0, 1, null] }], /handles\[0\]\.at/],
    [[null], /handles\[0\]\.name/],
  ])('is refused with handles that are none: %j', (handles, said) => {
    expect(() => inWordsAtOnce(() => parseBodyHeader({ ...served, handles }))).toThrow(said);
  });

  it('is refused with a handle on a vertex that it has not', async () => {
    const document = await readGlb(bytes);
    const body = { ...served, handles: [{ name: 'Wing', vertex: served.mesh.positions.length / 3 }] };
    await expect(attachBody(document, body)).rejects.toThrow('“Wing”');
  });

  it('is decompressed to the codes that were baked', async () => {
    const header = { ...parseBodyHeader(served), arraysHash: stored.arraysHash };
    const body = await decodeBody({ header, arrays: stored.arrays, mesh: () => served.mesh });
    expect(Buffer.compare(new Uint8Array(body.distances.buffer), new Uint8Array(served.distances.buffer))).toBe(0);
  });

  /** Deformed by all six handles. */
  const deformed = (body: BodyData): Float32Array => {
    const irbf: Irbf = hb.irbf(body);
    irbf.setHandles(Object.values(dogHandles(body.mesh.positions)).map((vertex) => ({ vertex })));
    const { diagonal } = body.normalization;
    for (const [k, way] of [
      [0.12, 0.12, 0],
      [0, 0, 0],
      [-0.03, 0.06, 0.04],
      [0, 0, 0],
      [-0.04, 0.08, 0.06],
      [0.02, 0.1, 0.05],
    ].entries())
      for (const [axis, part] of way.entries()) irbf.targets[10 * k + axis] = (irbf.targets[10 * k + axis] ?? 0) + part * diagonal;
    irbf.solve();
    const out = new Float32Array(irbf.vertexCount * 3);
    irbf.deform(out);
    irbf.dispose();
    return out;
  };

  // Storing loses nothing of the bake's sixteen bits, so what is left to show is that sixteen bits are enough: what a second rounding,
  // as coarse as the bake's, moves, is as much as the first one did.
  it('deforms within a thousandth of its diagonal of what it would without rounding', () => {
    const step = served.distanceScale * 1.0123;
    const rounded = served.distances.map((code) => Math.round((code * served.distanceScale) / step));
    const [a, b] = [deformed(served), deformed({ ...served, distances: rounded, distanceScale: step })];
    let [most, moved] = [0, 0];
    for (let i = 0; i < a.length; i += 3) {
      const way = (other: ArrayLike<number>) =>
        Math.hypot(...[0, 1, 2].map((k) => (a[i + k] as number) - (other[i + k] as number)));
      most = Math.max(most, way(b));
      moved = Math.max(moved, way(served.mesh.positions));
    }
    expect(moved / served.normalization.diagonal).toBeGreaterThan(0.1);
    expect(most / served.normalization.diagonal).toBeLessThan(1e-3);
  });
});

/** A document of one box, or of its corners alone. */
function boxDocument(mode: 'surface' | 'cloud'): Document {
  const document = new Document();
  const buffer = document.createBuffer();
  const { positions, triangles } = boxMesh([2, 1, 1], [4, 2, 2]);
  const primitive = document
    .createPrimitive()
    .setAttribute('POSITION', document.createAccessor('', buffer).setType('VEC3').setArray(Float32Array.from(positions)));
  if (mode === 'surface') primitive.setIndices(document.createAccessor('', buffer).setArray(Uint16Array.from(triangles)));
  else primitive.setMode(Primitive.Mode.POINTS as 0);
  const node = document
    .createNode()
    .setMesh(document.createMesh().addPrimitive(primitive))
    .setTranslation([0.1, 1 / 3, 0]);
  document.getRoot().setDefaultScene(document.createScene().addChild(node));
  return document;
}

/** With the numbers that files keep as floats. */
function asFloats(body: BodyData): BodyData {
  const floats = (numbers: Float64Array) => Float64Array.from(numbers, Math.fround);
  const { skeleton } = body;
  return { ...body, spheres: floats(body.spheres), ...(skeleton && { skeleton: { ...skeleton, nodes: floats(skeleton.nodes) } }) };
}

const bakeOptions = { centers: 6, resolution: 8, spheres: 4 };

async function loadPlainly(bytes: Uint8Array): Promise<BodyData | undefined> {
  const loader = new GLTFLoader().register(handlebodyPlugin);
  return handlebodyData(await loader.parseAsync(Uint8Array.from(bytes).buffer as ArrayBuffer, '')).body;
}

describe('a cloud', () => {
  it('carries a body as a surface does, for both readers', async () => {
    const hb = await load();
    const baked = await hb.bake(readMesh(boxDocument('surface')).mesh, bakeOptions);
    const document = boxDocument('cloud');
    const { mesh } = readMesh(document);
    expect(mesh.triangles.length).toBe(0);
    await attachBody(document, { ...baked, mesh });
    const bytes = await writeGlb(document);
    const back = await readBody(await readGlb(bytes));
    expect(back).toEqual(asFloats({ ...baked, mesh }));
    expect(await loadPlainly(bytes)).toEqual(back);
  });
});

describe('a damaged body', async () => {
  const document = boxDocument('surface');
  const baked = await (await load()).bake(readMesh(document).mesh, bakeOptions);
  await attachBody(document, baked);
  const whole = await writeGlb(document);
  const { json } = checkGlb(whole);
  const binStart = whole.length - ((json.buffers as { byteLength: number }[])[0]?.byteLength ?? 0);

  const asRead = asFloats(baked);

  /** Where an array of the body lies in the file. */
  const range = (name: string): [number, number] => {
    const accessors = json.accessors as {
      bufferView: number;
      byteOffset?: number;
      count: number;
      componentType: number;
      type: string;
    }[];
    const extension = (json.extensions as Record<string, Record<string, number>>)[HANDLEBODY_BODY] ?? {};
    const accessor = accessors[extension[name] ?? -1];
    if (!accessor) throw new Error(`no accessor for ${name}`);
    const view = (json.bufferViews as { byteOffset?: number }[])[accessor.bufferView];
    const start = binStart + (view?.byteOffset ?? 0) + (accessor.byteOffset ?? 0);
    return [start, start + accessor.count * (accessor.componentType === 5121 ? 1 : 4) * (accessor.type === 'VEC4' ? 4 : 1)];
  };

  const outcome = async (read: () => Promise<unknown>): Promise<string> => {
    try {
      return (await read()) === undefined ? 'no body' : 'body';
    } catch (error) {
      if (error instanceof HandlebodyError) return error.code;
      throw error;
    }
  };
  const viaDocument = (bytes: Uint8Array) => outcome(async () => readBody(await readGlb(bytes)));
  /** What the studio does: checks first, then three.js. */
  const viaStudio = (bytes: Uint8Array) =>
    outcome(async () => (await loadModel(Uint8Array.from(bytes).buffer as ArrayBuffer)).body);

  it('is read when it is whole', async () => {
    expect(await viaDocument(whole)).toBe('body');
    expect(await viaStudio(whole)).toBe('body');
    expect(await readBody(await readGlb(whole))).toEqual(asRead);
  });

  it(`gives the body as it was or a typed error when bytes of it change, in both readers alike (seed ${SEED})`, async () => {
    const places = (['voxels', 'centers', 'order', 'distances', 'spheres'] as const).map((name) => {
      const [start, end] = range(name);
      return fc.integer({ min: start, max: end - 1 });
    });
    const flips = fc.array(fc.record({ at: fc.oneof(...places), to: fc.nat(255) }), { minLength: 1, maxLength: 3 });
    const outcomes = new Set<string>();
    await fc.assert(
      fc.asyncProperty(flips, async (changes) => {
        const bytes = whole.slice();
        for (const { at, to } of changes) bytes[at] = to;
        let body: BodyData | undefined;
        const result = await outcome(async () => {
          body = await readBody(await readGlb(bytes));
          return body;
        });
        outcomes.add(result);
        if (result === 'body') expect(body).toEqual(asRead);
        // Without the studio's check in front: the plugin alone has to find what is wrong with the body.
        expect(await outcome(() => loadPlainly(bytes))).toBe(result);
      }),
      { seed: SEED, numRuns: 600 },
    );
    expect([...outcomes].sort()).toEqual(['body', 'body-invalid']);
  });

  it(`gives a body or a typed error when any bytes of the file change (seed ${SEED})`, async () => {
    const flips = fc.array(fc.record({ at: fc.nat(whole.length - 1), to: fc.nat(255) }), { minLength: 1, maxLength: 4 });
    await fc.assert(
      fc.asyncProperty(flips, async (changes) => {
        const bytes = whole.slice();
        for (const { at, to } of changes) bytes[at] = to;
        expect(await viaDocument(bytes)).toEqual(expect.any(String));
        expect(await viaStudio(bytes)).toEqual(expect.any(String));
      }),
      { seed: SEED, numRuns: 400 },
    );
  });

  it('says so when memory runs out', async () => {
    const { arrays, arraysHash } = await encodeBody(baked);
    const full = class {
      constructor() {
        throw new RangeError('Array buffer allocation failed');
      }
    };
    vi.stubGlobal('Uint16Array', full);
    onTestFinished(() => void vi.unstubAllGlobals());
    const reading = decodeBody({ header: { ...parseBodyHeader(baked), arraysHash }, arrays, mesh: () => baked.mesh });
    await expect(reading).rejects.toMatchObject({ code: 'out-of-memory' });
  });

  it('is refused when its compressed distances are cut, lengthened or those of another body', async () => {
    const { arrays: stored, arraysHash } = await encodeBody(baked);
    const header = { ...parseBodyHeader(baked), arraysHash };
    const read = (distances: Uint8Array) =>
      outcome(() => decodeBody({ header, arrays: { ...stored, distances }, mesh: () => baked.mesh }));
    expect(await read(stored.distances)).toBe('body');
    for (let length = 0; length < stored.distances.length; length++) {
      expect(await read(stored.distances.slice(0, length)), `${length} bytes`).toBe('body-invalid');
    }
    expect(await read(Uint8Array.of(...stored.distances, 0))).toBe('body-invalid');
    const other = await encodeBody({
      ...baked,
      centers: baked.centers.slice(0, 5),
      distances: baked.distances.slice(0, 5 * baked.voxels.length),
    });
    expect(await read(other.arrays.distances)).toBe('body-invalid');
  });
});
