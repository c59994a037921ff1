/** What is wrong with a file is told with its place: a byte, a line, or where in the JSON. Every fault that readers know is made to happen. */
import { describe, expect, test } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { hashPositions } from '../../wasm/ts/hash.ts';
import { Fault } from '../../web/assets/fault.ts';
import { FAULTS, worded } from '../../web/assets/fault-words.ts';
import { splitGlb } from '../../web/assets/glb-chunks.ts';
import { meshDocument, readGltf, readMesh, readObj, readOff, readPly, readStl } from '../../web/assets/index.ts';
import { parsePoseSpace } from '../../web/assets/pose-space-schema.ts';
import { checkBody, checkStored, parseBodyHeader, parseStoredHeader } from '../../web/assets/schema.ts';
import { verifyGltf } from '../../web/assets/verify-gltf.ts';
import { parseHandles } from '../../web/cli/handles.ts';
import { readHandles } from '../../web/studio/handles-json.ts';

type Row = readonly [fault: keyof typeof FAULTS, place: string, work: () => unknown];

const asset = { version: '2.0' };
const gltf = (fault: Row[0], place: string, json: object, options = {}): Row => [
  fault,
  place,
  () => verifyGltf({ asset, ...json }, options),
];
const nest = (levels: number): unknown => (levels === 0 ? 0 : [nest(levels - 1)]);
const chain = (length: number) => Array.from({ length }, (_, i) => (i + 1 < length ? { children: [i + 1] } : {}));
const accessor = { componentType: 5126, type: 'SCALAR', count: 1 };
const buffers = [{ byteLength: 8 }];
const views = { buffers, bufferViews: [{ buffer: 0, byteLength: 8 }] };
const inside = { binLength: 8 };
const sparse = { count: 1, indices: { bufferView: 0, componentType: 5123 }, values: { bufferView: 0 } };
const primitive = (more: object) => ({ accessors: [accessor], meshes: [{}, { primitives: [{ attributes: {}, ...more }] }] });

/** A GLB of these chunks, each its type and its bytes; `said` is the length that its header gives. */
function glb(chunks: readonly (readonly [type: string, text: string])[], said?: number, version = 2): Uint8Array {
  const parts = chunks.map(([type, text]) => [type, text.padEnd(Math.ceil(text.length / 4) * 4)] as const);
  const length = parts.reduce((sum, [, text]) => sum + 8 + text.length, 12);
  const bytes = new Uint8Array(Math.max(length, 20));
  const view = new DataView(bytes.buffer);
  for (const [i, x] of [0x46546c67, version, said ?? length].entries()) view.setUint32(4 * i, x, true);
  let at = 12;
  for (const [type, text] of parts) {
    view.setUint32(at, text.length, true);
    bytes.set(new TextEncoder().encode(type + text), at + 4);
    at += 8 + text.length;
  }
  return bytes;
}
const longChunk = () => {
  const bytes = glb([['JSON', '{}  ']]);
  new DataView(bytes.buffer).setUint32(12, 400, true);
  return bytes;
};

