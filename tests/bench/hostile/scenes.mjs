/** Hostile glTF and HANDLES.json, and bytes of nothing. */
import { body, chains, list, nested, repeat, skinned, text, triangle, withText } from './make.mjs';

/** @type {Record<string, import('./make.mjs').Kind>} */
export const SCENES = {
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
  'glb: instances that are not there': {
    reader: 'glb',
    make: (n) =>
      triangle({
        accessors: [
          { bufferView: 0, componentType: 5126, type: 'VEC3', count: 3 },
          { componentType: 5126, type: 'VEC3', count: 60 * n },
        ],
        extensionsUsed: ['EXT_mesh_gpu_instancing'],
        nodes: [{ mesh: 0, extensions: { EXT_mesh_gpu_instancing: { attributes: { TRANSLATION: 1 } } } }],
        extras: { text: 'a'.repeat(n) },
      }),
  },
  'glb: a key again and again': {
    reader: 'glb',
    make: (n) => withText(triangle({ extras: 'HERE' }), '"HERE"', `{${repeat('"a":0,', n)}"b":0}`),
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
  'gltf: a data URI of blanks': {
    reader: 'gltf',
    make: (n) =>
      text(
        JSON.stringify({
          asset: { version: '2.0' },
          buffers: [{ byteLength: 3, uri: `data:;base64,${' '.repeat(n)}AAAA` }],
          scenes: [{ nodes: [] }],
        }),
      ),
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
