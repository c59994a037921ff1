/** Files that ask for more than their bytes justify are refused by name, before anything is made as large as that. */
import { describe, expect, it, vi } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { load } from '../../wasm/ts/index.ts';
import { isDeep, isDeepText, MAX_DEPTH } from '../../web/assets/gltf-json.ts';
import {
  createIo,
  HANDLEBODY_EXTENSIONS,
  readBody,
  readGlb,
  readGltf,
  readMesh,
  readObj,
  readOff,
  readPly,
  readPoseSpaces,
  readStl,
} from '../../web/assets/index.ts';
import { joinVertices } from '../../web/assets/join-vertices.ts';
import { parseDecimal } from '../../web/assets/text-lines.ts';
import { parseHandles } from '../../web/cli/handles.ts';
import { KINDS } from '../bench/hostile/kinds.mjs';
import { triangle } from '../bench/hostile/make.mjs';
import { random } from './support/scattered.ts';

async function endOf(work: () => unknown): Promise<HandlebodyError | undefined> {
  try {
    await work();
    return undefined;
  } catch (error) {
    if (error instanceof HandlebodyError) return error;
    throw error;
  }
}

const READERS: Record<string, (bytes: Uint8Array) => unknown> = {
  readObj,
  readOff,
  readPly,
  readStl,
  glb: async (bytes) => lookInto(await readGlb(bytes)),
  gltf: async (bytes) => lookInto(await readGltf(bytes, { resource: async () => new Uint8Array(1e5) })),
  handles: (bytes) => parseHandles(bytes, { vertexCount: 1 }),
};

async function lookInto(document: Awaited<ReturnType<typeof readGlb>>) {
  readMesh(document, { morphs: 'present' });
  await readBody(document);
  readPoseSpaces(document);
}

describe('the worst known of each kind', () => {
  it.each(Object.entries(KINDS).filter(([, { reader }]) => reader in READERS))('%s', async (_, { reader, make }) => {
    const error = await endOf(() => READERS[reader]?.(make(20_000)));
    if (!error) return;
    expect(error.message.length).toBeLessThan(1000);
    expect(error.remedy).not.toBe('');
  });
});

describe('a file that stands for more than it has', () => {
  const many = (count: number, entry: object) => Array.from({ length: count }, () => entry);
  const nest = (levels: number) => {
    let inner: unknown = 0;
    for (let i = 0; i < levels; i++) inner = i % 2 ? { a: inner } : [inner];
    return inner as object;
  };
  const posed = (examples: number, targets: number) => ({
    extensionsUsed: ['HANDLEBODY_pose_space'],
    meshes: [
      {
        primitives: [{ attributes: { POSITION: 0 }, targets: many(targets, { POSITION: 0 }) }],
        extensions: {
          HANDLEBODY_pose_space: {
            version: 1,
            dimensions: [{ name: 'a', min: 0, max: 1 }],
            examples: many(examples, { name: 'b', at: [0], target: 0 }),
          },
        },
      },
    ],
  });
  it.each<[string, object, string, RegExp]>([
    [
      '89 million vertices that are nowhere',
      { accessors: [{ componentType: 5120, type: 'VEC3', count: 89_478_485 }] },
      'mesh-too-large',
      /1024 MiB/,
    ],
    [
      'vertices that are sparse',
      {
        accessors: [
          {
            componentType: 5126,
            type: 'VEC3',
            count: 1e6,
            sparse: { count: 1, indices: { bufferView: 0, componentType: 5121 }, values: { bufferView: 0 } },
          },
        ],
      },
      'mesh-too-large',
      /11 MiB/,
    ],
    ['20,000 scenes', { scenes: many(20_000, { nodes: [0] }) }, 'mesh-too-large', /20000 scenes; at most 256/],
    ['200,000 nodes', { nodes: many(200_000, {}) }, 'mesh-too-large', /200000 nodes; at most 65536/],
    [
      '70,000 primitives',
      { meshes: [{ primitives: many(70_000, { attributes: { POSITION: 0 } }) }] },
      'mesh-too-large',
      /primitives/,
    ],
    [
      '300 primitives at 300 nodes',
      {
        meshes: [{ primitives: many(300, { attributes: { POSITION: 0 } }) }],
        nodes: many(300, { mesh: 0 }),
        scenes: [{ nodes: Array.from({ length: 300 }, (_, i) => i) }],
      },
      'mesh-too-large',
      /more than 65536 primitives/,
    ],
    ['513 levels of lists', { extras: nest(513) }, 'file-invalid', /nested more than 512 deep/],
    [
      '1,000 levels in an unknown extension',
      { extensionsUsed: ['X_a'], extensions: { X_a: { b: nest(1000) } } },
      'file-invalid',
      /nested more than 512 deep/,
    ],
    ['1,100 examples of 1,100 targets', posed(1100, 1100), 'mesh-too-large', /1100 × 1100 weights/],
  ])('%s', async (_, more, code, message) => {
    const error = await endOf(async () => lookInto(await readGlb(triangle(more))));
    expect(error).toMatchObject({ code, message: expect.stringMatching(message) });
    expect(error?.remedy).toMatch(/\.$/);
  });

  it.each<[string, object]>([
    ['4,000 nodes', { nodes: many(4000, {}).with(0, { mesh: 0 }) }],
    ['256 scenes', { scenes: many(256, { nodes: [0] }) }],
    ['500 levels of lists', { extras: nest(500) }],
    ['1,000 examples of 1,000 targets', posed(1000, 1000)],
    ['a mesh at 2,000 nodes', { nodes: many(2000, { mesh: 0 }), scenes: [{ nodes: Array.from({ length: 2000 }, (_, i) => i) }] }],
  ])('but not %s', async (_, more) => {
    expect(await endOf(async () => lookInto(await readGlb(triangle(more))))).toBeUndefined();
  });

  it('a mesh of 2,000 vertices at 2,000 nodes draws four million of two thousand', async () => {
    const nodes = { nodes: many(2000, { mesh: 0 }), scenes: [{ nodes: Array.from({ length: 2000 }, (_, i) => i) }] };
    const document = await readGlb(triangle(nodes, 2001));
    expect(await endOf(() => readMesh(document))).toMatchObject({
      code: 'mesh-too-large',
      message: expect.stringMatching(/of 2001 that are stored/),
    });
  });

  it('one file that is many buffers goes in once', async () => {
    const bytes = Float32Array.from([0, 0, 0, 1, 0, 0, 0, 1, 0]);
    const buffers = many(500, { uri: 'a.bin', byteLength: 36 });
    const bufferViews = [{ buffer: 499, byteLength: 36 }];
    const gltf = {
      ...JSON.parse(
        new TextDecoder()
          .decode(triangle({}).subarray(20))
          .split('}]}\0')[0]
          ?.split('\0')[0]
          ?.replace(/\s*$/, '')
          .replace(/(}).{0,4}$/s, '$1') ?? '',
      ),
      buffers,
      bufferViews,
    };
    const document = await readGltf(new TextEncoder().encode(JSON.stringify(gltf)), {
      resource: async () => new Uint8Array(bytes.buffer),
    });
    expect([...readMesh(document).mesh.positions]).toEqual([...bytes]);
    expect(document.getRoot().listBuffers()).toHaveLength(1);
  });

  it('nested deeper than can be copied, in an object of somebody’s own I/O', async () => {
    const json = {
      asset: { version: '2.0' },
      meshes: [{ primitives: [], extensions: { HANDLEBODY_pose_space: { a: nest(20_000) } } }],
      extensionsUsed: ['HANDLEBODY_pose_space'],
    };
    const io = createIo().registerExtensions([...HANDLEBODY_EXTENSIONS]);
    await expect(io.readJSON({ json, resources: {} } as never)).rejects.toMatchObject({
      code: 'file-invalid',
      message: expect.stringMatching(/512 deep/),
    });
  });
});