const header = {
  version: 1,
  distance: 'fast-marching',
  positionsHash: 'a',
  normalization: { center: [0, 0, 0], diagonal: 1 },
  grid: { origin: [0, 0, 0], spacing: 1, dimensions: [2, 2, 2] },
  distanceScale: 1,
};
const body = (fault: Row[0], place: string, wrong: object): Row => [
  fault,
  `HANDLEBODY_body.${place}`,
  () => parseBodyHeader({ ...header, ...wrong }),
];
const arrays = {
  // One run: of 2 voxels from voxel 0 on.
  voxels: Uint32Array.of(0, 2),
  centers: Uint32Array.of(0, 1),
  order: Uint32Array.of(0, 1),
  distances: new Uint8Array(64),
  spheres: new Float32Array(4),
};
const stored = (fault: Row[0], place: string, wrong: object): Row => [
  fault,
  `HANDLEBODY_body.${place}`,
  () => checkStored({ ...arrays, ...wrong }, parseBodyHeader(header)),
];
const sound = {
  ...header,
  mesh: { positions: new Float32Array(9), triangles: Uint32Array.of(0, 1, 2) },
  voxels: Uint32Array.of(0, 1),
  centers: Uint32Array.of(0, 1),
  distances: new Uint16Array(4),
  spheres: new Float64Array(4),
};
const whole = (fault: Row[0], place: string, wrong: object): Row => [
  fault,
  `HANDLEBODY_body.${place}`,
  () => checkBody({ ...sound, ...wrong } as never),
];
const matching = { positionsHash: hashPositions(sound.mesh.positions) };
/** Two nodes, one branch, one sphere on it. */
const bones = {
  nodes: new Float64Array(8),
  steps: Uint32Array.of(0, 1),
  lengths: Uint32Array.of(2),
  parents: Int32Array.of(-1),
  sphereBranches: Int32Array.of(0),
};
const boned = (fault: Row[0], place: string, wrong: object): Row =>
  whole(fault, place, { ...matching, skeleton: { ...bones, ...wrong } });

const dimensions = [
  { name: 'x', min: 0, max: 1 },
  { name: 'y', min: 0, max: 1 },
];
const space = { version: 1, dimensions, examples: [{ name: 'a', at: [0, 0], weights: [1] }] };
const pose = (fault: Row[0], place: string, wrong: object): Row => [
  fault,
  `HANDLEBODY_pose_space.${place}`,
  () => parsePoseSpace({ ...space, ...wrong }, { targetCount: 1 }),
];
const example = (fault: Row[0], place: string, wrong: object): Row =>
  pose(fault, place, { examples: [...space.examples, { name: 'b', at: [0, 1], weights: [1], ...wrong }] });

