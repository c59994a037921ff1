/** GLB reading: what is read, in which order and where it lies; and that no bytes whatsoever do worse than a HandlebodyError. */
import { Document, type Mesh, Primitive } from '@gltf-transform/core';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { hashPositions } from '../../wasm/ts/hash.ts';
import { checkGlb } from '../../web/assets/check-glb.ts';
import { attachBody, attachPoseSpace, readBody, readGlb, readMesh, readPoseSpaces, writeGlb } from '../../web/assets/index.ts';

import { glb } from './support/made-gltf.ts';

const SEED = 20250114;
const { TRIANGLES, TRIANGLE_STRIP, TRIANGLE_FAN, POINTS, LINES } = Primitive.Mode;

interface PrimitiveOptions {
  readonly positions: number[];
  readonly indices?: number[];
  readonly mode?: number;
}

function makePrimitive(document: Document, { positions, indices, mode = TRIANGLES as number }: PrimitiveOptions): Primitive {
  const buffer = document.getRoot().listBuffers()[0] ?? document.createBuffer();
  const primitive = document.createPrimitive().setMode(mode as 4);
  primitive.setAttribute('POSITION', document.createAccessor('', buffer).setType('VEC3').setArray(new Float32Array(positions)));
  if (indices) primitive.setIndices(document.createAccessor('', buffer).setArray(new Uint16Array(indices)));
  return primitive;
}

/** A document with one node for each list of primitives. */
function makeDocument(...nodes: PrimitiveOptions[][]): Document {
  const document = new Document();
  document.createBuffer();
  const scene = document.createScene();
  document.getRoot().setDefaultScene(scene);
  for (const primitives of nodes) {
    const mesh = document.createMesh();
    for (const options of primitives) mesh.addPrimitive(makePrimitive(document, options));
    scene.addChild(document.createNode().setMesh(mesh));
  }
  return document;
}

const TETRAHEDRON = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], indices: [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3] };

/** A triangle of its own in plane z. */
const triangle = (z: number): PrimitiveOptions => ({ positions: [0, 0, z, 1, 0, z, 0, 1, z] });

function volume({ positions: p, triangles }: { positions: ArrayLike<number>; triangles: ArrayLike<number> }): number {
  let six = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const coordinate = (corner: number, axis: number) => p[(triangles[t + corner] as number) * 3 + axis] as number;
    for (let axis = 0; axis < 3; axis++) {
      const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
      six += coordinate(0, axis) * (coordinate(1, u) * coordinate(2, v) - coordinate(1, v) * coordinate(2, u));
    }
  }
  return six / 6;
}

async function codeOf(work: () => unknown): Promise<HandlebodyError> {
  try {
    await work();
  } catch (error) {
    if (error instanceof HandlebodyError) return error;
    throw error;
  }
  throw new Error('nothing was thrown');
}

/** Packs JSON and binary data into a GLB, as they are. */
function pack(json: unknown, bin?: Uint8Array): Uint8Array {
  const text = new TextEncoder().encode(typeof json === 'string' ? json : JSON.stringify(json));
  const chunks: [number, Uint8Array][] = [
    [0x4e4f534a, text.length % 4 ? new Uint8Array([...text, ...Array(4 - (text.length % 4)).fill(32)]) : text],
  ];
  if (bin) chunks.push([0x004e4942, bin]);
  const length = chunks.reduce((sum, [, data]) => sum + 8 + data.length, 12);
  const bytes = new Uint8Array(length);
  const view = new DataView(bytes.buffer);
  [0x46546c67, 2, length].forEach((word, i) => {
    view.setUint32(i * 4, word, true);
  });
  let offset = 12;
  for (const [type, data] of chunks) {
    view.setUint32(offset, data.length, true);
    view.setUint32(offset + 4, type, true);
    bytes.set(data, offset + 8);
    offset += 8 + data.length;
  }
  return bytes;
}

