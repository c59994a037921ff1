// Text in whatever encoding, with what old programs put behind it: a .gltf and a file of handles are read as the readers of the other formats
// read theirs, and what a file is its content says before its name does.
import { describe, expect, it } from 'vitest';
import { fileFormat } from '../../web/assets/file-format.ts';
import { readGltf, readMesh } from '../../web/assets/index.ts';
import { parseHandles } from '../../web/cli/handles.ts';

const MARK = '\ufeff';
const little = (text: string) => Buffer.from(text, 'utf16le');
const big = (text: string) => little(text).swap16();
const ENCODINGS: Readonly<Record<string, (text: string) => Buffer>> = {
  'UTF-8': (text) => Buffer.from(text),
  'UTF-8 with a mark': (text) => Buffer.from(MARK + text),
  'UTF-16, low bytes first': (text) => little(text),
  'UTF-16, low bytes first, with a mark': (text) => little(MARK + text),
  'UTF-16, high bytes first': (text) => big(text),
  'UTF-16, high bytes first, with a mark': (text) => big(MARK + text),
};
const ENDS = { nothing: '', 'Ctrl-Z': '\x1a', zeros: '\0\0\0', 'a line and both': '\r\n\x1a\0 \n' };
const WAYS = Object.keys(ENCODINGS).flatMap((encoding) =>
  Object.keys(ENDS).map((end) => ({ encoding, end: end as keyof typeof ENDS })),
);

const positions = Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0);
const GLTF = JSON.stringify({
  asset: { version: '2.0' },
  scenes: [{ nodes: [0], name: 'Größe ✓' }],
  nodes: [{ mesh: 0 }],
  meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
  accessors: [{ bufferView: 0, componentType: 5126, type: 'VEC3', count: 3, min: [0, 0, 0], max: [1, 1, 0] }],
  bufferViews: [{ buffer: 0, byteLength: 36 }],
  buffers: [{ byteLength: 36, uri: `data:;base64,${Buffer.from(positions.buffer).toString('base64')}` }],
});
const HANDLES = '{ "handles": [{ "vertex": 2, "to": [1, 2, 3] }] }';

describe.each(WAYS)('text in $encoding, with $end behind it', ({ encoding, end }) => {
  const encode = (text: string) => (ENCODINGS[encoding] as (text: string) => Buffer)(text + ENDS[end]);

  it('is read as a .gltf', async () => {
    expect(fileFormat(encode(GLTF), 'no.ending')).toBe('glTF');
    const document = await readGltf(encode(GLTF));
    expect(Array.from(readMesh(document).mesh.positions)).toEqual(Array.from(positions));
    expect(document.getRoot().listScenes()[0]?.getName()).toBe('Größe ✓');
  });

  it('is read as handles', () => {
    const { handles, targets } = parseHandles(encode(HANDLES), { vertexCount: 3 });
    expect(handles).toEqual([{ vertex: 2 }]);
    expect(Array.from(targets.subarray(0, 3))).toEqual([1, 2, 3]);
  });
});

describe('what is none of JSON', () => {
  it.each(['{', '{ "handles": [\0] }', `${HANDLES}x`, '\x1a', '', '\xff\xfe'])('is refused: %j', (text) => {
    expect(() => parseHandles(Buffer.from(text), { vertexCount: 3 })).toThrow(expect.objectContaining({ code: 'file-invalid' }));
  });
});

describe('the name of a file', () => {
  const TEXTS = {
    OBJ: 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n',
    OFF: 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n',
    PLY: 'ply\nformat ascii 1.0\n',
    STL: 'solid\nfacet normal 0 0 1\n',
    glTF: GLTF,
  };
  const ENDINGS = ['obj', 'off', 'ply', 'stl', 'gltf', 'GLTF', 'glb', 'txt'];

  it.each(Object.keys(TEXTS).flatMap((format) => ENDINGS.map((ending) => [format, ending])))(
    '%s is told though it ends in .%s',
    (format, ending) => {
      expect(fileFormat(Buffer.from(TEXTS[format as keyof typeof TEXTS]), `model.${ending}`)).toBe(format);
    },
  );

  it.each(['OFF8 12 0\n', 'COFF8 12 0\n', 'OFF 8 12 0\n', 'off8 12 0\n'])(
    'counts for less than a keyword with a number behind it: %j',
    (text) => {
      expect(fileFormat(Buffer.from(text), 'model.obj')).toBe('OFF');
    },
  );

  it('counts where the content says nothing', () => {
    for (const [ending, format] of [
      ['obj', 'OBJ'],
      ['gltf', 'glTF'],
      ['GLTF', 'glTF'],
      ['Ply', 'PLY'],
      ['glb', 'GLB'],
      ['', 'GLB'],
    ])
      expect(fileFormat(Buffer.from('?'), `model.${ending}`)).toBe(format);
  });
});
