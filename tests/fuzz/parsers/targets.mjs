/**
 * What is fuzzed: for each reader made files that are sound, how it reads, what its result must be, and the files behind it. What is `whole` is
 * damaged where it is made, and not once more as bytes. What reads `false` has reached nothing.
 */
import { glb } from '../../bench/hostile/make.mjs';
import { bodyTarget } from './body.mjs';
import { optionsTarget } from './options.mjs';
import { Random } from './random.mjs';

/** @typedef {import('../../../web/assets/index.ts')} Assets */
/** @typedef {{ assets: Assets, parseHandles: typeof import('../../../web/cli/handles.ts').parseHandles, load: typeof import('../../../wasm/ts/index.ts').load }} Library */
/** @typedef {{ make: (random: Random) => Uint8Array, read: (bytes: Uint8Array) => unknown, files: RegExp, whole?: boolean }} Target */

const text = (/** @type {string} */ value) => new TextEncoder().encode(value);

/** Vertices and faces of a small shape, some of them polygons. @param {Random} random */
function shape(random) {
  const sides = 3 + random.below(5);
  const ring = (/** @type {number} */ z) =>
    Array.from({ length: sides }, (_, i) => [
      Math.cos((2 * Math.PI * i) / sides),
      Math.sin((2 * Math.PI * i) / sides) * (1 + (i % 2)),
      z,
    ]);
  const around = Array.from({ length: sides }, (_, i) => [i, (i + 1) % sides, sides + ((i + 1) % sides), sides + i]);
  const lids = [Array.from({ length: sides }, (_, i) => sides - 1 - i), Array.from({ length: sides }, (_, i) => sides + i)];
  return {
    points: [...ring(0), ...ring(1 + random.below(3))].map((p) => p.map((x) => Number(x.toFixed(random.below(6))))),
    faces: [...around, ...lids],
  };
}
const fan = (/** @type {number[]} */ face) => face.slice(2).map((_, i) => [face[0] ?? 0, face[i + 1] ?? 0, face[i + 2] ?? 0]);

/** @param {Random} random */
function obj(random) {
  const { points, faces } = shape(random);
  const kind = random.below(4);
  const corner = (/** @type {number} */ v) =>
    [`${v + 1}`, `${v + 1}/${v + 1}`, `${v + 1}//${v + 1}`, `${v - points.length}/${v + 1}/${v + 1}`][kind];
  const rows = [
    ...points.map((p) => `v ${p.join(' ')}`),
    ...points.map((_, i) => `vt ${i / 9} 0.5`),
    ...points.map((p) => `vn ${p.join(' ')}`),
    ...faces.map((face) => `f ${face.map(corner).join(' ')}`),
  ];
  return text(['# made', 'o a', ...rows, 'l 1 2'].join(random.pick(['\n', '\r\n', '\r'])));
}

/** @param {Random} random */
function off(random) {
  const { points, faces } = shape(random);
  const kind = random.pick(['', 'C', 'N', 'ST', '4']);
  const more = { '': '', C: ' 255 0 0', N: ' 0 0 1', ST: ' 0.5 0.5', 4: ' 1' }[kind] ?? '';
  return text(
    `${kind}OFF\n${points.length} ${faces.length} 0\n${points.map((p) => p.join(' ') + more).join('\n')}\n${faces.map((f) => `${f.length} ${f.join(' ')}`).join('\n')}\n`,
  );
}

/** @param {Random} random */
function stl(random) {
  const { points, faces } = shape(random);
  const triangles = faces.flatMap(fan).map((t) => t.map((v) => points[v] ?? [0, 0, 0]));
  if (random.below(2) === 0)
    return text(
      `solid a\n${triangles.map((t) => `facet normal 0 0 0\nouter loop\n${t.map((p) => `vertex ${p.join(' ')}\n`).join('')}endloop\nendfacet\n`).join('')}endsolid a\n`,
    );
  const out = new DataView(new ArrayBuffer(84 + 50 * triangles.length));
  out.setUint32(80, triangles.length, true);
  triangles.forEach((t, i) => {
    t.flat().forEach((x, k) => {
      out.setFloat32(84 + 50 * i + 12 + 4 * k, x, true);
    });
  });
  return new Uint8Array(out.buffer);
}

