/**
 * The worst inputs that are known for each reader, at any size: what once took quadratic time or more memory than its bytes justify, and
 * what looks as if it might. `make` gives about so many bytes; a growth of ten times the bytes is what is measured.
 */

/** @typedef {{ reader: string, make: (bytes: number) => Uint8Array }} Kind */

const encoder = new TextEncoder();
const text = (/** @type {string} */ value) => encoder.encode(value);
const repeat = (/** @type {string} */ unit, /** @type {number} */ bytes) =>
  unit.repeat(Math.max(Math.floor(bytes / unit.length), 1));
/** @template T @param {number} n @param {(i: number) => T} make */
const list = (n, make) => Array.from({ length: Math.max(Math.floor(n), 1) }, (_, i) => make(i));

/** @param {object} json @param {Uint8Array} [bin] */
export function glb(json, bin) {
  const head = text(JSON.stringify({ asset: { version: '2.0' }, ...json }));
  const headRoom = Math.ceil(head.length / 4) * 4;
  const binRoom = Math.ceil((bin?.length ?? 0) / 4) * 4;
  const out = new Uint8Array(20 + headRoom + (bin ? 8 + binRoom : 0));
  const view = new DataView(out.buffer);
  [0x46546c67, 2, out.length, headRoom, 0x4e4f534a].forEach((word, i) => {
    view.setUint32(4 * i, word, true);
  });
  out.fill(32, 20, 20 + headRoom).set(head, 20);
  if (bin) {
    view.setUint32(20 + headRoom, binRoom, true);
    view.setUint32(24 + headRoom, 0x004e4942, true);
    out.set(bin, 28 + headRoom);
  }
  return out;
}

/** One triangle, and what is added to it. @param {object} more @param {number} [vertices] */
export function triangle(more, vertices = 3) {
  const positions = Float32Array.from({ length: 3 * vertices }, (_, i) => ((i * 7) % 11) + i / 1e3);
  const bin = new Uint8Array(positions.buffer);
  return glb(
    {
      buffers: [{ byteLength: bin.length }],
      bufferViews: [{ buffer: 0, byteLength: bin.length }],
      accessors: [{ bufferView: 0, componentType: 5126, type: 'VEC3', count: vertices }],
      meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
      nodes: [{ mesh: 0 }],
      scenes: [{ nodes: [0] }],
      scene: 0,
      ...more,
    },
    bin,
  );
}

const nested = (/** @type {number} */ levels) => `${'['.repeat(levels)}${']'.repeat(levels)}`;
/** A GLB with another text in its JSON: of lists in lists that no object is written as. @param {Uint8Array} file @param {string} from @param {string} to */
function withText(file, from, to) {
  const view = new DataView(file.buffer);
  const length = view.getUint32(12, true);
  const json = new TextDecoder().decode(file.subarray(20, 20 + length)).replace(from, () => to);
  const bin = file.subarray(20 + length);
  const head = text(json.padEnd(Math.ceil(json.length / 4) * 4));
  const out = new Uint8Array(20 + head.length + bin.length);
  out.set(file.subarray(0, 20));
  out.set(head, 20);
  out.set(bin, 20 + head.length);
  new DataView(out.buffer).setUint32(8, out.length, true);
  new DataView(out.buffer).setUint32(12, head.length, true);
  return out;
}

/** Nodes, each below the one before it, in chains of so many. @param {number} n @param {number} first @param {number} [length] */
const chains = (n, first, length = 400) =>
  list(n, (i) => (i % length === length - 1 || i === Math.floor(n) - 1 ? {} : { children: [i + first] }));

const spiral = (/** @type {number} */ corners, /** @type {(x: number, y: number) => string} */ line) => {
  const half = Math.floor(corners / 2);
  const at = (/** @type {number} */ i, /** @type {number} */ wide) => {
    const angle = (i / half) * 12 * Math.PI;
    const radius = angle + wide;
    return line(Math.round(radius * Math.cos(angle) * 1e3) / 1e3, Math.round(radius * Math.sin(angle) * 1e3) / 1e3);
  };
  return [...list(half, (i) => at(i, 0)), ...list(half, (i) => at(half - 1 - i, 2))].join('');
};

