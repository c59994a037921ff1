/** The same numbers, stored in the many ways of glTF: what is read is what went in, for both readers, and what no reader can read is refused. */
import { type Document, NodeIO } from '@gltf-transform/core';
import { EXTMeshoptCompression, KHRMeshQuantization } from '@gltf-transform/extensions';
import fc from 'fast-check';
import { MeshoptDecoder } from 'meshoptimizer/decoder';
import { MeshoptEncoder } from 'meshoptimizer/encoder';
import { Matrix4, type Mesh, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { beforeAll, describe, expect, it } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { hashPositions } from '../../wasm/ts/hash.ts';
import { type GltfWarning, readGlb, readGltf, readMesh, writeGlb } from '../../web/assets/index.ts';
import { meshFromObject } from '../../web/three/index.ts';
import { loadModel } from '../../web/three/load-model.ts';
import { glb, type MadeFile, type MadeModel, PLACES, STORAGES, store } from './support/made-gltf.ts';
import { FEATURES } from './support/made-models.ts';

beforeAll(() => MeshoptEncoder.ready);

const SEEDS = Array.from({ length: 20 }, (_, i) => i + 1);

const resourceOf = (file: MadeFile) => async (uri: string) => file.beside.get(uri);
const read = (file: MadeFile, onWarning?: (warning: GltfWarning) => void) =>
  (file.isGlb ? readGlb : readGltf)(file.bytes, { resource: resourceOf(file), onWarning });

/** All numbers of a document's meshes, in the order of the file. */
function numbersOf(document: Document) {
  return document
    .getRoot()
    .listMeshes()
    .map((mesh) =>
      mesh.listPrimitives().map((primitive) => ({
        mode: primitive.getMode(),
        indices: primitive.getIndices()?.getArray() ?? undefined,
        attributes: Object.fromEntries(primitive.listSemantics().map((name) => [name, primitive.getAttribute(name)?.getArray()])),
        targets: primitive.listTargets().map((target) => target.getAttribute('POSITION')?.getArray()),
      })),
    );
}

const made = ({ meshes }: MadeModel) =>
  meshes.map(({ primitives }) =>
    primitives.map(({ mode, indices, attributes, targets = [] }) => ({
      mode,
      indices: indices?.array,
      attributes: Object.fromEntries(Object.entries(attributes).map(([name, { array }]) => [name, array])),
      targets: targets.map(({ POSITION }) => POSITION?.array),
    })),
  );

const bufferOf = (bytes: Uint8Array) => Uint8Array.from(bytes).buffer;

async function codeOf(work: () => unknown): Promise<string> {
  try {
    await work();
    return 'read';
  } catch (error) {
    if (error instanceof HandlebodyError) return error.code;
    throw error;
  }
}

describe.each(STORAGES)('numbers that are stored %s', (storage) => {
  it.each(SEEDS)(
    'come out as they went in, wherever the buffers lie, through writing and reading again (seed %i)',
    async (seed) => {
      const features = Object.values(FEATURES);
      const model = (features[seed % features.length] as (typeof features)[number])(seed);
      for (const place of PLACES) {
        const warnings: string[] = [];
        const file = store(model, { seed, storage, place });
        const document = await read(file, ({ code }) => warnings.push(code));
        expect(numbersOf(document)).toEqual(made(model));
        expect(warnings).toEqual(storage.startsWith('meshopt') ? ['decompressed'] : []);
        const { mesh } = readMesh(document);
        const written = await writeGlb(document);
        const again = await readGlb(written);
        expect(numbersOf(again)).toEqual(made(model));
        const { object } = await loadModel(bufferOf(file.bytes), { resource: resourceOf(file) });
        const { object: back } = await loadModel(bufferOf(written));
        const hashes = [readMesh(again).mesh, meshFromObject(object).mesh, meshFromObject(back).mesh].map((each) =>
          hashPositions(each.positions),
        );
        expect(hashes).toEqual(Array(3).fill(hashPositions(mesh.positions)));
      }
    },
  );
});

/** World positions of what is drawn, three a triangle, as three.js has them. */
async function drawnByThree(bytes: Uint8Array): Promise<number[]> {
  const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
  const { scene } = await loader.parseAsync(bufferOf(bytes), '');
  scene.updateMatrixWorld(true);
  const out: number[] = [];
  const point = new Vector3();
  scene.traverse((object) => {
    if (!('isMesh' in object) && !('isPoints' in object)) return;
    const { geometry, matrixWorld } = object as Mesh;
    const { position } = geometry.attributes;
    const corners = geometry.index ? Array.from(geometry.index.array) : Array.from({ length: position?.count ?? 0 }, (_, i) => i);
    const world = new Matrix4().copy(matrixWorld);
    for (const v of corners)
      out.push(
        ...point
          .fromBufferAttribute(position as never, v)
          .applyMatrix4(world)
          .toArray(),
      );
  });
  return out;
}

/** How far the triangles (or points) of two lists lie apart, whichever corner each begins with: mirrored ones are turned round. */
function gap(a: readonly number[], b: readonly number[], size: number): number {
  if (a.length !== b.length) return Number.POSITIVE_INFINITY;
  const orders =
    size === 1
      ? [[0]]
      : [
          [0, 1, 2],
          [1, 2, 0],
          [2, 0, 1],
          [0, 2, 1],
          [2, 1, 0],
          [1, 0, 2],
        ];
  let most = 0;
  for (let at = 0; at < a.length; at += 3 * size) {
    const apart = orders.map((order) =>
      Math.max(
        ...order.flatMap((k, corner) =>
          [0, 1, 2].map((axis) => Math.abs((a[at + 3 * corner + axis] ?? 0) - (b[at + 3 * k + axis] ?? 0))),
        ),
      ),
    );
    most = Math.max(most, Math.min(...apart));
  }
  return most;
}

function diagonal(points: readonly number[]): number {
  const along = (axis: number) => points.filter((_, i) => i % 3 === axis);
  return Math.hypot(...[0, 1, 2].map((axis) => Math.max(...along(axis)) - Math.min(...along(axis))));
}

describe.each(Object.entries(FEATURES))('%s', (_, make) => {
  it.each([3, 14])('is read as three.js draws it, plain and compressed (seed %i)', async (seed) => {
    for (const storage of ['packed', 'interleaved', 'sparse', 'meshopt'] as const) {
      const { bytes } = store(make(seed), { seed, storage, place: 'glb' });
      const { mesh } = readMesh(await readGlb(bytes));
      const isCloud = mesh.triangles.length === 0;
      const corners = isCloud
        ? Array.from(mesh.positions)
        : Array.from(mesh.triangles).flatMap((v) => [...mesh.positions.slice(3 * v, 3 * v + 3)]);
      const size = isCloud ? 1 : 3;
      expect(gap(corners, await drawnByThree(bytes), size)).toBeLessThan(1e-6 * diagonal(corners));
    }
  });
});

describe('meshopt as glTF-Transform writes it', () => {
  const { QUANTIZE, FILTER } = EXTMeshoptCompression.EncoderMethod;
  it.each([QUANTIZE, FILTER].flatMap((method) => SEEDS.map((seed) => [method, seed] as const)))(
    'by %s is read to the bit as glTF-Transform and three.js read it, and stays so (seed %i)',
    async (method, seed) => {
      // Its encoder takes no indices of 8 bits.
      const features = Object.entries(FEATURES).flatMap(([name, make]) => (name === '8-bit indices' ? [] : [make]));
      const plain = await read(
        store((features[seed % features.length] as (typeof features)[number])(seed), { seed, storage: 'packed', place: 'glb' }),
      );
      plain.createExtension(EXTMeshoptCompression).setRequired(true).setEncoderOptions({ method });
      const io = new NodeIO()
        .registerExtensions([EXTMeshoptCompression, KHRMeshQuantization])
        .registerDependencies({ 'meshopt.encoder': MeshoptEncoder, 'meshopt.decoder': MeshoptDecoder });
      const bytes = await io.writeBinary(plain);
      const expected = await io.readBinary(bytes);
      const found = await readGlb(bytes);
      expect(numbersOf(found)).toEqual(numbersOf(expected));
      const written = await writeGlb(found);
      expect(new TextDecoder().decode(written)).not.toContain('meshopt');
      const again = await readGlb(written);
      expect(readMesh(again).mesh).toEqual(readMesh(expected).mesh);
      const { object } = await loadModel(bufferOf(bytes));
      expect(meshFromObject(object).mesh.positions).toEqual(readMesh(expected).mesh.positions);
    },
  );
});

describe('readGltf', () => {
  const file = store(FEATURES['several primitives']?.(1) as MadeModel, { seed: 1, storage: 'packed', place: 'beside' });
  const text = new TextDecoder().decode(file.bytes);

  it('asks for names without percent signs first, and for them as they stand where that fails', async () => {
    const asked: string[] = [];
    const resource = async (uri: string, kind: string) => {
      asked.push(`${kind} ${uri}`);
      return uri.includes('%') ? file.beside.get(decodeURIComponent(uri)) : undefined;
    };
    const document = await readGltf(file.bytes, { resource });
    expect(numbersOf(document)).toHaveLength(1);
    expect(asked[0]).toBe('buffer made data 0.bin');
    expect(asked[1]).toBe('buffer made%20data%200.bin');
  });

  it('names the file that is missing, cut off, or not asked for', async () => {
    const one = (bytes: Uint8Array | undefined) =>
      readGltf(file.bytes, { resource: async (uri) => (uri.includes('1') ? bytes : file.beside.get(uri)) });
    await expect(one(undefined)).rejects.toMatchObject({
      code: 'file-unreadable',
      message: expect.stringContaining('"made data 1.bin"'),
    });
    const short = file.beside.get('made data 1.bin')?.subarray(0, 40);
    await expect(one(short)).rejects.toMatchObject({ code: 'file-truncated', message: expect.stringContaining('40 are there') });
    await expect(readGltf(file.bytes)).rejects.toMatchObject({
      code: 'file-unsupported',
      remedy: expect.stringContaining('resource'),
    });
  });

  it('takes any view of bytes, UTF-16 and byte-order marks', async () => {
    const options = { resource: resourceOf(file) };
    const expected = numbersOf(await readGltf(file.bytes, options));
    const utf16 = new Uint8Array(Uint16Array.from(`\ufeff${text}`, (c) => c.charCodeAt(0)).buffer);
    const swapped = utf16.map((_, i) => utf16[i ^ 1] as number);
    const marked = new TextEncoder().encode(`\ufeff${text}`);
    const padded = new Uint8Array(file.bytes.length + 5);
    padded.set(file.bytes, 5);
    const view = new DataView(padded.buffer, 5);
    for (const bytes of [utf16, swapped, marked, view, Uint8Array.from(file.bytes).buffer])
      expect(numbersOf(await readGltf(bytes, options))).toEqual(expected);
    const whole = store(FEATURES['a strip']?.(2) as MadeModel, { seed: 2, storage: 'packed', place: 'glb' });
    for (const reader of [readGlb, readGltf]) expect(numbersOf(await reader(Uint8Array.from(whole.bytes).buffer))).toHaveLength(1);
  });

  it('is not what readGlb reads, which says so', async () => {
    await expect(readGlb(file.bytes)).rejects.toMatchObject({ code: 'file-not-glb', remedy: expect.stringContaining('readGltf') });
    await expect(readGltf(new TextEncoder().encode(text.slice(0, 200)))).rejects.toMatchObject({ code: 'file-truncated' });
    await expect(readGltf(new TextEncoder().encode(text.replace('"asset"', 'asset')))).rejects.toMatchObject({
      code: 'file-invalid',
    });
  });
});

describe('images', () => {
  const PIXEL = Buffer.from(
    'iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==',
    'base64',
  );
  const withImage = (image: object) =>
    new TextEncoder().encode(
      JSON.stringify({
        asset: { version: '2.0' },
        images: [image],
        textures: [{ source: 0 }],
        materials: [{ emissiveTexture: { index: 0 } }],
      }),
    );
  const textureOf = (document: Document) => document.getRoot().listTextures()[0];

  it('come from data URIs and files, by what they are', async () => {
    for (const [image, resource] of [
      [{ uri: `data:image/png;base64,${PIXEL.toString('base64')}` }, undefined],
      [{ uri: `DATA:;BASE64,${PIXEL.toString('base64url')}` }, undefined],
      [{ uri: 'wrong%20name.jpg' }, async (uri: string) => (uri === 'wrong name.jpg' ? new Uint8Array(PIXEL) : undefined)],
    ] as const) {
      const document = await readGltf(withImage(image), { resource });
      expect([textureOf(document)?.getMimeType(), Buffer.from(textureOf(document)?.getImage() ?? []).equals(PIXEL)]).toEqual([
        'image/png',
        true,
      ]);
      expect(textureOf(await readGlb(await writeGlb(document)))?.getImage()).toHaveLength(PIXEL.length);
    }
  });

  it('that are not to be had stay names, with which a GLB is not written', async () => {
    const document = await readGltf(withImage({ uri: 'skin.png' }));
    expect(textureOf(document)?.getURI()).toBe('skin.png');
    await expect(writeGlb(document)).rejects.toMatchObject({
      code: 'file-unsupported',
      message: expect.stringContaining('"skin.png"'),
    });
    const failing = async () => Promise.reject(new Error('the disk is gone'));
    await expect(readGltf(withImage({ uri: 'skin.png' }), { resource: failing })).rejects.toMatchObject({
      code: 'file-unreadable',
      message: expect.stringMatching(/"skin.png" \(images\[0\]\.uri\).*the disk is gone/),
    });
  });
});

describe('hostile files', () => {
  const options = { seed: 7, place: 'glb' } as const;
  const model = FEATURES['several primitives']?.(7) as MadeModel;
  const sound = {
    meshopt: store(model, { ...options, storage: 'meshopt' }),
    beside: store(model, { ...options, storage: 'sparse', place: 'mixed' }),
  };
  const tryAll = (bytes: Uint8Array, file: MadeFile) =>
    codeOf(async () => readMesh(await readGltf(bytes, { resource: resourceOf(file) })));

  beforeAll(async () => {
    for (const file of Object.values(sound)) expect(await tryAll(file.bytes, file)).toBe('read');
  });

  const partsOf = ({ bytes, isGlb }: MadeFile) => {
    if (!isGlb) return { json: JSON.parse(new TextDecoder().decode(bytes)), bin: undefined };
    const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(12, true);
    return { json: JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length))), bin: bytes.subarray(28 + length) };
  };

  it.each(Object.entries(sound))('%s: any bytes changed, or cut off (seed 20250115)', async (_, file) => {
    const changes = fc.record({
      flips: fc.array(fc.record({ at: fc.nat(file.bytes.length - 1), to: fc.nat(255) }), { minLength: 1, maxLength: 4 }),
      length: fc.option(fc.nat(file.bytes.length), { freq: 4 }),
    });
    const outcomes = new Set<string>();
    await fc.assert(
      fc.asyncProperty(changes, async ({ flips, length }) => {
        const bytes = file.bytes.slice();
        for (const { at, to } of flips) bytes[at] = to;
        outcomes.add(await tryAll(bytes.subarray(0, length ?? bytes.length), file));
      }),
      { seed: 20250115, numRuns: 1000 },
    );
    expect(outcomes.size).toBeGreaterThan(1);
  });

  it.each(Object.entries(sound))('%s: any value of its JSON replaced (seed 20250116)', async (_, file) => {
    const { json, bin } = partsOf(file);
    const text = JSON.stringify(json);
    const values = [...text.matchAll(/(?<=[:[,])(-?\d[\d.e+-]*|"[^"]*"(?!:)|\[\]|\{\})(?=[,\]}])/g)];
    const replacement = fc.oneof(
      fc.constantFrom(
        '-1',
        '0',
        '1',
        '3',
        '256',
        '4294967296',
        '1e308',
        '9007199254740993',
        'null',
        '[]',
        '{}',
        '"x"',
        '"data:,"',
        'true',
        '1.5',
      ),
      fc.json(),
    );
    await fc.assert(
      fc.asyncProperty(fc.nat(values.length - 1), replacement, async (which, value) => {
        const match = values[which] as RegExpMatchArray;
        const changed = text.slice(0, match.index) + value + text.slice((match.index ?? 0) + match[0].length);
        const parsed = JSON.parse(changed);
        await tryAll(bin ? glb(parsed, bin) : new TextEncoder().encode(changed), file);
      }),
      { seed: 20250116, numRuns: 1000 },
    );
  });

  // biome-ignore lint/suspicious/noExplicitAny: damaged on purpose
  const damagedMeshopt = (change: (extension: any, json: any) => void) => {
    const { json, bin } = partsOf(sound.meshopt);
    // biome-ignore lint/suspicious/noExplicitAny: damaged on purpose
    const view = json.bufferViews.find((each: any) => each.extensions.EXT_meshopt_compression.mode === 'ATTRIBUTES');
    change(view.extensions.EXT_meshopt_compression, json);
    return glb(json, bin);
  };

  // biome-ignore lint/suspicious/noExplicitAny: damaged on purpose
  it.each<[string, (extension: any, json: any) => void, string?]>([
    ['of no known mode', (stream) => (stream.mode = 'constructor')],
    ['of an inherited filter', (stream) => (stream.filter = 'toString')],
    ['whose filter wants another stride', (stream) => (stream.filter = 'QUATERNION')],
    ['of odd elements', (stream) => (stream.byteStride = 10)],
    ['of huge elements', (stream) => (stream.byteStride = 1 << 20)],
    ['that counts less than its view', (stream) => (stream.count -= 1)],
    ['that counts more than it can hold', (stream) => (stream.count = 1e9)],
    ['that counts in fractions', (stream) => (stream.count = 1.5)],
    ['that begins before its buffer', (stream) => (stream.byteOffset = -4)],
    ['that ends behind its buffer', (stream) => (stream.byteLength = 1e6)],
    ['without its last byte', (stream) => (stream.byteLength -= 1)],
    ['in no buffer', (stream) => (stream.buffer = 9)],
    ['in the buffer that is not there', (stream) => (stream.buffer = 1), 'file-truncated'],
    ['shorter than its view', (_, json) => (json.bufferViews[0].byteLength += 4)],
    ['read past its end', (_, json) => (json.accessors[0].count += 1)],
    [
      'that stands for far more than the file',
      (stream, json) => {
        const extension = { ...stream, count: stream.byteLength * 256, byteStride: 256 };
        json.bufferViews = Array.from({ length: 1000 }, () => ({
          buffer: 1,
          byteLength: 1,
          extensions: { EXT_meshopt_compression: extension },
        }));
      },
      'mesh-too-large',
    ],
  ])('refuses a stream %s', async (_, change, code = 'file-invalid') => {
    expect(await codeOf(() => readGlb(damagedMeshopt(change)))).toBe(code);
    expect(await codeOf(() => loadModel(bufferOf(damagedMeshopt(change))))).toBe(code);
  });
});