/** @param {Random} random */
function ply(random) {
  const { points, faces } = shape(random);
  const format = random.pick(['ascii', 'binary_little_endian', 'binary_big_endian']);
  const withMore = random.below(2) === 1;
  const more = withMore
    ? 'property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\nproperty uchar red\n'
    : '';
  const head = `ply\nformat ${format} 1.0\ncomment made\nelement vertex ${points.length}\nproperty float x\nproperty double y\nproperty float z\n${more}element face ${faces.length}\nproperty list uchar int vertex_indices\nend_header\n`;
  const rest = withMore ? [0, 0, 1, 0.5, 0.5, 7] : [];
  if (format === 'ascii')
    return text(
      head + [...points.map((p) => [...p, ...rest].join(' ')), ...faces.map((f) => [f.length, ...f].join(' '))].join('\n'),
    );
  const little = format.includes('little');
  const out = new DataView(
    new ArrayBuffer(points.length * (16 + (withMore ? 21 : 0)) + faces.reduce((sum, f) => sum + 1 + 4 * f.length, 0)),
  );
  let at = 0;
  const float = (/** @type {number} */ x) => {
    out.setFloat32(at, x, little);
    at += 4;
  };
  for (const [x = 0, y = 0, z = 0] of points) {
    float(x);
    out.setFloat64(at, y, little);
    at += 8;
    float(z);
    if (withMore) {
      rest.slice(0, 5).forEach(float);
      out.setUint8(at++, 7);
    }
  }
  for (const face of faces) {
    out.setUint8(at++, face.length);
    for (const v of face) {
      out.setInt32(at, v, little);
      at += 4;
    }
  }
  return Buffer.concat([text(head), new Uint8Array(out.buffer)]);
}

/** @param {Random} random */
function gltfParts(random) {
  const { points, faces } = shape(random);
  const positions = Float32Array.from(points.flat());
  const indices = Uint16Array.from(faces.flatMap(fan).flat());
  const bin = Buffer.concat([Buffer.from(positions.buffer), Buffer.from(positions.buffer), Buffer.from(indices.buffer)]);
  const views = [
    [0, positions.byteLength],
    [positions.byteLength, positions.byteLength],
    [2 * positions.byteLength, indices.byteLength],
  ];
  const json = {
    buffers: [{ byteLength: bin.length }],
    bufferViews: views.map(([byteOffset, byteLength]) => ({ buffer: 0, byteOffset, byteLength })),
    accessors: [
      { bufferView: 0, componentType: 5126, type: 'VEC3', count: points.length },
      {
        bufferView: 1,
        componentType: 5126,
        type: 'VEC3',
        count: points.length,
        sparse: { count: 1, indices: { bufferView: 2, componentType: 5123 }, values: { bufferView: 0 } },
      },
      { bufferView: 2, componentType: 5123, type: 'SCALAR', count: indices.length },
    ],
    meshes: [
      {
        primitives: [{ attributes: { POSITION: 0, NORMAL: 1 }, indices: 2, targets: [{ POSITION: 1 }] }],
        weights: [random.below(3)],
        extensions: {
          HANDLEBODY_pose_space: {
            version: 1,
            dimensions: [{ name: 'a', min: 0, max: 1 }],
            examples: [
              { name: 'b', at: [0.5], target: 0 },
              { name: 'c', at: [0], weights: [0] },
            ],
          },
        },
      },
    ],
    materials: [{ name: 'm', pbrMetallicRoughness: { baseColorFactor: [1, 0, 0, 1] } }],
    nodes: [
      { name: 'n', mesh: 0, translation: [0, 1, 0], children: [1] },
      { mesh: 0, scale: [1, -1, 1], extensions: { X_unknown: { a: 1 } } },
    ],
    scenes: [{ nodes: [0] }],
    scene: 0,
    extensionsUsed: ['HANDLEBODY_pose_space', 'X_unknown'],
    extras: { b: [1, { c: 'd' }] },
  };
  return { json, bin };
}