const ROWS: readonly Row[] = [
  ['glb-header', '12 bytes', () => splitGlb(glb([['JSON', '{}  ']]).subarray(0, 12))],
  ['glb-length', '24 are there', () => splitGlb(glb([['JSON', '{}  ']], 400))],
  ['glb-version', 'byte 4', () => splitGlb(glb([['JSON', '{}  ']], undefined, 3))],
  ['glb-chunk', 'byte 12', () => splitGlb(longChunk())],
  ['glb-first', 'byte 16', () => splitGlb(glb([['BIN\0', '1234']]))],
  ['glb-json', 'byte 12', () => splitGlb(glb([], 12))],
  ['glb-text', 'byte 21', () => splitGlb(glb([['JSON', '{x}']]))],
  ['json-object', 'its JSON', () => verifyGltf([])],
  ['json-asset', '"asset"', () => verifyGltf({})],
  ['gltf-version', 'asset.version', () => verifyGltf({ asset: { version: '1.0' } })],
  gltf('names', 'extensionsUsed', { extensionsUsed: [3] }),
  gltf('list', 'nodes', { nodes: 3 }),
  gltf('list', 'meshes[0].primitives', { meshes: [{ primitives: 3 }] }),
  gltf('list', 'meshes[1].primitives[0].targets', primitive({ targets: 3 })),
  gltf('index', 'bufferViews[0].buffer', { bufferViews: [{ buffer: 2 }] }),
  gltf('index', 'accessors[0].bufferView', { accessors: [{ ...accessor, bufferView: -1 }] }),
  gltf('index', 'accessors[0].sparse.count', { accessors: [{ ...accessor, sparse: { ...sparse, count: 2 } }] }),
  gltf('index', 'accessors[0].sparse.indices.bufferView', { accessors: [{ ...accessor, sparse }] }),
  gltf('index', 'meshes[1].primitives[0].attributes.POSITION', primitive({ attributes: { POSITION: 7 } })),
  gltf('index', 'meshes[1].primitives[0].targets[1].NORMAL', primitive({ targets: [{}, { NORMAL: 0.5 }] })),
  gltf('index', 'meshes[1].primitives[0].indices', primitive({ indices: 1 })),
  gltf('index', 'meshes[1].primitives[0].mode', primitive({ mode: 7 })),
  gltf('index', 'meshes[1].primitives[0].material', primitive({ material: 0 })),
  gltf('index', 'nodes[1].mesh', { nodes: [{}, { mesh: 0 }] }),
  gltf('index', 'nodes[0].children[1]', { nodes: [{ children: [1, 2] }, {}] }),
  gltf('index', 'skins[0].joints[0]', { skins: [{ joints: [0] }] }),
  gltf('index', 'skins[0].skeleton', { skins: [{ joints: [], skeleton: 0 }] }),
  gltf('index', 'images[0].bufferView', { images: [{ bufferView: 0 }] }),
  gltf('index', 'animations[0].samplers[0].output', {
    accessors: [accessor],
    animations: [{ samplers: [{ input: 0, output: 1 }], channels: [] }],
  }),
  gltf('index', 'scene is 3', { scene: 3 }),
  gltf('indices', 'scenes[0].nodes', { scenes: [{ nodes: 3 }] }),
  gltf('buffer-length', 'buffers[0].byteLength', { buffers: [{}] }),
  gltf('buffer-short', 'buffers[0]', { buffers }, { binLength: 4 }),
  gltf('buffer-outside', 'buffers[0]', { buffers: [{ byteLength: 8, uri: 'a.bin' }] }),
  gltf('view', 'bufferViews[0]', { buffers, bufferViews: [{ buffer: 0, byteLength: 9 }] }, inside),
  gltf('stride', 'bufferViews[0].byteStride', { buffers, bufferViews: [{ buffer: 0, byteLength: 8, byteStride: 0 }] }, inside),
  gltf('past', 'accessors[0]', { ...views, accessors: [{ ...accessor, bufferView: 0, count: 3 }] }, inside),
  gltf(
    'past',
    'accessors[0].sparse.values',
    {
      ...views,
      accessors: [{ ...accessor, type: 'MAT4', sparse }],
    },
    inside,
  ),
  gltf('component', 'accessors[0].componentType', { accessors: [{ ...accessor, componentType: 1 }] }),
  gltf('type', 'accessors[0].type', { accessors: [{ ...accessor, type: 'VEC5' }] }),
  gltf('count', 'accessors[0].count', { accessors: [{ ...accessor, count: -1 }] }),
  gltf('sparse', 'accessors[0].sparse', { accessors: [{ ...accessor, sparse: 3 }] }),
  gltf('sparse-type', 'accessors[0].sparse.indices.componentType', {
    accessors: [{ ...accessor, sparse: { ...sparse, indices: {} } }],
  }),
  gltf('amplified', 'accessors', { accessors: [{ ...accessor, count: 1e9 }] }, { fileLength: 100 }),
  gltf('many', 'nodes', { nodes: Array(70_000).fill({}) }),
  gltf('attributes', 'meshes[0].primitives[0]', { meshes: [{ primitives: [{}] }] }),
  gltf('numbers', 'nodes[0].rotation', { nodes: [{ rotation: [0, 0, 0] }] }),
  gltf('two-parents', 'nodes[1].children', { nodes: [{ children: [2] }, { children: [2] }, {}] }),
  gltf('deep', 'nodes[513]', { nodes: chain(600) }),
  gltf('nested', 'extras', { extras: nest(600) }),
  gltf('circle', 'nodes[1]', { nodes: [{}, { children: [2] }, { children: [1] }] }),
  gltf('no-root', 'scenes[0].nodes', { nodes: [{ children: [1] }, {}], scenes: [{ nodes: [1] }] }),
  gltf('root-twice', 'scenes[0].nodes', { nodes: [{}], scenes: [{ nodes: [0, 0] }] }),
  gltf('samplers', 'animations[0].samplers', { animations: [{}] }),
  gltf('sampler', 'animations[0].samplers[1]', {
    accessors: [accessor],
    animations: [{ samplers: [{ input: 0, output: 0 }, 3] }],
  }),
  gltf('channels', 'animations[0].channels', { animations: [{ samplers: [] }] }),

  pose('pose-version', 'version', { version: 9 }),
  pose('pose-lists', 'dimensions', { dimensions: [] }),
  pose('pose-lists', 'examples', { examples: {} }),
  pose('pose-dimension', 'dimensions[1]', { dimensions: [dimensions[0], { name: 'y', min: 1, max: 0 }] }),
  pose('pose-scale', 'dimensions[0].scale', { dimensions: [{ ...dimensions[0], scale: 0 }] }),
  pose('pose-names', 'dimensions', { dimensions: [dimensions[0], dimensions[0]] }),
  [
    'pose-many',
    'HANDLEBODY_pose_space.examples',
    () => parsePoseSpace({ ...space, examples: Array(2000).fill({ name: 'a', at: [0, 0], target: 0 }) }, { targetCount: 2000 }),
  ],
  example('pose-example', 'examples[1].name', { name: 3 }),
  example('pose-both', 'examples[1]', { target: 0 }),
  example('pose-target', 'examples[1].target', { weights: undefined, target: 5 }),
  example('pose-count', 'examples[1].at', { at: [0] }),
  example('pose-count', 'examples[1].weights', { weights: [] }),
  example('pose-numbers', 'examples[1].at', { at: [0, null] }),

  body('body-version', 'version', { version: 9 }),
  body('method', 'distance', { distance: 'a guess' }),
  body('hash', 'positionsHash', { positionsHash: 3 }),
  body('scale', 'distanceScale', { distanceScale: -1 }),
  body('grid', 'grid', { grid: { ...header.grid, dimensions: [0, 1, 1] } }),
  body('triple', 'normalization.center', { normalization: {} }),
  body('triple', 'grid.dimensions', { grid: { ...header.grid, dimensions: [1] } }),
  body('positive', 'grid.spacing', { grid: { ...header.grid, spacing: 0 } }),
  body('handles', 'handles', { handles: 3 }),
  body('handle-name', 'handles[0].name', { handles: [{}] }),
  body('handle-vertex', 'handles[0].vertex', { handles: [{ name: 'a', vertex: -1 }] }),
  body('triple', 'handles[0].at', { handles: [{ name: 'a', at: 3 }] }),
  ['arrays-hash', 'HANDLEBODY_body.arraysHash', () => parseStoredHeader(header)],
  stored('array', 'centers', { centers: [0] }),
  stored('runs', 'voxels', { voxels: Uint32Array.of(0, 99) }),
  stored('few', 'distances', { centers: new Uint32Array(700), distances: new Uint8Array(1) }),
  stored('twice', 'order', { order: Uint32Array.of(0, 0) }),
  stored('lacking', 'order', { order: Uint32Array.of(0) }),
  stored('empty', 'centers', { centers: new Uint32Array() }),
  whole('distances', 'distances', { distances: new Uint16Array(3) }),
  whole('voxel', 'voxels', { voxels: Uint32Array.of(1, 0) }),
  whole('body-other', 'positionsHash', {}),
  whole('center', 'centers', { ...matching, centers: Uint32Array.of(0, 9) }),
  whole('handle-lost', 'handles', { ...matching, handles: [{ name: 'Wing', vertex: 9 }] }),
  whole('spheres', 'spheres', { ...matching, spheres: new Float64Array(3) }),
  whole('sphere-axes', 'sphereAxes', { ...matching, sphereAxes: new Float64Array(2) }),
  body('smooth-length', 'smoothLength', { version: 2, smoothLength: -1 }),
  boned('skeleton-nodes', 'skeletonNodes', { nodes: new Float64Array(3) }),
  boned('skeleton-step', 'skeletonBranches', { steps: Uint32Array.of(0, 2) }),
  boned('skeleton-branch', 'skeletonBranches', { parents: Int32Array.of(0) }),
  boned('skeleton-spheres', 'sphereBranches', { sphereBranches: new Int32Array(2) }),
  boned('skeleton-sphere', 'sphereBranches', { sphereBranches: Int32Array.of(1) }),
];