/** Positions whose bits are equal but for the highest, as those of small whole numbers are. */
const grid = (/** @type {number} */ count) => {
  const side = Math.ceil(Math.cbrt(count));
  return list(count, (i) => [i % side, Math.floor(i / side) % side, Math.floor(i / side / side)]);
};

function stl(/** @type {number} */ bytes, /** @type {(corner: number) => number[]} */ corner) {
  const count = Math.floor(bytes / 50);
  const out = new Uint8Array(84 + 50 * count);
  const view = new DataView(out.buffer);
  view.setUint32(80, count, true);
  for (let t = 0; t < count; t++)
    for (let k = 0; k < 3; k++)
      corner(3 * t + k).forEach((x, axis) => {
        view.setFloat32(84 + 50 * t + 12 + 12 * k + 4 * axis, x, true);
      });
  return out;
}

const TRIANGLE_OBJ = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n';
const PLY = (/** @type {string} */ format, /** @type {string} */ elements) => `ply\nformat ${format} 1.0\n${elements}end_header\n`;
const XYZ = 'property char x\nproperty char y\nproperty char z\n';

/** A token that looks like a number up to its end. */
const LONG = (/** @type {number} */ n) => `${'1'.repeat(n)}x`;

/** @type {Record<string, Kind>} */
export const KINDS = {
  'obj: a number of all digits but one': { reader: 'readObj', make: (n) => text(`${TRIANGLE_OBJ}v ${LONG(n)} 0 0\n`) },
  'obj: a number of two rows of digits': {
    reader: 'readObj',
    make: (n) => text(`${TRIANGLE_OBJ}v ${'1'.repeat(n / 2)}.${LONG(n / 2)} 0 0\n`),
  },
  'obj: an exponent of all digits': { reader: 'readObj', make: (n) => text(`${TRIANGLE_OBJ}v 1e${LONG(n)} 0 0\n`) },
  'obj: unknown lines': { reader: 'readObj', make: (n) => text(TRIANGLE_OBJ + repeat('x\n', n)) },
  'obj: lines that go on': { reader: 'readObj', make: (n) => text(TRIANGLE_OBJ + repeat('\\\n', n)) },
  'obj: blanks': { reader: 'readObj', make: (n) => text(`${TRIANGLE_OBJ}v${' '.repeat(n)}1 2 3`) },
  'obj: tabs and slashes': { reader: 'readObj', make: (n) => text(`${TRIANGLE_OBJ}f\t1${'/'.repeat(n)}\t2\t3`) },
  'obj: a face of every corner': { reader: 'readObj', make: (n) => text(`${TRIANGLE_OBJ}f ${repeat('1 2 3 ', n)}`) },
  'obj: a concave face': {
    reader: 'readObj',
    make: (n) => text(`${spiral(n / 24, (x, y) => `v ${x} ${y} 0\n`)}f ${list(2 * Math.floor(n / 48), (i) => i + 1).join(' ')}\n`),
  },
  'obj: a face that crosses itself': {
    reader: 'readObj',
    make: (n) =>
      text(
        `${list(n / 24, (i) => `v ${(i * 7919) % 997} ${(i * 104729) % 991} 0\n`).join('')}f ${list(n / 24, (i) => i + 1).join(' ')}\n`,
      ),
  },
  'obj: many concave faces': {
    reader: 'readObj',
    make: (n) =>
      text(
        `${list(300, (i) => `v ${i} ${i % 2 ? 100 + (i % 7) : 0} 0\n`).join('')}v 150 -200 0\n${repeat(`f ${list(301, (i) => i + 1).join(' ')}\n`, n)}`,
      ),
  },
  'obj: bad normals, one a line': { reader: 'readObj', make: (n) => text(TRIANGLE_OBJ + repeat('vn 0 0 0\nvt x\n', n)) },
  'ply: a number of all digits but one': {
    reader: 'readPly',
    make: (n) => text(`${PLY('ascii', `element vertex 1\n${XYZ}`)}${LONG(n)} 0 0\n`),
  },
  'ply: lists without an end': {
    reader: 'readPly',
    make: (n) => text(`${PLY('ascii', `element x 1\nproperty list int int y\nelement vertex 1\n${XYZ}`)}${repeat('9 ', n)}`),
  },
  'ply: vertices of three bytes': {
    reader: 'readPly',
    make: (n) => text(PLY('binary_little_endian', `element vertex ${Math.floor(n / 3)}\n${XYZ}`) + repeat('abc', n)),
  },
  'ply: many elements': {
    reader: 'readPly',
    make: (n) => text(`${PLY('ascii', `element vertex 1\n${XYZ}${repeat('element q 0\nproperty int a\n', n)}`)}0 0 0`),
  },
  'ply: lines of strips': {
    reader: 'readPly',
    make: (n) =>
      text(
        `${PLY('ascii', `element vertex 3\n${XYZ}element tristrips 1\nproperty list int int vertex_indices\n`)}0 0 0\n1 0 0\n0 1 0\n${Math.floor(n / 2)} ${repeat('0 1 2 ', n)}`,
      ),
  },
  'off: a number of all digits but one': { reader: 'readOff', make: (n) => text(`OFF\n1 0 0\n${LONG(n)} 0 0\n`) },
  'off: a face of every number': {
    reader: 'readOff',
    make: (n) => text(`OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n${Math.floor(n / 6)} ${repeat('0 1 2 ', n)}`),
  },
  'off: a row over every line': { reader: 'readOff', make: (n) => text(`OFF\n${repeat('9\n', n)}`) },
  'off: a comment in every line': { reader: 'readOff', make: (n) => text(`OFF\n1 0 0\n0 0 0\n${repeat('a#', n)}`) },
  'stl: a number of all digits but one': { reader: 'readStl', make: (n) => text(`solid\nfacet\nvertex ${LONG(n)} 0 0\n`) },
  'stl: words without lines': {
    reader: 'readStl',
    make: (n) => text(`solid ${repeat('facet vertex 0 0 1 vertex 1 0 0 vertex 0 1 0 endfacet ', n)}`),
  },
  'stl: whole numbers': {
    reader: 'readStl',
    make: (n) => {
      const at = grid((3 * n) / 50 + 3);
      return stl(n, (corner) => at[corner] ?? [0, 0, 0]);
    },
  },
  'stl: powers of two': {
    reader: 'readStl',
    make: (n) => stl(n, (corner) => [2 ** (corner % 64), 2 ** ((corner >> 6) % 64), 2 ** (corner >> 12)]),
  },
  'stl: triangles doubled': { reader: 'readStl', make: (n) => stl(n, (corner) => [corner % 3, (corner % 3) % 2, 0]) },

  'glb: bytes of text': { reader: 'glb', make: (n) => triangle({ extras: { text: 'a'.repeat(n) } }) },
  'glb: lists in lists': { reader: 'glb', make: (n) => withText(triangle({ extras: 'HERE' }), '"HERE"', nested(n / 2)) },
  'glb: lists in lists of an unknown extension': {
    reader: 'glb',
    make: (n) => withText(triangle({ extensionsUsed: ['X_a'], extensions: { X_a: { a: 'HERE' } } }), '"HERE"', nested(n / 2)),
  },
  'glb: lists in lists of a pose space': {
    reader: 'glb',
    make: (n) =>
      withText(
        triangle({
          meshes: [
            {
              primitives: [{ attributes: { POSITION: 0 } }],
              extensions: { HANDLEBODY_pose_space: { version: 1, dimensions: ['HERE'], examples: [] } },
            },
          ],
          extensionsUsed: ['HANDLEBODY_pose_space'],
        }),
        '"HERE"',
        nested(n / 2),
      ),
  },
  'glb: scenes': { reader: 'glb', make: (n) => triangle({ scenes: list(n / 12, () => ({ nodes: [0] })) }) },
  'glb: nodes': {
    reader: 'glb',
    make: (n) => triangle({ nodes: list(n / 10, () => ({})), scenes: [{ nodes: list(n / 10, (i) => i) }] }),
  },
  'glb: nodes with a mesh': {
    reader: 'glb',
    make: (n) => triangle({ nodes: list(n / 16, () => ({ mesh: 0 })), scenes: [{ nodes: list(n / 16, (i) => i) }] }),
  },
  'glb: nodes below one': {
    reader: 'glb',
    make: (n) => triangle({ nodes: [{ mesh: 0, children: list(n / 10, (i) => i + 1) }, ...list(n / 10, () => ({}))] }),
  },
  'glb: nodes in chains': {
    reader: 'glb',
    make: (n) => triangle({ nodes: chains(n / 24, 1), scenes: [{ nodes: list(n / 24 / 400, (i) => 400 * i) }] }),
  },
  'glb: nodes below each other': {
    reader: 'glb',
    make: (n) => triangle({ nodes: chains(n / 24, 1, Number.POSITIVE_INFINITY), scenes: [{ nodes: [0] }] }),
  },
  'glb: meshes': {
    reader: 'glb',
    make: (n) => triangle({ meshes: list(n / 50, () => ({ primitives: [{ attributes: { POSITION: 0 } }] })) }),
  },
  'glb: primitives': {
    reader: 'glb',
    make: (n) => triangle({ meshes: [{ primitives: list(n / 32, () => ({ attributes: { POSITION: 0 } })) }] }),
  },
  'glb: primitives at nodes': {
    reader: 'glb',
    make: (n) =>
      triangle({
        meshes: [{ primitives: list(n / 64, () => ({ attributes: { POSITION: 0 } })) }],
        nodes: list(n / 32, () => ({ mesh: 0 })),
        scenes: [{ nodes: list(n / 32, (i) => i) }],
      }),
  },
  'glb: primitives without vertices at nodes': {
    reader: 'glb',
    make: (n) =>
      triangle({
        accessors: [{ componentType: 5126, type: 'VEC3', count: 0 }],
        meshes: [{ primitives: list(n / 64, () => ({ attributes: { POSITION: 0 } })) }],
        nodes: list(n / 32, () => ({ mesh: 0 })),
        scenes: [{ nodes: list(n / 32, (i) => i) }],
      }),
  },
  'glb: attributes': {
    reader: 'glb',
    make: (n) =>
      triangle({
        meshes: [{ primitives: [{ attributes: Object.fromEntries(list(n / 12, (i) => [i ? `_A${i}` : 'POSITION', 0])) }] }],
      }),
  },
  'glb: morph targets': {
    reader: 'glb',
    make: (n) =>
      triangle({
        meshes: [{ primitives: [{ attributes: { POSITION: 0 }, targets: list(n / 16, () => ({ POSITION: 0 })) }], weights: [1] }],
      }),
  },
  'glb: morph targets and examples': {
    reader: 'glb',
    make: (n) =>
      triangle({
        extensionsUsed: ['HANDLEBODY_pose_space'],
        meshes: [
          {
            primitives: [{ attributes: { POSITION: 0 }, targets: list(n / 56, () => ({ POSITION: 0 })) }],
            extensions: {
              HANDLEBODY_pose_space: {
                version: 1,
                dimensions: [{ name: 'a', min: 0, max: 1 }],
                examples: list(n / 56, () => ({ name: '', at: [0], target: 0 })),
              },
            },
          },
        ],
      }),
  },
  'glb: accessors': {
    reader: 'glb',
    make: (n) => triangle({ accessors: list(n / 65, () => ({ bufferView: 0, componentType: 5126, type: 'VEC3', count: 3 })) }),
  },
  'glb: accessors of the same bytes': {
    reader: 'glb',
    make: (n) =>
      triangle(
        {
          accessors: list(n / 130, () => ({ bufferView: 0, componentType: 5126, type: 'VEC3', count: Math.floor(n / 24) })),
          meshes: [{ primitives: list(n / 130, (i) => ({ attributes: { POSITION: i } })) }],
        },
        Math.floor(n / 24),
      ),
  },
  'glb: views': { reader: 'glb', make: (n) => triangle({ bufferViews: list(n / 30, () => ({ buffer: 0, byteLength: 36 })) }) },
  'glb: buffers': {
    reader: 'glb',
    make: (n) => triangle({ buffers: [{ byteLength: 36 }, ...list(n / 40, () => ({ byteLength: 0, uri: 'data:,' }))] }),
  },
  'glb: vertices that are not there': {
    reader: 'glb',
    make: (n) => triangle({ accessors: [{ componentType: 5126, type: 'VEC3', count: 60 * n }], extras: { text: 'a'.repeat(n) } }),
  },
  'glb: bytes that are not there': {
    reader: 'glb',
    make: (n) =>
      triangle({
        accessors: [{ componentType: 5120, normalized: true, type: 'VEC3', count: 300 * n }],
        extras: { text: 'a'.repeat(n) },
      }),
  },
  'glb: sparse vertices': {
    reader: 'glb',
    make: (n) =>
      triangle({
        accessors: list(n / 250, () => ({
          componentType: 5126,
          type: 'VEC3',
          count: 1000,
          sparse: { count: 1, indices: { bufferView: 0, componentType: 5121 }, values: { bufferView: 0 } },
        })),
        meshes: [{ primitives: list(n / 250, (i) => ({ attributes: { POSITION: i } })) }],
      }),
  },
  'glb: one mesh at many nodes': {
    reader: 'glb',
    make: (n) =>
      triangle({ nodes: list(n / 40, () => ({ mesh: 0 })), scenes: [{ nodes: list(n / 40, (i) => i) }] }, Math.floor(n / 48)),
  },
  'glb: materials, textures and images': {
    reader: 'glb',
    make: (n) =>
      triangle({
        images: list(n / 150, () => ({ uri: 'data:image/png;base64,iVBORw0KGgo=' })),
        textures: list(n / 150, (i) => ({ source: i })),
        materials: list(n / 150, (i) => ({ pbrMetallicRoughness: { baseColorTexture: { index: i } } })),
      }),
  },
  'glb: textures of one image': {
    reader: 'glb',
    make: (n) =>
      triangle({
        images: [{ uri: 'data:image/png;base64,iVBORw0KGgo=' }],
        textures: list(n / 80, () => ({ source: 0 })),
        materials: list(n / 80, (i) => ({ pbrMetallicRoughness: { baseColorTexture: { index: i } } })),
      }),
  },
  'glb: materials of one texture': {
    reader: 'glb',
    make: (n) =>
      triangle({
        images: [{ uri: 'data:image/png;base64,iVBORw0KGgo=' }],
        textures: [{ source: 0 }],
        materials: list(n / 64, () => ({ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } })),
      }),
  },
  'glb: skins': { reader: 'glb', make: (n) => triangle({ skins: list(n / 15, () => ({ joints: [0] })) }) },
  'glb: joints': {
    reader: 'glb',
    make: (n) =>
      skinned({
        nodes: [{ mesh: 0, skin: 0 }, ...list(n / 10, () => ({}))],
        scenes: [{ nodes: list(n / 10, (i) => i) }],
        skins: [{ joints: list(n / 10, (i) => i + 1) }],
      }),
  },
  'glb: joints in chains, the root last': {
    reader: 'glb',
    make: (n) =>
      skinned({
        nodes: [{ mesh: 0, skin: 0 }, ...chains(n / 30, 2)],
        scenes: [{ nodes: [0, ...list(n / 30 / 400, (i) => 400 * i + 1)] }],
        skins: [{ joints: list(n / 30, (i) => Math.floor(n / 30) - i) }],
      }),
  },
  'glb: one joint many times': {
    reader: 'glb',
    make: (n) =>
      skinned({ nodes: [{ mesh: 0, skin: 0 }, {}], scenes: [{ nodes: [0, 1] }], skins: [{ joints: list(n / 2, () => 1) }] }),
  },
  'glb: animations': {
    reader: 'glb',
    make: (n) =>
      triangle({
        animations: list(n / 100, () => ({
          samplers: [{ input: 0, output: 0 }],
          channels: [{ sampler: 0, target: { node: 0, path: 'weights' } }],
        })),
      }),
  },
  'glb: channels': {
    reader: 'glb',
    make: (n) =>
      triangle({
        animations: [
          {
            samplers: list(n / 80, () => ({ input: 0, output: 0 })),
            channels: list(n / 80, (i) => ({ sampler: i, target: { node: 0, path: 'weights' } })),
          },
        ],
      }),
  },
  'glb: cameras': {
    reader: 'glb',
    make: (n) =>
      triangle({
        cameras: list(n / 90, () => ({ type: 'perspective', perspective: { yfov: 1, znear: 1 } })),
        nodes: list(n / 90, (i) => ({ mesh: 0, camera: i })),
        scenes: [{ nodes: list(n / 90, (i) => i) }],
      }),
  },
  'glb: names of extensions': { reader: 'glb', make: (n) => triangle({ extensionsUsed: list(n / 10, (i) => `X_${i}`) }) },
  'glb: unknown extensions everywhere': {
    reader: 'glb',
    make: (n) =>
      triangle({
        extensionsUsed: list(90, (i) => `X_${i}`),
        nodes: list(n / 40, (i) => ({ extensions: { [`X_${i % 90}`]: {} } })),
        scenes: [{ nodes: [0] }],
      }),
  },
  'glb: a name': { reader: 'glb', make: (n) => triangle({ nodes: [{ name: 'a'.repeat(n), mesh: 0 }] }) },
  'glb: skipped parts of a body': {
    reader: 'glb',
    make: (n) =>
      triangle({
        extensionsUsed: ['HANDLEBODY_body'],
        nodes: list(n / 40, () => ({ mesh: 0 })),
        scenes: [{ nodes: list(n / 40, (i) => i) }],
        extensions: { HANDLEBODY_body: body({ reading: { skipped: list(n / 14, (i) => 65535 - i) } }) },
      }),
  },
  'glb: chunks': {
    reader: 'glb',
    make: (n) => {
      const file = triangle({});
      const out = new Uint8Array(file.length + 8 * Math.floor(n / 8));
      out.set(file);
      new DataView(out.buffer).setUint32(8, out.length, true);
      return out;
    },
  },
  'gltf: a data URI of percents': {
    reader: 'gltf',
    make: (n) =>
      text(
        JSON.stringify({
          asset: { version: '2.0' },
          buffers: [{ byteLength: 3, uri: `data:,${repeat('%41', n)}` }],
          scenes: [{ nodes: [] }],
        }),
      ),
  },
  'gltf: a data URI of parameters': {
    reader: 'gltf',
    make: (n) =>
      text(
        JSON.stringify({
          asset: { version: '2.0' },
          buffers: [{ byteLength: 3, uri: `data:${repeat('; ', n)}base64,AAAA` }],
          scenes: [{ nodes: [] }],
        }),
      ),
  },
  'gltf: one file as many buffers': {
    reader: 'gltf',
    make: (n) =>
      text(
        JSON.stringify({
          asset: { version: '2.0' },
          buffers: list(n / 36, () => ({ uri: 'a', byteLength: 100000 })),
          scenes: [{ nodes: [] }],
        }),
      ),
  },
  'gltf: brackets': { reader: 'gltf', make: (n) => text(`{"a":${'['.repeat(n)}`) },
  'handles: brackets': { reader: 'handles', make: (n) => text(`{"handles":${nested(n / 2)}}`) },
  'handles: handles': {
    reader: 'handles',
    make: (n) => text(JSON.stringify({ handles: list(n / 28, () => ({ vertex: 0, to: [0, 0, 0] })) })),
  },
  'handles: a number of all digits': {
    reader: 'handles',
    make: (n) => text(`{"handles":[{"vertex":0,"to":[${'1'.repeat(n)},0,0]}]}`),
  },
  'any: blanks before nothing': { reader: 'format', make: (n) => text(' '.repeat(n)) },
  'any: zeros': { reader: 'format', make: (n) => new Uint8Array(n) },
};

