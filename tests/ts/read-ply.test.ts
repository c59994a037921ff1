/** PLY reading in its three formats; and that no bytes whatsoever do worse than a HandlebodyError, or take memory that they do not have. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { readPly } from '../../web/assets/index.ts';
import { outlines, outlinesOf } from './support/outlines.ts';

const SEED = 20260811;

type Format = 'ascii' | 'binary_little_endian' | 'binary_big_endian';
const FORMATS: readonly Format[] = ['ascii', 'binary_little_endian', 'binary_big_endian'];
const SIZES: Record<string, number> = {
  char: 1,
  uchar: 1,
  short: 2,
  ushort: 2,
  int: 4,
  uint: 4,
  float: 4,
  double: 8,
  float32: 4,
  uint8: 1,
};

/** A column of an element: its type and name, a list where `lengthType` is given; and one value, or list, a row. */
interface Column {
  readonly type: string;
  readonly name: string;
  readonly lengthType?: string;
  readonly rows: readonly (number | readonly number[])[];
}

function writePly(format: Format, elements: readonly (readonly [string, readonly Column[]])[], end = '\n'): Uint8Array {
  const head = ['ply', `format ${format} 1.0`, 'comment made by a test'];
  const body: number[] = [];
  const put = (type: string, value: number) => {
    const view = new DataView(new ArrayBuffer(8));
    const little = format === 'binary_little_endian';
    if (type === 'double') view.setFloat64(0, value, little);
    else if (type.startsWith('float')) view.setFloat32(0, value, little);
    else if (SIZES[type] === 4) view.setUint32(0, value, little);
    else if (SIZES[type] === 2) view.setUint16(0, value, little);
    else view.setUint8(0, value);
    for (let i = 0; i < (SIZES[type] ?? 0); i++) body.push(view.getUint8(i));
  };
  const encode = (text: string) => [...new TextEncoder().encode(text)];
  for (const [name, columns] of elements) {
    const count = columns[0]?.rows.length ?? 0;
    head.push(`element ${name} ${count}`);
    for (const { type, name: column, lengthType } of columns)
      head.push(`property ${lengthType ? `list ${lengthType} ` : ''}${type} ${column}`);
    for (let row = 0; row < count; row++) {
      const words: number[] = [];
      for (const { type, rows, lengthType } of columns) {
        const value = rows[row] ?? 0;
        if (lengthType) {
          const list = value as readonly number[];
          words.push(list.length, ...list);
          if (format !== 'ascii') put(lengthType, list.length);
          if (format !== 'ascii') for (const number of list) put(type, number);
        } else {
          words.push(value as number);
          if (format !== 'ascii') put(type, value as number);
        }
      }
      if (format === 'ascii') body.push(...encode(words.join(' ') + end));
    }
  }
  return Uint8Array.from([...encode([...head, 'end_header', ''].join(end)), ...body]);
}

const column = (type: string, name: string, rows: Column['rows'], lengthType?: string): Column => ({
  type,
  name,
  rows,
  ...(lengthType !== undefined && { lengthType }),
});

/** Vertices of a shape with something to skip before, between and behind. */
const vertexColumns = (points: readonly (readonly number[])[], type = 'float'): Column[] => [
  column(
    type,
    'x',
    points.map((p) => p[0] ?? 0),
  ),
  column(
    'uchar',
    'red',
    points.map((_, i) => i % 256),
  ),
  column(
    type,
    'y',
    points.map((p) => p[1] ?? 0),
  ),
  column(
    'int',
    'neighbors',
    points.map((_, i) => Array<number>(i % 3).fill(7)),
    'uchar',
  ),
  column(
    type,
    'z',
    points.map((p) => p[2] ?? 0),
  ),
];

const TRIANGLE = [
  [0, 0, 0],
  [1, 0, 0],
  [0, 1, 0.5],
];

function errorOf(work: () => unknown): HandlebodyError {
  try {
    work();
  } catch (error) {
    if (error instanceof HandlebodyError) return error;
    throw error;
  }
  throw new Error('nothing was thrown');
}

const bytesOf = (...lines: string[]) => new TextEncoder().encode(lines.join('\n'));
const ASCII_TRIANGLE = ['ply', 'format ascii 1.0', 'element vertex 3', 'property float x', 'property float y', 'property float z'];