/** Faults that a few lines cannot make happen, and the test that does. */
const ELSEWHERE = ['most', 'compressed', 'changed', 'unreadable'];

describe('of glTF, and of what Handlebody puts into it', () => {
  test.each(ROWS)('%s, at %s', (fault, place, work) => {
    try {
      work();
    } catch (error) {
      if (!(error instanceof Fault)) throw error;
      expect([error.fault, worded(error).message]).toEqual([fault, expect.stringContaining(place)]);
      return;
    }
    expect.fail('nothing was thrown');
  });

  test('is every fault that there is', () => {
    expect(Object.keys(FAULTS).filter((name) => !ELSEWHERE.includes(name) && !ROWS.some(([fault]) => fault === name))).toEqual([]);
  });

  test('is an attribute of another type', () => {
    const document = meshDocument({ positions: new Float32Array(9), triangles: Uint32Array.of(0, 1, 2) });
    const [mesh] = document.getRoot().listMeshes();
    mesh?.listPrimitives()[0]?.getAttribute('POSITION')?.setType('SCALAR');
    expect(() => readMesh(document)).toThrow('meshes[0].primitives[0].attributes.POSITION is SCALAR');
  });

  test.each([
    [{ buffers: [{ byteLength: 3, uri: 3 }] }, 'buffers[0].uri'],
    [{ buffers: [{ byteLength: 3, uri: 'data:;base64,!' }] }, 'buffers[0].uri'],
    [{ buffers: [{ byteLength: 3, uri: 'a.bin' }] }, 'buffers[0]'],
    [{ buffers: [{ byteLength: 3, uri: 'data:;base64,AA==' }] }, 'buffers[0]'],
    [{ extensionsRequired: ['EXT_nobody'], extensionsUsed: ['EXT_nobody'] }, 'EXT_nobody (extensionsRequired)'],
  ])('is what %j lacks', async (json, place) => {
    const text = new TextEncoder().encode(JSON.stringify({ asset, ...json }));
    await expect(readGltf(text)).rejects.toThrow(place);
  });
});

