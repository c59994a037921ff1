/** OBJ reading: what is read and in which order; and that no bytes whatsoever do worse than a HandlebodyError. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { readObj } from '../../web/assets/index.ts';
import { outlines, outlinesOf } from './support/outlines.ts';

const SEED = 20260704;

const bytesOf = (text: string) => new TextEncoder().encode(text);
const read = (...lines: string[]) => readObj(bytesOf(lines.join('\n')));

function errorOf(work: () => unknown): HandlebodyError {
  try {
    work();
  } catch (error) {
    if (error instanceof HandlebodyError) return error;
    throw error;
  }
  throw new Error('nothing was thrown');
}

const SQUARE = ['v 0 0 0', 'v 1 0 0', 'v 1 1 0', 'v 0 1 0'];

describe('readObj', () => {
  it('keeps every v line as a vertex, in its order, used or not', () => {
    const { positions, triangles } = read('v 9 9 9', ...SQUARE, 'f 2 3 4');
    expect([...positions]).toEqual([9, 9, 9, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0]);
    expect([...triangles]).toEqual([1, 2, 3]);
  });

  it('cuts convex polygons into fans', () => {
    expect([...read(...SQUARE, 'v -0.5 0.5 0', 'f 1 2 3 4 5').triangles]).toEqual([0, 1, 2, 0, 2, 3, 0, 3, 4]);
  });

  it('counts negative numbers back from where they stand', () => {
    expect([...read(...SQUARE, 'f -4 -3 -2', 'v 5 5 5', 'f -1 -2 -3').triangles]).toEqual([0, 1, 2, 4, 3, 2]);
  });

  it('takes faces before their vertices, groups, materials, comments, continued lines, tabs and any line ends', () => {
    const text = `\ufeff# a comment\r\nmtllib no such file.mtl\r\nf 1 \\\r\n  2 3 # here too\r\no thing\rusemtl\twood\r\ng a b\r\ns off\nv\t0 0 0 \nv 1 0 0 1 0.5 0.5 0.5\n\nv 0 1e0 -.5`;
    const { positions, triangles, warnings } = readObj(bytesOf(text));
    expect([...positions]).toEqual([0, 0, 0, 1, 0, 0, 0, 1, -0.5]);
    expect([...triangles]).toEqual([0, 1, 2]);
    // The numbers behind the second vertex.
    expect(warnings).toMatchObject([{ code: 'attributes-left-out', count: 1 }]);
  });

  it('keeps normals and texture coordinates that are one a vertex, in the directions of glTF', () => {
    const { normals, uvs } = read(...SQUARE.slice(0, 3), 'vn 0 0 2', 'vt 0 0', 'vt 1 0.25', 'f 1/1/1 2/2/1 3/1/1');
    expect([...(normals ?? [])]).toEqual([0, 0, 1, 0, 0, 1, 0, 0, 1]);
    expect([...(uvs ?? [])]).toEqual([0, 1, 1, 0.75, 0, 1]);
  });

  it('leaves out, with a warning, what differs between the faces of a vertex; the same numbers twice are one', () => {
    const seam = read(...SQUARE, 'vt 0 0', 'vt 1 1', 'vn 0 0 1', 'vn 0 0 1', 'f 1/1/1 2/1/1 3/1/1', 'f 1/2/2 3/2/2 4/2/2');
    expect(seam.uvs).toBeUndefined();
    expect(seam.warnings).toMatchObject([{ code: 'uvs-split', count: 2 }]);
    expect([...(seam.normals ?? [])].filter((_, i) => i % 3 === 2)).toEqual([1, 1, 1, 1]);
    const crease = read(...SQUARE, 'vn 0 0 1', 'vn 0 1 0', 'f 1//1 2//1 3//1', 'f 1//2 3//2 4//2');
    expect(crease.normals).toBeUndefined();
    expect(crease.warnings).toMatchObject([{ code: 'normals-split', count: 2, message: expect.stringContaining('smooth') }]);
  });

  it('leaves out what corners name and is not there, the next one too', () => {
    for (const beyond of [2, 3, 1000]) {
      const { normals, uvs, warnings } = read(...SQUARE, 'vn 0 0 1', 'vt 0 0', `f 1/1/1 2/1/${beyond} 3/${beyond}/1`);
      expect([normals, uvs]).toEqual([undefined, undefined]);
      expect(warnings).toMatchObject([
        { code: 'uvs-bad', count: 1 },
        { code: 'normals-bad', count: 1 },
      ]);
    }
  });

  it('leaves out lines and points, and says so', () => {
    const { triangles, warnings } = read(...SQUARE, 'l 1 2', 'p 1', 'p 2');
    expect(triangles).toHaveLength(0);
    expect(warnings).toMatchObject([{ code: 'shapes-left-out', count: 3 }]);
  });

  it('reads a file of many blocks, with the numbers of its lines', () => {
    const vertices = Array.from({ length: 200_000 }, (_, i) => `v ${i} ${i * 0.5} ${-i}`);
    const readWith = (face: string) => readObj(bytesOf([...vertices, face].join('\n')));
    const mesh = readWith('f 1 100000 200000');
    expect(mesh.positions).toHaveLength(600_000);
    expect(mesh.positions[3 * 123_456]).toBe(123_456);
    expect(errorOf(() => readWith('f 1 2 x')).message).toContain('Line 200001');
  });

  it('refuses statements that would take far more memory than the file', () => {
    for (const lines of [
      [`f ${'1 '.repeat(600_000)}`],
      Array<string>(60_000).fill('1 1 1 1 1 1 1 1 1 1 \\'),
      ['x'.repeat(17 << 20)],
    ])
      expect(errorOf(() => readObj(bytesOf(lines.join('\n')))).message).toMatch(/more than 1(6)? MiB/);
  });

  it.each([
    [['v 0 0'], 1, '2 numbers'],
    [['# fine', 'v 0 0 nan'], 2, '"nan"'],
    [['v 0 0 1e39'], 1, '"1e39"'],
    [['v 0 0 0x10'], 1, '"0x10"'],
    [[...SQUARE, 'f 1 2'], 5, '2 corners'],
    [[...SQUARE, 'f 1 2 0'], 5, '"0"'],
    [[...SQUARE, 'f 1 2 -5'], 5, '"-5"'],
    [[...SQUARE, 'f 1 2 3.5'], 5, '"3.5"'],
    [[...SQUARE, 'f 1 2 7', 'f 1 2 3'], 5, 'v 7, and the file has 4'],
    [[...SQUARE, 'f 1/1/1/1 2 3'], 5, 'corner'],
    [[...SQUARE, '', 'f 1 2 \\', '3 \\', 'x'], 6, '"x"'],
    [['<!DOCTYPE html>'], 1, 'no OBJ statement'],
    [['\u0000\u0001\u001b[31m'], 1, 'no OBJ statement'],
  ])('refuses %j, naming line %i', (lines, line, what) => {
    const error = errorOf(() => read(...lines));
    expect(error.code).toBe('file-invalid');
    expect(error.message).toContain(`Line ${line} `);
    expect(error.message).toContain(what);
    // What a terminal would obey is not passed on.
    expect([...error.message].every((letter) => letter >= ' ')).toBe(true);
    const start = lines.slice(0, line - 1).reduce((sum, text) => sum + bytesOf(text).length + 1, 0);
    expect(error.culprit).toEqual({ kind: 'byte', index: start });
    expect(error.remedy).not.toBe('');
  });

  const mesh = fc
    .array(fc.tuple(...Array.from({ length: 3 }, () => fc.float({ noNaN: true, noDefaultInfinity: true }))), {
      minLength: 1,
      maxLength: 30,
    })
    .chain((vertices) =>
      fc.record({
        vertices: fc.constant(vertices),
        faces: fc.array(fc.array(fc.nat(vertices.length - 1), { minLength: 3, maxLength: 6 }), { maxLength: 20 }),
        end: fc.constantFrom('\n', '\r\n', '\r'),
        relative: fc.boolean(),
      }),
    );
  type Made = typeof mesh extends fc.Arbitrary<infer T> ? T : never;
  const write = ({ vertices, faces, end, relative }: Made) =>
    [
      ...vertices.map((v) => `v ${v.join(' ')}`),
      ...faces.map((face) => `f ${face.map((v) => (relative ? v - vertices.length : v + 1)).join(' ')}`),
    ].join(end);

  it(`gives back what was written (seed ${SEED})`, () => {
    fc.assert(
      fc.property(mesh, (made) => {
        const { positions, triangles } = readObj(bytesOf(write(made)));
        // Not toEqual: "0" is what JavaScript writes for −0.
        expect([...positions].map((x) => x + 0)).toEqual(made.vertices.flat().map((x) => x + 0));
        expect(outlines(triangles)).toEqual(outlinesOf(made.faces));
      }),
      { seed: SEED, numRuns: 300 },
    );
  });

  it(`survives damage of any kind with a mesh or a HandlebodyError (seed ${SEED + 1})`, () => {
    const outcomes = { read: 0, refused: 0 };
    // Mostly letters that the format knows: other ones are found out at once.
    const code = fc.oneof(
      { weight: 20, arbitrary: fc.constantFrom(...bytesOf('0123456789 .-e/\\#fv\n')) },
      { weight: 1, arbitrary: fc.nat(255) },
    );
    const damages = fc.array(fc.tuple(fc.nat(), code), { minLength: 1, maxLength: 4 });
    fc.assert(
      fc.property(mesh, damages, fc.nat(), (made, changes, cut) => {
        let bytes = bytesOf(write(made));
        for (const [at, value] of changes) bytes[at % bytes.length] = value;
        if (cut % 3 === 0) bytes = bytes.slice(0, cut % bytes.length);
        try {
          const { positions, triangles } = readObj(bytes);
          expect(positions.every(Number.isFinite)).toBe(true);
          expect(triangles.every((v) => v < positions.length / 3)).toBe(true);
          outcomes.read++;
        } catch (error) {
          expect(error).toBeInstanceOf(HandlebodyError);
          outcomes.refused++;
        }
      }),
      { seed: SEED + 1, numRuns: 2000 },
    );
    expect(Math.min(outcomes.read, outcomes.refused)).toBeGreaterThan(100);
  });
});