/** The JSON of a sound file with one triangle, changed by `change`, packed. */
// biome-ignore lint/suspicious/noExplicitAny: damaged on purpose
function damaged(change: (json: any) => void): Uint8Array {
  const json = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0, children: [1] }, {}],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
    accessors: [{ bufferView: 0, componentType: 5126, type: 'VEC3', count: 3 }],
    bufferViews: [{ buffer: 0, byteOffset: 0, byteLength: 36 }],
    buffers: [{ byteLength: 36 }],
  };
  change(json);
  return pack(json, new Uint8Array(36));
}

describe('readMesh', () => {
  it('joins the primitives of two nodes in scene order, and says which range is whose', async () => {
    const document = makeDocument([triangle(0), triangle(1)], [triangle(2)]);
    const { mesh, ranges } = readMesh(await readGlb(await writeGlb(document)));
    expect([0, 3, 6].map((vertex) => mesh.positions[vertex * 3 + 2])).toEqual([0, 1, 2]);
    expect([...mesh.triangles]).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8]);
    expect(ranges.map(({ start, count, firstTriangle, triangleCount }) => [start, count, firstTriangle, triangleCount])).toEqual([
      [0, 3, 0, 1],
      [3, 3, 1, 1],
      [6, 3, 2, 1],
    ]);
  });

  it('goes depth first: a node, then its children, then its sister', () => {
    const document = makeDocument([triangle(0)], [triangle(3)]);
    const [first] = document.getRoot().listNodes();
    const [child, grandchild] = [1, 2].map((z) =>
      document.createNode().setMesh(document.createMesh().addPrimitive(makePrimitive(document, triangle(z)))),
    );
    first?.addChild(child as NonNullable<typeof child>);
    child?.addChild(grandchild as NonNullable<typeof grandchild>);
    const { mesh } = readMesh(document);
    expect([0, 3, 6, 9].map((vertex) => mesh.positions[vertex * 3 + 2])).toEqual([0, 1, 2, 3]);
  });

  it('counts a mesh that hangs at two nodes twice, each with its own transform', () => {
    const document = makeDocument([triangle(0)]);
    const mesh = document.getRoot().listMeshes()[0] ?? null;
    document
      .getRoot()
      .listScenes()[0]
      ?.addChild(document.createNode().setMesh(mesh).setTranslation([0, 0, 5]));
    const { mesh: joined } = readMesh(document);
    expect(joined.positions.length).toBe(18);
    expect(joined.positions[11]).toBe(5);
  });

  it('applies the transforms of all nodes above, outermost last', () => {
    const document = makeDocument([{ positions: [1, 0, 0, 0, 1, 0, 0, 0, 1] }]);
    const [node] = document.getRoot().listNodes();
    const half = Math.SQRT1_2;
    const parent = document.createNode().setRotation([0, 0, half, half]).setTranslation([10, 0, 0]);
    document.getRoot().listScenes()[0]?.addChild(parent);
    parent.addChild(node?.setScale([2, 2, 2]) as NonNullable<typeof node>);
    const { positions } = readMesh(document).mesh;
    [10, 2, 0, 8, 0, 0, 10, 0, 2].forEach((expected, i) => {
      expect(positions[i]).toBeCloseTo(expected, 6);
    });
  });

  it('keeps the surface outward where a node mirrors', () => {
    const document = makeDocument([TETRAHEDRON]);
    expect(volume(readMesh(document).mesh)).toBeCloseTo(1 / 6);
    document.getRoot().listNodes()[0]?.setScale([-2, 1, 1]);
    expect(volume(readMesh(document).mesh)).toBeCloseTo(2 / 6);
  });

  it('reads strips, fans and primitives without indices', () => {
    const positions = [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0];
    const strip = readMesh(makeDocument([{ positions, mode: TRIANGLE_STRIP as number }])).mesh;
    expect([...strip.triangles]).toEqual([0, 1, 2, 1, 3, 2, 2, 3, 4]);
    const fan = readMesh(makeDocument([{ positions, indices: [4, 0, 1, 2], mode: TRIANGLE_FAN as number }])).mesh;
    expect([...fan.triangles]).toEqual([4, 0, 1, 4, 1, 2]);
    expect([...readMesh(makeDocument([{ positions }])).mesh.triangles]).toEqual([0, 1, 2]);
  });

  it('skips points and lines without numbering their vertices', () => {
    const other = (mode: number | undefined) => ({ positions: [9, 9, 9, 8, 8, 8], mode: mode as number });
    const document = makeDocument([other(POINTS), triangle(0), other(LINES), triangle(1)]);
    const { mesh } = readMesh(document);
    expect(mesh.positions.length).toBe(18);
    expect([...mesh.triangles]).toEqual([0, 1, 2, 3, 4, 5]);
  });

  it('reads a scene of nothing but points as a cloud', async () => {
    const cloud = (x: number) => ({ positions: [x, 0, 0, x, 1, 0, x, 0, 1], indices: [2, 1], mode: POINTS as number });
    const { mesh, ranges } = readMesh(await readGlb(await writeGlb(makeDocument([cloud(0), cloud(1)], [cloud(2)]))));
    expect(mesh.triangles).toEqual(new Uint32Array());
    // The first point is not drawn, and counts where the first drawn one is.
    expect([...mesh.positions]).toEqual([0, 1, 2].flatMap((x) => [x, 0, 1, x, 1, 0, x, 0, 1]));
    expect(ranges.map(({ start, count, triangleCount }) => [start, count, triangleCount])).toEqual(
      [0, 3, 6].map((at) => [at, 3, 0]),
    );
  });

  it('decodes quantized positions and leaves skinned ones in their bind space', async () => {
    const document = makeDocument([TETRAHEDRON]);
    const primitive = document.getRoot().listMeshes()[0]?.listPrimitives()[0];
    primitive
      ?.getAttribute('POSITION')
      ?.setArray(new Int16Array([0, 0, 0, 32767, 0, 0, 0, 32767, 0, 0, 0, -32768]))
      .setNormalized(true);
    document.getRoot().listNodes()[0]?.setScale([3, 3, 3]);
    const bytes = await writeGlb(document);
    expect([...readMesh(await readGlb(bytes)).mesh.positions]).toEqual([0, 0, 0, 3, 0, 0, 0, 3, 0, 0, 0, -3]);

    const buffer = document.getRoot().listBuffers()[0] ?? null;
    primitive?.setAttribute('JOINTS_0', document.createAccessor('', buffer).setType('VEC4').setArray(new Uint8Array(16)));
    primitive?.setAttribute(
      'WEIGHTS_0',
      document.createAccessor('', buffer).setType('VEC4').setArray(new Float32Array(16).fill(0.25)),
    );
    const joint = document.createNode();
    document.getRoot().listScenes()[0]?.addChild(joint);
    document.getRoot().listNodes()[0]?.setSkin(document.createSkin().addJoint(joint));
    expect([...readMesh(document).mesh.positions]).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -1]);
  });

  it('gives the same bits for the file that is written as for the document, small transforms included', async () => {
    const document = makeDocument([TETRAHEDRON], [TETRAHEDRON]);
    const [a, b] = document.getRoot().listNodes();
    a?.setTranslation([3e-6, 0.1, 1 / 3])
      .setRotation([0.18257418, 0.36514837, 0.54772256, 0.73029674])
      .setScale([1 + 4e-6, 1, 1]);
    b?.setTranslation([0, 6e-6, 0]);
    const before = readMesh(document).mesh;
    const after = readMesh(await readGlb(await writeGlb(document))).mesh;
    expect(after).toEqual(before);
  });

  it.each([
    { type: 'perspective', perspective: { yfov: 1, znear: 0.1 } },
    { type: 'perspective', perspective: { yfov: 0.5, znear: 2, zfar: 100 } },
    { type: 'perspective', perspective: { yfov: 0.5, znear: 2, zfar: 7, aspectRatio: 1.5 } },
    { type: 'orthographic', orthographic: { xmag: 1, ymag: 2, zfar: 50, znear: 0.5 } },
  ])('leaves cameras as far-sighted as they are: %j', async (camera) => {
    const json = { asset: { version: '2.0' }, scenes: [{ nodes: [0] }], nodes: [{ camera: 0 }], cameras: [camera] };
    const written = await writeGlb(await readGlb(glb(json)));
    expect(checkGlb(written).json.cameras).toEqual([camera]);
    expect(checkGlb(await writeGlb(await readGlb(written))).json.cameras).toEqual([camera]);
  });

  it('names the triangle whose index is out of range, and refuses scenes without triangles', async () => {
    const stray = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], indices: [0, 1, 2, 2, 1, 7] };
    const error = await codeOf(() => readMesh(makeDocument([triangle(0), stray])));
    expect(error.code).toBe('mesh-index-out-of-range');
    expect(error.culprit).toEqual({ kind: 'triangle', index: 2 });
    for (const document of [
      new Document(),
      makeDocument(),
      makeDocument([{ positions: [1, 2, 3, 4, 5, 6], mode: LINES as number }]),
    ]) {
      expect((await codeOf(() => readMesh(document))).code).toBe('mesh-no-triangles');
    }
  });
});

