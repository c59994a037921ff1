/** One table for all formats: what is passed over, with which warning, and that strict reading refuses it; what is an error in all. */
import { describe, expect, it } from 'vitest';
import type { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { FileMesh, FileWarningCode } from '../../web/assets/index.ts';
import {
  binaryPly,
  binaryStl,
  bytesOf,
  obj,
  off,
  plyHeader,
  ply as plyOf,
  SHAPES,
  stl as stlOf,
  utf16,
} from './support/made-files.mjs';
import { attempt, faultOf, READERS } from './support/readers.ts';
import { measure } from './support/surfaces.ts';

const box = SHAPES.box as { points: number[][]; faces: number[][] };
const texts = { obj: obj(box), ply: plyOf(box), stl: stlOf(box), off: off(box) };
type Format = keyof typeof texts;
const FORMATS = Object.keys(texts) as Format[];

const reader = (format: Format) => READERS[format] as (typeof READERS)[string];
const read = (format: Format, content: string | Uint8Array, strict = false) =>
  attempt(() => reader(format)(typeof content === 'string' ? bytesOf(content) : content, { strict }));

/** More vertices, which no face uses, before the faces; and more faces. STL has no vertices without faces. */
function grown(format: Exclude<Format, 'stl'>, vertices: string[], faces: string[] = []): string {
  const lines = texts[format].trimEnd().split('\n');
  const announce = (line: string) =>
    line
      .replace('element vertex 8', `element vertex ${8 + vertices.length}`)
      .replace('element face 6', `element face ${6 + faces.length}`)
      .replace(/^8 6 0$/, `${8 + vertices.length} ${6 + faces.length} 0`);
  const [rows, ends] = [lines.slice(0, -6), lines.slice(-6)];
  const mark = (line: string) => (format === 'obj' ? `v ${line}` : line);
  const face = (corners: string) => {
    const numbers = corners.split(' ').map(Number);
    return format === 'obj' ? `f ${numbers.map((v) => v + 1).join(' ')}` : [numbers.length, ...numbers].join(' ');
  };
  return `${[...rows.map(announce), ...vertices.map(mark), ...ends, ...faces.map(face)].join('\n')}\n`;
}
const facet = (...corners: string[]) =>
  texts.stl.replace(
    'endsolid',
    `facet normal 0 0 1\nouter loop\n${corners.map((c) => `vertex ${c}\n`).join('')}endloop\nendfacet\nendsolid`,
  );

interface Defect {
  readonly code: FileWarningCode;
  readonly count?: number;
  /** The file with its defect, where the format can have it. */
  readonly files: Partial<Record<Format, string | Uint8Array>>;
  /** Triangles besides those of the box. */
  readonly more?: number;
  /** What the format allows. */
  readonly isSound?: true;
}

const normals = (rows: string[]) => {
  const lines = texts.ply.split('\n');
  const at = lines.indexOf('end_header') + 1;
  return lines
    .map((line, i) => (i >= at && i < at + 8 ? `${line} ${rows[i - at]}` : line))
    .join('\n')
    .replace('property float z\n', 'property float z\nproperty float nx\nproperty float ny\nproperty float nz\n');
};
const up = Array<string>(8).fill('0 0 1');
const nof = (rows: string[]) =>
  off({ ...box, points: box.points.map((p, i) => [...p, ...(rows[i] as string).split(' ')] as number[]) }, 'NOFF');

const DEFECTS: Record<string, Defect> = {
  'a face of two corners': {
    code: 'faces-degenerate',
    files: {
      obj: grown('obj', [], ['0 1']),
      ply: grown('ply', [], ['0 1']),
      off: grown('off', [], ['0 1']),
      stl: facet('0 0 0', '1 0 0'),
    },
  },
  'two faces of one corner': {
    code: 'faces-degenerate',
    count: 2,
    files: { obj: grown('obj', [], ['0', '3']), ply: grown('ply', [], ['0', '3']), off: grown('off', [], ['0', '3']) },
  },
  'a flat triangle': {
    code: 'triangles-flat',
    more: 1,
    files: {
      obj: grown('obj', [], ['0 1 1']),
      ply: grown('ply', [], ['0 1 1']),
      off: grown('off', [], ['0 1 1']),
      stl: facet('0 0 0', '2 0 0', '2 0 0'),
    },
  },
  'a face that is there twice': {
    code: 'triangles-doubled',
    count: 2,
    more: 2,
    files: {
      obj: grown('obj', [], ['4 5 6 7']),
      ply: grown('ply', [], ['4 5 6 7']),
      off: grown('off', [], ['4 5 6 7']),
      stl: facet('0 0 1', '2 0 1', '2 1 1', '0 1 1'),
    },
  },
  'a face that crosses itself': {
    code: 'faces-crossing',
    more: 3,
    files: {
      obj: grown('obj', ['0 0 0', '.4 0 0', '0 .3 0', '.4 .2 0', '.5 .5 0'], ['8 9 10 11 12']),
      ply: grown('ply', ['0 0 0', '.4 0 0', '0 .3 0', '.4 .2 0', '.5 .5 0'], ['8 9 10 11 12']),
      off: grown('off', ['0 0 0', '.4 0 0', '0 .3 0', '.4 .2 0', '.5 .5 0'], ['8 9 10 11 12']),
      stl: facet('0 0 0', '.4 0 0', '0 .3 0', '.4 .2 0', '.5 .5 0'),
    },
  },
  ...Object.fromEntries(
    ['nan nan nan', '0 inf 0', '-Infinity 0 0', '0x1 0 0', '1e400 0 0', '1e39 0 0', '1,5 0 0', '- 0 0', 'one 0 0'].map((place) => [
      `a vertex of no face at ${place}`,
      {
        code: 'positions-bad',
        files: { obj: grown('obj', [place]), ply: grown('ply', [place]), off: grown('off', [place]) },
      } as const,
    ]),
  ),
  'a normal that is no number': {
    code: 'normals-bad',
    files: { obj: `vn 0 nan 0\n${texts.obj}`, ply: normals(['nan 0 0', ...up.slice(1)]), off: nof(['nan 0 0', ...up.slice(1)]) },
  },
  'a normal of no length': {
    code: 'normals-bad',
    files: { obj: `vn 0 0 0\n${texts.obj}`, ply: normals(['0 0 0', ...up.slice(1)]), off: nof(['0 0 0', ...up.slice(1)]) },
  },
  'a normal that is not there': {
    code: 'normals-bad',
    count: 4,
    files: { obj: texts.obj.replace(/^f (\d) (\d) (\d) (\d)/m, 'f $1//9 $2//9 $3//9 $4//9') },
  },
  'a texture coordinate that is no number': {
    code: 'uvs-bad',
    files: {
      obj: `vt nan 0\n${texts.obj}`,
      ply: texts.ply
        .replace('property float z\n', 'property float z\nproperty float s\nproperty float t\n')
        .replaceAll(/^(\d+ \d+ \d+)$/gm, (_, p, at, all) => `${p} 0 ${at === all.search(/^\d+ \d+ \d+$/m) ? 'nan' : 0}`),
      off: off({ ...box, points: box.points.map((p, i) => [...p, 0, i === 3 ? Number.NaN : 0]) }, 'STOFF'),
    },
  },
  'unknown lines': {
    code: 'statements-unknown',
    count: 2,
    files: {
      obj: `hello\nworld 1 2 3\n${texts.obj}`,
      ply: texts.ply.replace('element vertex', 'hello\nworld 1 2 3\nelement vertex'),
      stl: texts.stl.replace('facet', 'hello\nworld 1 2 3\nfacet'),
    },
  },
  'lines behind the end': {
    code: 'data-left-over',
    count: 10,
    files: { ply: `${texts.ply}hello\n1 2 3\n`, off: `${texts.off}hello\n1 2 3\n` },
  },
  'bytes behind the end': {
    code: 'data-left-over',
    count: 5,
    files: {
      ply: Uint8Array.from([...binaryPly(box, true), 1, 2, 3, 4, 5]),
      stl: Uint8Array.from([...binaryStl(box), 1, 2, 3, 4, 5]),
    },
  },
  'a final Ctrl-Z': {
    code: 'data-left-over',
    files: Object.fromEntries(FORMATS.map((format) => [format, `${texts[format]}\x1a`])),
  },
  'trailing zeros': {
    code: 'data-left-over',
    count: 7,
    files: Object.fromEntries(FORMATS.map((format) => [format, `${texts[format]}${'\0'.repeat(7)}\n`])),
  },
  'rows with more numbers than announced': {
    code: 'numbers-left-over',
    count: 6,
    files: { ply: texts.ply.replaceAll(/^(4 .*)$/gm, '$1 255 0 0') },
  },
  'no name of the format': {
    code: 'keyword-missing',
    files: { off: texts.off.replace('OFF\n', '') },
  },
  colors: {
    code: 'attributes-left-out',
    count: 8,
    isSound: true,
    files: {
      obj: texts.obj.replaceAll(/^(v .*)$/gm, '$1 .5 .5 .5'),
      ply: texts.ply
        .replace('property float z\n', 'property float z\nproperty uchar red\n')
        .replaceAll(/^(\d+ \d+ \d+)$/gm, '$1 255'),
      off: off({ ...box, points: box.points.map((p) => [...p, 255, 0, 0, 255]) }, 'COFF'),
    },
  },
  'colors of triangles': {
    code: 'attributes-left-out',
    count: 12,
    isSound: true,
    files: { stl: binaryStl(box).map((byte, i) => (i >= 84 && (i - 84) % 50 >= 48 ? 0x7f : byte)) },
  },
};

const cases = Object.entries(DEFECTS).flatMap(([name, defect]) =>
  Object.entries(defect.files).map(([format, file]) => [name, format as Format, file, defect] as const),
);

describe('what does not matter for the surface', () => {
  it('is a table of many', () => expect(cases.length).toBeGreaterThan(60));

  it.each(cases)(
    '%s, in %s: is passed over with one warning that counts, and refused by strict reading',
    (_, format, file, defect) => {
      const { code, count = 1, more = 0, isSound } = defect;
      const mesh = read(format, file) as FileMesh;
      expect(mesh.warnings).toMatchObject([
        { code, count, message: expect.stringContaining(`${count}`.replace(/^1$/, '')), remedy: /./ },
      ]);
      expect(faultOf(mesh)).toBeUndefined();
      const { low, high, triangles } = measure(mesh);
      expect([low, high, triangles]).toEqual([[0, 0, 0], [2, 1, 1], 12 + more]);
      const strict = read(format, file, true);
      if (isSound) expect(strict).toEqual(mesh);
      else {
        expect(strict).toMatchObject({ name: 'HandlebodyError', code: 'file-invalid', remedy: /./ });
        const { message, culprit } = strict as HandlebodyError;
        expect(message.includes('Line ') || culprit !== undefined || code === 'faces-crossing').toBe(true);
      }
    },
  );

  it.each(FORMATS)('is nothing in a sound %s', (format) => {
    for (const strict of [false, true]) expect((read(format, texts[format], strict) as FileMesh).warnings).toEqual([]);
  });
});

const FRAMES: Record<string, (text: string, format: Format) => string | Uint8Array> = {
  'a mark': (text) => `\ufeff${text}`,
  'UTF-16, little, with a mark': (text) => utf16(text, true, true),
  'UTF-16, big, with a mark': (text) => utf16(text, false, true),
  'UTF-16, little, without a mark': (text) => utf16(text, true, false),
  'UTF-16, big, without a mark': (text) => utf16(text, false, false),
  'lines that end in \\r\\n': (text) => text.replaceAll('\n', '\r\n'),
  'lines that end in \\r': (text) => text.replaceAll('\n', '\r'),
  'no last line end': (text) => text.trimEnd(),
  'blank lines and blanks': (text, format) => (format === 'ply' ? text.replaceAll('\n', ' \n') : text.replaceAll('\n', '  \n\n')),
  tabs: (text, format) => (format === 'ply' ? text.replace('0 0 0\n', '0\t0\t0\n') : text.replaceAll(' ', '\t')),
  'numbers of other kinds': (text) => text.replace('2 1 1', '+2.0 1E0 .1e+1'),
};

describe('frames of a text', () => {
  it.each(Object.keys(FRAMES).flatMap((name) => FORMATS.map((format) => [name, format] as const)))(
    '%s: %s is the same',
    (name, format) => {
      const framed = (FRAMES[name] as (typeof FRAMES)[string])(texts[format], format);
      expect(read(format, framed, true)).toEqual(read(format, texts[format]));
    },
  );

  it.each(FORMATS)('errors in %s name the line, and its byte in the file as it is', (format) => {
    const bad = texts[format].replace('2 0 0', '2 x 0');
    const plain = read(format, bad) as HandlebodyError;
    expect(plain).toMatchObject({ code: 'file-invalid', message: /^Line \d+ of the/ });
    const at = plain.culprit?.index as number;
    expect(bad.slice(at)).toMatch(/^(v |vertex )?2 x 0/);
    expect(read(format, `\ufeff${bad}`)).toMatchObject({ message: plain.message, culprit: { kind: 'byte', index: at + 3 } });
    expect(read(format, utf16(bad, true, true))).toMatchObject({ culprit: { index: 2 * at + 2 } });
    expect(read(format, utf16(bad, false, false))).toMatchObject({ culprit: { index: 2 * at } });
  });

  it('letters beyond ASCII before the line count by what they take in the file', () => {
    const bad = `# äöü 𝄞\n${texts.obj.replace('2 0 0', '2 x 0')}`;
    expect(read('obj', utf16(bad, true, true))).toMatchObject({ culprit: { index: 2 + 2 * bad.indexOf('v 2 x') } });
  });

  it('no binary PLY is in UTF-16', () => {
    const bytes = utf16(plyHeader(box, 'binary_little_endian'), true, true);
    expect(read('ply', bytes)).toMatchObject({ code: 'file-invalid', message: /UTF-16/ });
  });
});

describe('what matters for the surface is an error in all formats', () => {
  it.each(FORMATS)('a place that is no number, in %s', (format) => {
    for (const word of ['nan', 'inf', '-inf', '1e400', '0x1', 'one', '1.5.2', '--1'])
      expect(read(format, texts[format].replace('2 0 0', `2 ${word} 0`))).toMatchObject({
        code: 'file-invalid',
        message: /^Line /,
      });
  });

  it.each(['obj', 'ply', 'off'] as const)('a vertex that is not there, in %s', (format) => {
    const [first, beyond] = format === 'obj' ? ['f 4 3 2 1', 'f 4 3 2'] : ['4 3 2 1 0', '4 3 2 1'];
    for (const word of ['9', '99999999999', '1.5', 'x', ...(format === 'obj' ? ['0', '-9'] : ['8', '-1'])])
      expect(read(format, texts[format].replace(first, `${beyond} ${word}`))).toMatchObject({
        code: 'file-invalid',
        message: /^Line /,
      });
  });

  it.each(FORMATS)('nothing at all, and a web page, in %s', (format) => {
    for (const text of ['', '\n', ' \n\n', '\0\0', '\x1a', '<!DOCTYPE html>\n<html></html>\n', '{"asset": {}}', 'PK\x03\x04'])
      expect(read(format, text)).toMatchObject({ name: 'HandlebodyError', code: /^file-(invalid|truncated)$/ });
  });

  it.each(['obj', 'ply', 'off'] as const)('faces of which none has three corners, in %s', (format) => {
    const kept = texts[format].replaceAll(
      format === 'obj' ? /^f (\d \d).*$/gm : /^4 (\d \d).*$/gm,
      format === 'obj' ? 'f $1' : '2 $1',
    );
    expect(read(format, kept)).toMatchObject({
      code: 'file-invalid',
      message: /of 2 corners and needs 3/,
      culprit: { kind: 'byte' },
    });
  });

  it.each(['obj', 'ply', 'off'] as const)('a cloud keeps its points, and each has to have a place, in %s', (format) => {
    const cloud = { obj, ply: plyOf, off }[format]({ ...box, faces: [] });
    expect(read(format, cloud)).toMatchObject({ positions: { length: 24 }, triangles: { length: 0 }, warnings: [] });
    expect(read(format, cloud.replace('2 0 0', '2 nan 0'))).toMatchObject({ code: 'file-invalid', message: /^Line / });
  });
});
