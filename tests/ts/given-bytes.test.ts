// Bytes and bodies that are given stay the caller's, where files are read and written: overwritten, or handed to another thread, while the
// work goes on, they change nothing; those that are gone already are refused by a typed error.
import { describe, expect, it } from 'vitest';
import { type BodyData, HandlebodyError, load } from '../../wasm/ts/index.ts';
import {
  attachBody,
  meshDocument,
  readBody,
  readGlb,
  readGltf,
  readMesh,
  readObj,
  readOff,
  readPly,
  readStl,
  writeGlb,
} from '../../web/assets/index.ts';
import { boxMesh } from './support/shapes.ts';

const hb = await load();
const body = await hb.bake(boxMesh([2, 1, 1], [4, 2, 2]), { centers: 8, resolution: 16, spheres: 6 });
const GLB = await writeGlb(body.mesh, { body });
const positions = Float32Array.from(body.mesh.positions);
const GLTF = new TextEncoder().encode(
  JSON.stringify({
    asset: { version: '2.0' },
    scenes: [{ nodes: [0, 1] }],
    nodes: [{ mesh: 0 }, { mesh: 1 }],
    meshes: [
      { primitives: [{ mode: 0, attributes: { POSITION: 0 } }] },
      { primitives: [{ mode: 0, attributes: { POSITION: 1 } }] },
    ],
    accessors: [0, 1].map((bufferView) => ({
      bufferView,
      componentType: 5126,
      type: 'VEC3',
      count: 4,
      min: [0, 0, 0],
      max: [2, 1, 1],
    })),
    bufferViews: [0, 1].map((buffer) => ({ buffer, byteLength: 48 })),
    buffers: ['a', 'b'].map((uri) => ({ uri, byteLength: 48 })),
  }),
);

type Numbers = ArrayBufferView<ArrayBuffer> & { fill(value: number): unknown };

const overwrite = (arrays: readonly Numbers[]) => {
  for (const array of arrays) array.fill(1);
};
const handOver = (arrays: readonly Numbers[]) => {
  for (const array of arrays) if (array.buffer.byteLength > 0) structuredClone(null, { transfer: [array.buffer] });
};

const copyOf = () => structuredClone(body);
const arraysOf = ({ mesh, voxels, centers, distances, spheres }: BodyData) =>
  [mesh.positions, mesh.triangles, voxels, centers, distances, spheres] as unknown as Numbers[];
const part = (which: 0 | 1) => new Uint8Array(positions.slice(12 * which, 12 * which + 12).buffer);
const readGltfOf = async (text: Uint8Array, resource: (uri: string) => Promise<Uint8Array>) =>
  Array.from(readMesh(await readGltf(text, { resource })).mesh.positions);

/** What is given, and what comes of it in the end. */
const CALLS: Record<string, () => { readonly given: readonly Numbers[]; readonly run: () => Promise<unknown> }> = {
  readGlb: () => {
    const given = GLB.slice() as Uint8Array<ArrayBuffer>;
    return { given: [given], run: async () => readBody(await readGlb(given)) };
  },
  'readGltf, its text': () => {
    const given = GLTF.slice();
    return { given: [given], run: () => readGltfOf(given, async (uri) => part(uri === 'a' ? 0 : 1)) };
  },
  attachBody: () => {
    const given = copyOf();
    const run = async () => {
      const document = meshDocument(body.mesh);
      await attachBody(document, given);
      return writeGlb(document);
    };
    return { given: arraysOf(given), run };
  },
  'writeGlb of a mesh with its body': () => {
    const given = copyOf();
    return { given: arraysOf(given), run: () => writeGlb(given.mesh, { body: given }) };
  },
};

const TIMES: Record<string, () => Promise<unknown>> = {
  'as soon as it was called': () => Promise.resolve(),
  'a turn later': async () => undefined,
  'two turns later': async () => {
    await undefined;
    await undefined;
  },
  'an event later': () => new Promise((resolve) => setTimeout(resolve)),
};

describe.each(Object.keys(CALLS))('%s', (name) => {
  const made = () => (CALLS[name] as (typeof CALLS)[string])();

  it.each([overwrite, handOver].flatMap((change) => Object.keys(TIMES).map((time) => ({ change, how: change.name, time }))))(
    'takes what was given: $how $time',
    async ({ change, time }) => {
      const right = await made().run();
      const { given, run } = made();
      const work = run();
      if (time !== 'as soon as it was called') await TIMES[time]?.();
      change(given);
      expect(await work).toEqual(right);
    },
  );
});

it('takes files that are read one after another into the same memory', async () => {
  const right = await readGltfOf(GLTF, async (uri) => part(uri === 'a' ? 0 : 1));
  const scratch = new Uint8Array(48);
  const read = await readGltfOf(GLTF, async (uri) => {
    scratch.set(part(uri === 'a' ? 0 : 1));
    return scratch;
  });
  expect(read).toEqual(right);
  expect(right.slice(0, 12)).not.toEqual(right.slice(12));
});

describe('bytes that are gone', () => {
  const READERS = { readGlb, readGltf, readObj, readPly, readStl, readOff };
  const GIVEN: Record<string, () => ArrayBuffer | ArrayBufferView<ArrayBuffer>> = {
    'an ArrayBuffer': () => new ArrayBuffer(64),
    'a typed array': () => new Uint8Array(64),
    'a part of one': () => new Uint8Array(new ArrayBuffer(64), 8, 16),
    'a DataView': () => new DataView(new ArrayBuffer(64), 4),
    'a Buffer': () => Buffer.from(new ArrayBuffer(64)),
  };

  it.each(Object.keys(READERS).flatMap((reader) => Object.keys(GIVEN).map((what) => [reader, what] as const)))(
    'are refused by %s: %s',
    async (reader, what) => {
      const given = (GIVEN[what] as () => ArrayBuffer)();
      structuredClone(null, { transfer: [ArrayBuffer.isView(given) ? (given as { buffer: ArrayBuffer }).buffer : given] });
      const error = await (async () => READERS[reader as keyof typeof READERS](given))().catch((thrown: unknown) => thrown);
      expect(error).toBeInstanceOf(HandlebodyError);
      expect((error as HandlebodyError).code).toBe('file-not-bytes');
    },
  );
});