describe('JSON that nests to no end', () => {
  const WORDS = ['[', ']', '{"a":', '"', '\\', '\\"', '\\\\', 'x'];
  it.each(Array.from({ length: 40 }, (_, i) => i + 1))('is told as text as it is once parsed (seed %i)', (seed) => {
    const { number } = random(seed);
    const pick = (n: number) => Math.floor(((number() + 1) / 2) * n) % n;
    const word = () => Array.from({ length: pick(5) }, () => WORDS[pick(WORDS.length)]).join('');
    let inner: unknown = word();
    for (let level = 0; level < MAX_DEPTH - 3 + pick(8); level++) {
      const beside = [word(), [word()], { [word()]: {} }][pick(3)];
      inner = pick(2) ? [beside, inner, word()] : { [word()]: beside, [`in${word()}`]: inner };
    }
    expect(isDeepText(JSON.stringify(inner))).toBe(isDeep(inner));
  });

  it.each([`"${'['.repeat(600)}"`, `"\\\\",${'['.repeat(3)}`, '"', '"\\"', '', ']'.repeat(600)])('%s does not', (text) =>
    expect(isDeepText(text)).toBe(false),
  );

  it.each(['glb: lists in lists', 'gltf: brackets', 'handles: brackets'])('%s: is refused before it is parsed', async (kind) => {
    const parse = vi.spyOn(JSON, 'parse');
    const { make, reader } = KINDS[kind] as (typeof KINDS)[string];
    const error = await endOf(() => READERS[reader]?.(make(20_000)));
    expect(parse).not.toHaveBeenCalled();
    parse.mockRestore();
    expect(error?.message).toMatch(/nested more than 512 deep/);
  });
});

describe('numbers of texts', () => {
  it.each(['1', '+1.', '-.5', '1.5e3', '01', '1e-3'])('%s is one', (word) => expect(parseDecimal(word)).toBe(Number(word)));
  it.each(['', '.', '1.2.3', '1e', 'e1', '1x', '--1', '0x1', '1e400'])('"%s" is none', (word) =>
    expect(parseDecimal(word)).toBeNaN(),
  );
});

it('joins whole numbers, whose floats end in zeros, and finds the first at each place (seed 20261130)', () => {
  const side = 40;
  const places = Float32Array.from({ length: 3 * side ** 3 }, (_, i) => Math.floor(Math.floor(i / 3) / side ** (i % 3)) % side);
  const twice = new Float32Array(2 * places.length);
  twice.set(places);
  twice.set(places, places.length);
  expect(joinVertices(twice)).toEqual(Uint32Array.from({ length: 2 * side ** 3 }, (_, i) => i % side ** 3));
});

it('looks for no more outliers than there are points', async () => {
  const hb = await load();
  const before = hb.memory;
  const points = [0, 0, 1, 0, 0, 1];
  const found = hb.findOutliers({ dimension: 2, points, values: [0, 1, 2], most: 2e8 });
  expect(found.outliers.length).toBeLessThanOrEqual(3);
  expect(hb.memory).toEqual(before);
});