/** @param {ReturnType<Assets['readObj']>} mesh */
function checkMesh({ positions, triangles, normals, uvs }) {
  const count = positions.length / 3;
  for (const numbers of [positions, normals ?? [], uvs ?? []])
    for (const x of numbers) if (!Number.isFinite(x)) throw new Error(`a result of ${x}`);
  for (const v of triangles) if (!(v < count)) throw new Error(`a corner ${v} of ${count}`);
  if (count === 0) throw new Error('a mesh without vertices');
}

/** @param {Assets} assets @param {Awaited<ReturnType<Assets['readGlb']>>} document */
async function look(assets, document) {
  const { mesh } = assets.readMesh(document, { morphs: 'present', onWarning: () => {} });
  const count = mesh.positions.length / 3;
  for (const v of mesh.triangles) if (!(v < count)) throw new Error(`a corner ${v} of ${count}`);
  await assets.readBody(document);
  assets.readPoseSpaces(document);
  await assets.writeGlb(document);
}

/** @param {Random} random */
function handles(random) {
  const entry = () => ({
    ...(random.below(2) ? { vertex: random.below(9) } : { at: [0, 0.5, 1] }),
    to: [1, 2, random.below(5)],
    ...(random.below(2) && { rotation: [0, 0, 0, 1] }),
    ...(random.below(2) && { scale: [1, 2, 1] }),
  });
  return text(
    JSON.stringify({
      handles: Array.from({ length: 1 + random.below(4) }, entry),
      relativeWidth: 2,
      smoothness: random.pick(['auto', 0.5]),
    }),
  );
}

const TEXT = 'text-|number-list|file-|to-bytes|join-vertices|area-normals|coarse-floats|cut-polygons|ear-clipping|crossing-edges';
const STL = TEXT.replace(/.cut-.*/, '');
/** The targets, of the library as it was built or of its sources. @param {Library} library @returns {Promise<Record<string, Target>>} */
export async function targetsOf({ assets, parseHandles, load }) {
  return {
    obj: { make: obj, read: (bytes) => checkMesh(assets.readObj(bytes)), files: new RegExp(`assets/(read-obj|obj-|${TEXT})`) },
    ply: { make: ply, read: (bytes) => checkMesh(assets.readPly(bytes)), files: new RegExp(`assets/(read-ply|ply-|${TEXT})`) },
    stl: { make: stl, read: (bytes) => checkMesh(assets.readStl(bytes)), files: new RegExp(`assets/(read-stl|${STL})`) },
    off: { make: off, read: (bytes) => checkMesh(assets.readOff(bytes)), files: new RegExp(`assets/(read-off|${TEXT})`) },
    glb: {
      make: (random) => {
        const { json, bin } = gltfParts(random);
        return glb(random.below(4) ? random.damage(json) : json, bin);
      },
      read: async (bytes) => look(assets, await assets.readGlb(bytes)),
      files:
        /assets\/(glb|open-gltf|verify-|check-|read-mesh|join-scene|concatenate|pose-space|to-document|kept-extension|drawn-corners)/,
    },
    gltf: {
      make: (random) => {
        const { json, bin } = gltfParts(random);
        const whole = {
          asset: { version: '2.0' },
          ...json,
          buffers: [{ byteLength: bin.length, uri: `data:;base64,${bin.toString('base64')}` }],
        };
        return text(JSON.stringify(random.below(4) ? random.damage(whole) : whole));
      },
      read: async (bytes) => look(assets, await assets.readGltf(bytes, { resource: async () => undefined })),
      files: /assets\/(open-|plain-gltf|fetch-resources|data-uri|verify-|read-mesh|join-scene|concatenate|pose-space|to-document)/,
    },
    body: await bodyTarget(assets, await load()),
    handles: {
      make: (random) => {
        const made = handles(random);
        return random.below(4) ? text(JSON.stringify(random.damage(JSON.parse(new TextDecoder().decode(made))))) : made;
      },
      read: (bytes) => {
        const { targets } = parseHandles(bytes, { vertexCount: 9 });
        for (const x of targets) if (!Number.isFinite(x)) throw new Error(`a target of ${x}`);
      },
      files: /cli\/handles/,
    },
    options: await optionsTarget(load),
  };
}
