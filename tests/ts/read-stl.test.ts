/** STL, text and binary: which it is, solids, corners at one place, and what is refused. */
import { describe, expect, it } from 'vitest';
import { readStl } from '../../web/assets/index.ts';
import { binaryStl, bytesOf, moved, prism, SHAPES, stl } from './support/made-files.mjs';
import { attempt } from './support/readers.ts';
import { measure, openEdges } from './support/surfaces.ts';

const box = SHAPES.box as { points: number[][]; faces: number[][] };
const tetrahedron = SHAPES.tetrahedron as typeof box;
const read = (text: string) => readStl(bytesOf(text));
const FACET = 'facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n';

describe('readStl', () => {
  it.each([
    ['text', bytesOf(stl(box))],
    ['binary', binaryStl(box)],
  ])('joins the corners of triangles at one place, in their order: %s', (_, bytes) => {
    const { positions, triangles, normals, uvs } = readStl(bytes);
    expect(positions).toHaveLength(24);
    expect([...triangles.slice(0, 6)]).toEqual([0, 1, 2, 0, 2, 3]);
    expect([...positions.slice(0, 6)]).toEqual([...(box.points[3] ?? []), ...(box.points[2] ?? [])]);
    expect(openEdges(triangles)).toBe(0);
    expect([normals, uvs]).toEqual([undefined, undefined]);
  });

  it('takes −0 for 0, and numbers that are one float for one place; no others', () => {
    const facets = (x: string, y: string) => `solid a\n${FACET}${FACET.replace('vertex 0 0 0', `vertex ${x} ${y} 0`)}endsolid a\n`;
    expect(read(facets('-0', '-0.0')).positions).toHaveLength(9);
    expect(read(facets('0', '1e-46')).positions).toHaveLength(9);
    expect(read(facets('0', '1e-45')).positions).toHaveLength(12);
    expect(read(facets('0.0000001', '0')).positions).toHaveLength(12);
  });

  it('makes one mesh of several solids', () => {
    const text = `${stl(box)}\n${stl(moved(tetrahedron, [5, 0, 0]))}${stl(moved(tetrahedron, [9, 0, 0]))}`;
    expect(measure(read(text))).toMatchObject({ low: [0, 0, 0], high: [10, 1, 1], triangles: 20 });
    expect(read(text).positions).toHaveLength(3 * 16);
  });

  it.each([
    'solid a part',
    'solid',
    'SOLID X',
    'solid x\nfacet normal 0 0 1\n',
    'facet',
    'OFF',
    'v 0 0 0',
    '{"asset":{}}',
    '<html>',
  ])('reads a binary file that begins with %j', (header) =>
    expect(readStl(binaryStl(box, header))).toEqual(readStl(binaryStl(box))),
  );

  it.each([
    ['blank lines', `\n\n   ${stl(box)}`],
    ['upper case', stl(box).toUpperCase()],
    ['no name', stl(box).replaceAll(' made', '')],
    ['a name of words of the format', stl(box).replaceAll(' made', ' vertex 1 2 3 endsolid loop')],
    ['normals that are no numbers', stl(box).replaceAll('normal 0 0 0', 'normal -nan(ind) nan 1.#QNAN')],
    ['all on one line', stl(box).replaceAll('\n', ' ')],
    ['a color of its header', stl(box).replace('solid made', `solid made COLOR=${'x'.repeat(2000)}`)],
  ])('reads a text with %s', (_, text) => expect(read(text)).toEqual(read(stl(box))));

  it('reads a text without solids, and facets of more corners, cut as polygons are', () => {
    expect(read(FACET)).toMatchObject({ warnings: [{ code: 'keyword-missing', count: 1 }] });
    const [points] = [
      prism([
        [0, 0],
        [3, 0],
        [3, 1],
        [1, 1],
        [1, 2],
        [0, 2],
      ]).points.slice(0, 6),
    ];
    const loop = `solid a\nfacet normal 0 0 1\nouter loop\n${points.map((p) => `vertex ${p.join(' ')}`).join('\n')}\nendloop\nendfacet\nendsolid a`;
    expect(measure(read(loop))).toMatchObject({ triangles: 4, area: 4 });
  });

  it('names triangles without area: kept, as the file has them', () => {
    const { triangles, warnings } = read(`solid a\n${FACET}${FACET.replace('vertex 0 1 0', 'vertex 1 0 0')}endsolid`);
    expect([...triangles]).toEqual([0, 1, 2, 0, 1, 1]);
    expect(warnings).toMatchObject([{ code: 'triangles-flat', count: 1 }]);
  });

  const binary = binaryStl(box);
  const count = (n: number) => {
    const bytes = binary.slice();
    new DataView(bytes.buffer).setUint32(80, n, true);
    return bytes;
  };
  it.each([
    ['a binary file that was cut off', binary.slice(0, -1), 'file-truncated', 683],
    ['one cut within its header', binary.slice(0, 50), 'file-truncated', 50],
    ['one that announces too many triangles', count(13), 'file-truncated', 684],
    ['one that announces four billion', count(0xffff_ffff), 'file-truncated', 684],
    ['one that announces none', count(0), 'file-invalid', 84],
    ['a text that ends within a facet', bytesOf(stl(box).slice(0, -40)), 'file-truncated', stl(box).length - 40],
    ['a text without its last line', bytesOf(`solid a\n${FACET}`), 'file-truncated', 8 + FACET.length],
    ['a text without facets', bytesOf('solid a\nendsolid a\n'), 'file-invalid', undefined],
    ['two numbers for a place', bytesOf(`solid a\n${FACET.replace('1 0 0', '1 0')}endsolid`), 'file-invalid', 51],
  ])('refuses %s', (_, bytes, code, byte) => {
    const error = attempt(() => readStl(bytes));
    expect(error).toMatchObject({ code, remedy: /./ });
    expect('culprit' in error ? error.culprit?.index : undefined).toBe(byte);
  });

  it('names the byte of a place that is no number', () => {
    const bytes = binary.slice();
    new DataView(bytes.buffer).setFloat32(84 + 50 * 3 + 12 + 12 + 4, Number.NaN, true);
    expect(attempt(() => readStl(bytes))).toMatchObject({
      code: 'file-invalid',
      message: /triangle 3/,
      culprit: { kind: 'byte', index: 84 + 50 * 3 + 24 },
    });
  });

  it('reads what a file announces, and counts what is behind it', () => {
    expect(readStl(count(10))).toMatchObject({ triangles: { length: 30 }, warnings: [{ code: 'data-left-over', count: 100 }] });
  });
});