describe('checkGlb', () => {
  it.each([
    ['nothing', '', 'empty'],
    ['a .gltf', '{"asset":{"version":"2.0"}}', '.gltf in text form'],
    ['an error page', '<!doctype html><title>404</title>', 'web page'],
    ['a PNG', '\x89PNG\r\n\x1a\n\0\0\0\rIHDR', 'PNG'],
    ['an OBJ', '# made by hand\nv 0 0 0', 'OBJ'],
    ['a PLY', 'ply\nformat ascii 1.0', 'PLY'],
    ['an LFS pointer', 'version https://git-lfs.github.com/spec/v1', 'LFS'],
    ['a ZIP', 'PK\x03\x04', 'ZIP'],
    ['noise', '\x01\x02\x03\x04\x05\x06\x07\x08', 'glTF'],
  ])('says what %s looks like', async (_, text, hint) => {
    const error = await codeOf(() => checkGlb(Uint8Array.from(text, (c) => c.charCodeAt(0))));
    expect(error.code).toBe('file-not-glb');
    expect(error.message).toContain(hint);
    expect(error.remedy).toMatch(/^[A-Z].*\.$/);
  });

  it('reads from a view at any offset, with trailing bytes', async () => {
    const glb = await writeGlb(makeDocument([TETRAHEDRON]));
    const padded = new Uint8Array(glb.length + 9);
    padded.set(glb, 3);
    const { mesh } = readMesh(await readGlb(padded.subarray(3)));
    expect([...mesh.positions]).toEqual(TETRAHEDRON.positions);
  });

  // biome-ignore lint/suspicious/noExplicitAny: damaged on purpose
  it.each<[string, (json: any) => void]>([
    ['a view beyond the buffer', (json) => (json.bufferViews[0].byteOffset = 4)],
    ['a negative offset', (json) => (json.bufferViews[0].byteOffset = -4)],
    ['a huge offset', (json) => (json.accessors[0].byteOffset = 2 ** 60)],
    ['more vertices than there are bytes', (json) => (json.accessors[0].count = 4)],
    ['a count that is no number', (json) => (json.accessors[0].count = '3')],
    ['an unknown component type', (json) => (json.accessors[0].componentType = 5124)],
    ['an inherited name for a type', (json) => (json.accessors[0].type = 'constructor')],
    ['a buffer longer than the file', (json) => (json.buffers[0].byteLength = 1e9)],
    ['a missing accessor', (json) => (json.meshes[0].primitives[0].attributes.POSITION = 9)],
    ['a missing mesh', (json) => (json.nodes[0].mesh = 1)],
    ['a node below itself', (json) => (json.nodes[1].children = [1])],
    ['nodes in a circle', (json) => json.nodes.push({ children: [3] }, { children: [2] })],
    ['a node below two others', (json) => json.nodes.push({ children: [1] })],
    ['a matrix with holes', (json) => (json.nodes[0].matrix = [1, 2, 3])],
    ['a scene of missing nodes', (json) => (json.scenes[0].nodes = [7])],
    ['lists that are none', (json) => (json.nodes = { length: 1 })],
    ['null for a list', (json) => (json.accessors = null)],
    ['too deep a tree', (json) => (json.nodes = Array.from({ length: 5000 }, (_, i) => ({ children: i < 4999 ? [i + 1] : [] })))],
    [
      'sparse values beyond the buffer',
      (json) => {
        json.accessors[0].sparse = {
          count: 3,
          indices: { bufferView: 0, componentType: 5125 },
          values: { bufferView: 0, byteOffset: 8 },
        };
      },
    ],
  ])('refuses %s, naming a byte', async (_, change) => {
    const error = await codeOf(() => readGlb(damaged(change)));
    expect(error.code).toBe('file-invalid');
    expect(error.culprit?.kind).toBe('byte');
  });

  it('accepts the same file undamaged, and names the byte of a syntax error', async () => {
    expect(readMesh(await readGlb(damaged(() => {}))).mesh.positions.length).toBe(9);
    const error = await codeOf(() => checkGlb(pack('{"asset":{"version":"2.0"},}')));
    expect(error.code).toBe('file-invalid');
    expect(error.culprit?.index).toBeGreaterThanOrEqual(20);
  });

  it('refuses to allocate what the file does not hold', async () => {
    const zeros = damaged((json) => (json.accessors[0] = { componentType: 5126, type: 'VEC3', count: 4e9 }));
    expect((await codeOf(() => readGlb(zeros))).code).toBe('mesh-too-large');
    const instances = damaged((json) => {
      json.accessors[0] = { componentType: 5126, type: 'VEC3', count: 8e4 };
      json.nodes = Array.from({ length: 1000 }, () => ({ mesh: 0 }));
      json.scenes[0].nodes = json.nodes.map((_: unknown, i: number) => i);
    });
    const document = await readGlb(instances);
    expect((await codeOf(() => readMesh(document))).code).toBe('mesh-too-large');
  });

  it('says which compression it cannot read, and which files lie elsewhere', async () => {
    const draco = await codeOf(() => readGlb(damaged((json) => (json.extensionsRequired = ['KHR_draco_mesh_compression']))));
    expect([draco.code, draco.message.includes('Draco')]).toEqual(['file-unsupported', true]);
    expect(draco.remedy).toContain('"draco"');
    const other = await codeOf(() => readGlb(damaged((json) => (json.extensionsRequired = ['VENDOR_other']))));
    expect([other.code, other.message.includes('VENDOR_other')]).toEqual(['file-unsupported', true]);
    const outside = await codeOf(() => readGlb(damaged((json) => (json.buffers[0].uri = 'model.bin'))));
    expect([outside.code, outside.message.includes('model.bin')]).toEqual(['file-unsupported', true]);
    const old = await codeOf(() => readGlb(damaged((json) => (json.asset.version = '1.0'))));
    expect(old.code).toBe('file-unsupported');
    const inside = damaged(
      (json) => (json.buffers[0].uri = `data:application/octet-stream;base64,${Buffer.alloc(36).toString('base64')}`),
    );
    expect(readMesh(await readGlb(inside)).mesh.positions.length).toBe(9);
    const garbage = damaged((json) => (json.buffers[0].uri = `data:application/octet-stream;base64,${'!'.repeat(48)}`));
    expect((await codeOf(() => readGlb(garbage))).code).toBe('file-invalid');
  });
});