describe('readPly', () => {
  it.each(FORMATS)('reads %s: positions, normals, texture coordinates, polygons; what else there is, it skips', (format) => {
    const { positions, triangles, normals, uvs } = readPly(
      writePly(format, [
        ['camera', [column('double', 'view', [1, 2])]],
        [
          'vertex',
          [
            ...vertexColumns([...TRIANGLE, [1, 1, 1]], 'double'),
            ...['nx', 'ny', 'nz'].map((name, axis) =>
              column(
                'float32',
                name,
                [0, 0, 0, 0].map(() => (axis === 1 ? 3 : 0)),
              ),
            ),
            column('float', 's', [0, 0.5, 1, 1]),
            column('float', 't', [0, 0.25, 1, 1]),
          ],
        ],
        [
          'face',
          [
            column('uchar', 'flags', [1, 2]),
            column(
              'int',
              'vertex_indices',
              [
                [0, 1, 2],
                [0, 1, 3, 2],
              ],
              'uint8',
            ),
          ],
        ],
        ['edge', [column('int', 'vertex1', [0])]],
      ]),
    );
    expect([...positions]).toEqual([...TRIANGLE.flat(), 1, 1, 1]);
    expect([...triangles]).toEqual([0, 1, 2, 0, 1, 3, 0, 3, 2]);
    expect([...(normals ?? [])]).toEqual([0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0]);
    expect([...(uvs ?? [])]).toEqual([0, 1, 0.5, 0.75, 1, 0, 1, 0]);
  });

  it.each(FORMATS)('reads triangle strips of %s, every second triangle turned round', (format) => {
    const points = Array.from({ length: 6 }, (_, i) => [i, i % 2, 0]);
    const strip = column('int', 'vertex_indices', [[0, 1, 2, 3, -1, 5, 4, 4, 3, 2]], 'int');
    const { triangles } = readPly(
      writePly(format, [
        ['vertex', vertexColumns(points)],
        ['tristrips', [strip]],
      ]),
    );
    expect([...triangles]).toEqual([0, 1, 2, 2, 1, 3, 4, 3, 2]);
  });

  it.each(['\n', '\r\n', '\r'])('finds the data behind a header whose lines end with %j', (end) => {
    for (const format of FORMATS) {
      // Its first byte is a line feed, which belongs to it.
      const points = [[format === 'ascii' ? 1 : (new Float32Array(Uint8Array.of(10, 10, 0, 0).buffer)[0] ?? 0), 2, 3]];
      const columns = ['x', 'y', 'z'].map((name, axis) => column('float', name, [points[0]?.[axis] ?? 0]));
      expect([...readPly(writePly(format, [['vertex', columns]], end)).positions]).toEqual(points[0]);
    }
  });

  it('reads a cloud of points as one without triangles', () => {
    const cloud = readPly(writePly('binary_little_endian', [['vertex', vertexColumns(TRIANGLE)]]));
    expect(cloud.triangles).toHaveLength(0);
    expect(cloud.positions).toHaveLength(9);
  });

  it('reads bytes that lie anywhere in a larger buffer', () => {
    const bytes = writePly('binary_big_endian', [['vertex', vertexColumns(TRIANGLE)]]);
    const larger = new Uint8Array(bytes.length + 8);
    larger.set(bytes, 3);
    expect([...readPly(larger.subarray(3, 3 + bytes.length)).positions]).toEqual(TRIANGLE.flat());
  });

  it.each([
    ['file-invalid', 'Line 1 ', ['plyx']],
    ['file-unsupported', '"2.0"', ['ply', 'format ascii 2.0', 'end_header']],
    ['file-invalid', 'Line 2 ', ['ply', 'format ebcdic 1.0', 'end_header']],
    ['file-invalid', 'Line 3 ', ['ply', 'format ascii 1.0', 'property float x', 'end_header']],
    ['file-invalid', 'Line 3 ', ['ply', 'format ascii 1.0', 'element vertex -1', 'end_header']],
    ['file-invalid', 'Line 3 ', ['ply', 'format ascii 1.0', 'element vertex 1e3', 'end_header']],
    ['file-invalid', '"half"', [...ASCII_TRIANGLE, 'property half w', 'end_header']],
    ['file-invalid', '"constructor"', [...ASCII_TRIANGLE, 'property constructor w', 'end_header']],
    ['file-invalid', 'fractions', [...ASCII_TRIANGLE, 'property list float int w', 'end_header']],
    ['file-invalid', 'Line 3 of the PLY file ends a header', ['ply', 'element vertex 3', 'end_header']],
    ['file-truncated', 'header', ASCII_TRIANGLE],
    ['file-invalid', 'no elements', ['ply', 'format ascii 1.0', 'end_header']],
    ['file-invalid', 'no properties', ['ply', 'format ascii 1.0', 'element vertex 3', 'end_header']],
    ['file-invalid', 'no z', [...ASCII_TRIANGLE.slice(0, -1), 'end_header', '0 0', '1 0', '0 1']],
    ['file-truncated', 'before vertex 2', [...ASCII_TRIANGLE, 'end_header', '0 0 000000000', '1 0 0']],
    ['file-invalid', 'Line 9 of the PLY file ends too early', [...ASCII_TRIANGLE, 'end_header', '0 0 0', '1 00000', '1 1 1']],
    ['file-invalid', 'finite number for y of vertex 0', [...ASCII_TRIANGLE, 'end_header', '0 nan 0', '1 1 1', '1 1 1']],
    [
      'file-invalid',
      'Line 13 of the PLY file asks for vertex 3 of 3',
      [
        ...ASCII_TRIANGLE,
        'element face 1',
        'property list uchar int vertex_index',
        'end_header',
        '0 0 0',
        '1 0 0',
        '0 1 0',
        '3 0 1 3',
      ],
    ],
    [
      'file-invalid',
      'no list called',
      [...ASCII_TRIANGLE, 'element face 1', 'property int vertex_index', 'end_header', '0 0 0', '1 0 0', '0 1 0', '3'],
    ],
    [
      'file-invalid',
      '2 corners',
      [
        ...ASCII_TRIANGLE,
        'element face 1',
        'property list uchar int vertex_index',
        'end_header',
        '0 0 0',
        '1 0 0',
        '0 1 0',
        '2 0 1',
      ],
    ],
  ] as [string, string, string[]][])('refuses with %s and %j', (code, what, lines) => {
    const error = errorOf(() => readPly(bytesOf(...lines)));
    expect(`${error.code}: ${error.message}`).toContain(`${code}: `);
    expect(error.message).toContain(what);
    expect(error.remedy).not.toBe('');
  });

  it('refuses counts that the file cannot hold before it allocates for them', () => {
    const before = process.memoryUsage().arrayBuffers;
    for (const count of [4, 2 ** 24, 2 ** 31, 2 ** 52]) {
      for (const format of FORMATS) {
        const bytes = writePly(format, [['vertex', vertexColumns(TRIANGLE)]]);
        const text = new TextDecoder('latin1').decode(bytes).replace('element vertex 3', `element vertex ${count}`);
        const hostile = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
        expect(errorOf(() => readPly(hostile)).code).toMatch(/^(file-truncated|mesh-too-large)$/);
      }
    }
    const list = writePly('binary_little_endian', [
      ['vertex', vertexColumns(TRIANGLE)],
      ['face', [column('int', 'vertex_indices', [[0, 1, 2]], 'uint')]],
    ]);
    new DataView(list.buffer).setUint32(list.length - 16, 0x7fff_ffff, true);
    expect(errorOf(() => readPly(list)).code).toBe('file-truncated');
    expect(process.memoryUsage().arrayBuffers - before).toBeLessThan(1e8);
  });

  const made = fc
    .array(fc.tuple(...Array.from({ length: 3 }, () => fc.float({ noNaN: true, noDefaultInfinity: true }))), {
      minLength: 1,
      maxLength: 20,
    })
    .chain((points) =>
      fc.record({
        format: fc.constantFrom(...FORMATS),
        points: fc.constant(points),
        faces: fc.array(fc.array(fc.nat(points.length - 1), { minLength: 3, maxLength: 5 }), { maxLength: 12 }),
        facesFirst: fc.boolean(),
      }),
    );
  type Made = typeof made extends fc.Arbitrary<infer T> ? T : never;
  const write = ({ format, points, faces, facesFirst }: Made) => {
    const elements: [string, Column[]][] = [
      ['vertex', vertexColumns(points)],
      [
        'face',
        [
          column('int', 'vertex_indices', faces, 'uchar'),
          column(
            'ushort',
            'group',
            faces.map((_, i) => i),
          ),
        ],
      ],
    ];
    return writePly(format, facesFirst ? elements.reverse() : elements);
  };

  it(`gives back what was written (seed ${SEED})`, () => {
    fc.assert(
      fc.property(made, (shape) => {
        const { positions, triangles } = readPly(write(shape));
        expect([...positions].map((x) => x + 0)).toEqual(shape.points.flat().map((x) => x + 0));
        expect(outlines(triangles)).toEqual(outlinesOf(shape.faces));
      }),
      { seed: SEED, numRuns: 300 },
    );
  });

  it(`survives damage of any kind with a mesh or a HandlebodyError (seed ${SEED + 1})`, () => {
    const outcomes = { read: 0, refused: 0 };
    fc.assert(
      fc.property(
        made,
        fc.array(fc.tuple(fc.nat(), fc.nat(255)), { minLength: 1, maxLength: 3 }),
        fc.nat(),
        (shape, changes, cut) => {
          let bytes = write(shape);
          for (const [at, value] of changes) bytes[at % bytes.length] = value;
          if (cut % 4 === 0) bytes = bytes.slice(0, cut % bytes.length);
          try {
            const { positions, triangles } = readPly(bytes);
            expect(positions.every(Number.isFinite)).toBe(true);
            expect(triangles.every((v) => v < positions.length / 3)).toBe(true);
            outcomes.read++;
          } catch (error) {
            expect(error).toBeInstanceOf(HandlebodyError);
            outcomes.refused++;
          }
        },
      ),
      { seed: SEED + 1, numRuns: 2000 },
    );
    expect(Math.min(outcomes.read, outcomes.refused)).toBeGreaterThan(100);
  });
});