const header3 = 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n';
const faces = 'element face 1\nproperty list uchar int vertex_indices\nend_header\n';
const binary = (text: string, ...bytes: number[]) => Uint8Array.of(...new TextEncoder().encode(text), ...bytes);
const readers = { OBJ: readObj, OFF: readOff, PLY: readPly, STL: readStl };

describe('of files of text, and of binary PLY and STL', () => {
  test.each<readonly [format: keyof typeof readers, content: string | Uint8Array, place: RegExp]>([
    ['OBJ', 'v 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3', /^Line 1 /],
    ['OBJ', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9', /^Line 4 /],
    ['OBJ', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x', /^Line 4 /],
    ['OFF', 'ABC\n', /^Line 1 /],
    ['OFF', 'nOFF\n3 1 0\n', /^Line 1 /],
    ['OFF', 'OFF BINARY\n', /^Line 1 /],
    ['OFF', 'OFF\nthree 1 0\n', /^Line 2 /],
    ['OFF', 'OFF\n3 1 0\n0 0 0\n1 0 0\n', /line 4/],
    ['OFF', 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7', /^Line 6 /],
    ['OFF', 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 x\n3 0 1 2', /^Line 5 /],
    ['PLY', 'plx\n', /^Line 1 /],
    ['PLY', 'ply\nformat ascii 2.0\n', /^Line 2 /],
    ['PLY', 'ply\nformat text 1.0\n', /^Line 2 /],
    ['PLY', 'ply\nformat ascii 1.0\nelement vertex\n', /^Line 3 /],
    ['PLY', 'ply\nproperty float x\n', /^Line 2 /],
    ['PLY', 'ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n', /^Line 4 /],
    ['PLY', 'ply\nend_header\n', /^Line 2 /],
    ['PLY', 'ply\nformat ascii 1.0\n', /21 bytes/],
    ['PLY', 'ply\nformat ascii 1.0\nelement vertex 1\nend_header\n1', /line 3/],
    ['PLY', 'ply\nformat ascii 1.0\nend_header\n', /3 lines/],
    ['PLY', 'ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n', /line 3/],
    ['PLY', `${header3}element face 1\nproperty int a\nend_header\n0 0 0\n1 0 0\n0 1 0\n1\n`, /line 7/],
    ['PLY', `${header3}${faces}0 0 0\n1 0 0\n0 1 0 1 1 1\n`, /line 12/],
    ['PLY', `${header3}${faces}0 0 0\n1 0 0\n0 1 0\n3 0 1 5\n`, /^Line 13 /],
    ['PLY', `${header3}${faces}0 0 0\n1 0 0\n0 x 0\n3 0 1 2\n`, /^Line 12 /],
    ['PLY', `${header3}${faces}0 0 0\n`, /bytes, and has/],
    [
      'PLY',
      binary(
        'ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty uchar x\nproperty uchar y\nproperty uchar z\nelement face 1\nproperty list uchar uchar vertex_indices\nend_header\n',
        ...[0, 0, 0, 3, 0],
      ),
      /at byte \d+/,
    ],
    ['STL', 'solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n', /byte \d+/],
    ['STL', 'solid a\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 x\nvertex 0 1 0\nendloop\nendfacet\nendsolid', /^Line 5 /],
    ['STL', Uint8Array.from({ length: 90 }, (_, i) => (i === 80 ? 2 : 0)), /has 90/],
    ['STL', Uint8Array.from({ length: 134 }, (_, i) => (i === 80 ? 1 : i >= 96 && i < 100 ? 255 : 0)), /byte \d+/],
  ])('%s: %j', (format, content, place) => {
    const bytes = typeof content === 'string' ? new TextEncoder().encode(content) : content;
    let error: unknown;
    try {
      readers[format](bytes);
    } catch (thrown) {
      error = thrown;
    }
    expect(error).toBeInstanceOf(HandlebodyError);
    expect((error as HandlebodyError).message).toMatch(place);
  });
});

describe('of HANDLES.json', () => {
  const to = [0, 0, 0];
  const wrong: readonly (readonly [object, string])[] = [
    [{ vertex: 1, to, turn: 3 }, 'handles[1].turn'],
    [{ to }, 'handles[1]'],
    [{ vertex: 1.5, to }, 'handles[1].vertex'],
    [{ vertex: 99, to }, 'handles[1].vertex'],
    [{ at: [0, 0], to }, 'handles[1].at'],
    [{ vertex: 1 }, 'handles[1].to'],
    [{ vertex: 1, to: [0, null, 0] }, 'handles[1].to'],
    [{ vertex: 1, to, rotation: [0, 0, 0, 0] }, 'handles[1].rotation'],
    [{ vertex: 1, to, scale: 'x' }, 'handles[1].scale'],
  ];
  test.each(wrong)('%j', (handle, place) => {
    const bytes = new TextEncoder().encode(JSON.stringify({ handles: [{ vertex: 0, to }, handle] }));
    expect(() => parseHandles(bytes, { vertexCount: 9 })).toThrow(place);
  });

  test.each([
    [{ vertex: 'x' }, 'handles[1]'],
    [{ vertex: 1, to: [0] }, 'handles[1].to'],
  ])('in the studio: %j', (handle, place) => {
    expect(() => readHandles(JSON.stringify({ handles: [{ vertex: 0 }, handle] }))).toThrow(place);
  });
});