/** Everything a program would do with a file; anything but a HandlebodyError escapes. */
async function tryAll(bytes: Uint8Array): Promise<string> {
  try {
    const document = await readGlb(bytes);
    readPoseSpaces(document);
    readMesh(document);
    await readBody(document);
    return 'read';
  } catch (error) {
    if (error instanceof HandlebodyError) return error.code;
    throw error;
  }
}

describe('hostile files', async () => {
  const document = makeDocument([TETRAHEDRON, triangle(2)], [triangle(3)]);
  const { mesh } = readMesh(document);
  await attachBody(document, {
    version: 1,
    distance: 'fast-marching',
    mesh,
    positionsHash: hashPositions(mesh.positions),
    normalization: { center: [0, 0, 0], diagonal: 2 },
    grid: { origin: [0, 0, 0], spacing: 0.1, dimensions: [3, 3, 3] },
    voxels: Uint32Array.of(1, 5, 26),
    centers: Uint32Array.of(0, 9),
    distances: Uint16Array.of(0, 1, 2, 3, 4, 5),
    distanceScale: 0.01,
    spheres: Float64Array.of(0.25, 0.25, 0.25, 0.125),
  });
  attachPoseSpace(document, document.getRoot().listMeshes()[0] as Mesh, {
    version: 1,
    dimensions: [{ name: 'valence', min: -1, max: 1 }],
    examples: [{ name: 'neutral', at: [0], weights: [] }],
  });
  const glb = await writeGlb(document);

  it('is read when it is whole', async () => {
    expect(await tryAll(glb)).toBe('read');
  });

  it('is cut off at every byte: file-truncated throughout', async () => {
    const outcomes = new Map<string, number>();
    for (let length = 1; length < glb.length; length++) {
      const outcome = await tryAll(glb.slice(0, length));
      outcomes.set(outcome, (outcomes.get(outcome) ?? 0) + 1);
    }
    expect(Object.fromEntries(outcomes)).toEqual({ 'file-truncated': glb.length - 1 });
  });

  it(`has any of its bytes changed (seed ${SEED})`, async () => {
    const flips = fc.array(fc.record({ at: fc.nat(glb.length - 1), to: fc.nat(255) }), { minLength: 1, maxLength: 6 });
    const outcomes = new Set<string>();
    await fc.assert(
      fc.asyncProperty(flips, async (changes) => {
        const bytes = glb.slice();
        for (const { at, to } of changes) bytes[at] = to;
        outcomes.add(await tryAll(bytes));
      }),
      { seed: SEED, numRuns: 1500 },
    );
    expect([...outcomes]).toEqual(expect.arrayContaining(['read', 'file-invalid', 'body-mismatch']));
  });

  it(`has any value of its JSON replaced (seed ${SEED})`, async () => {
    const { json, bin } = checkGlb(glb);
    const text = JSON.stringify(json);
    const values = [...text.matchAll(/(?<=[:[,])(-?\d[\d.e+-]*|"[^"]*"(?!:)|\[\]|\{\})(?=[,\]}])/g)];
    expect(values.length).toBeGreaterThan(40);
    const replacement = fc.oneof(
      fc.constantFrom(
        '-1',
        '0',
        '1',
        '2',
        '4294967296',
        '1e308',
        '9007199254740993',
        'null',
        '[]',
        '{}',
        '"x"',
        'true',
        '1.5',
        '[[0]]',
      ),
      fc.json(),
    );
    await fc.assert(
      fc.asyncProperty(fc.nat(values.length - 1), replacement, async (which, value) => {
        const match = values[which] as RegExpMatchArray;
        const changed = text.slice(0, match.index) + value + text.slice((match.index ?? 0) + match[0].length);
        await tryAll(pack(changed, bin));
      }),
      { seed: SEED, numRuns: 1500 },
    );
  });

  it(`is random bytes behind a sound header (seed ${SEED})`, async () => {
    await fc.assert(
      fc.asyncProperty(fc.uint8Array({ maxLength: 200 }), async (noise) => {
        expect(await tryAll(noise)).not.toBe('read');
        const framed = new Uint8Array(12 + noise.length);
        new Uint32Array(framed.buffer, 0, 3).set([0x46546c67, 2, framed.length]);
        framed.set(noise, 12);
        expect(await tryAll(framed)).not.toBe('read');
      }),
      { seed: SEED, numRuns: 300 },
    );
  });
});