/** @param {object} more */
function skinned(more) {
  const bin = new Uint8Array(36 + 12 + 48);
  new Float32Array(bin.buffer, 0, 9).set([0, 0, 0, 1, 0, 0, 0, 1, 0]);
  new Float32Array(bin.buffer, 48, 12).fill(0.25);
  const accessors = [
    { bufferView: 0, componentType: 5126, type: 'VEC3', count: 3 },
    { bufferView: 1, componentType: 5121, type: 'VEC4', count: 3 },
    { bufferView: 2, componentType: 5126, type: 'VEC4', count: 3 },
  ];
  const bufferViews = [
    [0, 36],
    [36, 12],
    [48, 48],
  ].map(([byteOffset, byteLength]) => ({ buffer: 0, byteOffset, byteLength }));
  return glb(
    {
      buffers: [{ byteLength: bin.length }],
      bufferViews,
      accessors,
      meshes: [{ primitives: [{ attributes: { POSITION: 0, JOINTS_0: 1, WEIGHTS_0: 2 } }] }],
      ...more,
    },
    bin,
  );
}

/** What a body says, without its arrays. @param {object} more */
function body(more) {
  return {
    version: 1,
    distance: 'fast-marching',
    positionsHash: '0123456789abcdef',
    arraysHash: '0123456789abcdef',
    normalization: { center: [0, 0, 0], diagonal: 1 },
    grid: { origin: [0, 0, 0], spacing: 1, dimensions: [1, 1, 1] },
    distanceScale: 1,
    ...more,
  };
}
