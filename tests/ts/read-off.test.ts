/** OFF: its counts, its letters, its comments, its colors, and what is refused. */
import { describe, expect, it } from 'vitest';
import { readOff } from '../../web/assets/index.ts';
import { bytesOf, off, SHAPES } from './support/made-files.mjs';
import { attempt } from './support/readers.ts';

const box = SHAPES.box as { points: number[][]; faces: number[][] };
const plain = off(box);
const read = (text: string) => readOff(bytesOf(text));
const TRIANGLE = '0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n';

describe('readOff', () => {
  it.each([
    ['counts on the first line', plain.replace('OFF\n', 'OFF ')],
    ['a count behind the keyword without a blank', plain.replace('OFF\n', 'OFF')],
    ['that in lower case', plain.replace('OFF\n', 'off')],
    ['no number of edges', plain.replace('8 6 0', '8 6')],
    ['counts on lines of their own', plain.replace('8 6 0', '8\n6\n0')],
    ['two counts on lines of their own', plain.replace('8 6 0', '8\n6')],
    ['lower case', plain.replace('OFF', 'off')],
    ['comments and blank lines', plain.replaceAll('\n', ' # 1 2 3\n\n#\n').replace('OFF', '# first\n\nOFF')],
    ['faces over several lines', plain.replaceAll(/^(4 \d) (\d) (\d \d)$/gm, '$1\n$2\n$3')],
  ])('reads %s', (_, text) => expect(read(text)).toEqual(read(plain)));

  it('keeps vertices in their order, used or not, and cuts polygons', () => {
    const { positions, triangles, warnings } = read(
      `OFF\n5 2 0\n9 9 9\n${TRIANGLE.replace('3 0 1 2', '1 1 0\n4 1 2 4 3\n3 1 2 3')}`,
    );
    expect([...positions]).toEqual([9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0]);
    expect([...triangles]).toEqual([1, 2, 4, 1, 4, 3, 1, 2, 3]);
    expect(warnings).toEqual([]);
  });

  it.each([
    ['COFF', '0 0 0 255 0 0 255\n1 0 0 1 1 1 1\n0 1 0 0 0 0 0\n'],
    ['NOFF', '0 0 0 0 0 2\n1 0 0 0 0 2\n0 1 0 0 0 2\n'],
    ['STOFF', '0 0 0 0 0\n1 0 0 1 0.25\n0 1 0 1 1\n'],
    ['CNOFF', '0 0 0 0 0 2 .5 .5 .5\n1 0 0 0 0 2 .5 .5 .5\n0 1 0 0 0 2 .5 .5 .5\n'],
    ['STCNOFF', '0 0 0 0 0 2 .5 .5 .5 1 0 0\n1 0 0 0 0 2 .5 .5 .5 1 1 0.25\n0 1 0 0 0 2 .5 .5 .5 1 1 1\n'],
    ['4OFF', '0 0 0 2\n2 0 0 2\n0 -3 0 -3\n'],
  ])('reads vertices of %s', (keyword, vertices) => {
    const { positions, normals, uvs, warnings } = read(`${keyword}\n3 1 3\n${vertices}3 0 1 2\n`);
    expect([...positions].map((x) => x + 0)).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0]);
    expect(normals && [...normals]).toEqual(keyword.includes('N') ? [0, 0, 1, 0, 0, 1, 0, 0, 1] : undefined);
    expect(uvs && [...uvs]).toEqual(keyword.includes('ST') ? [0, 1, 1, 0.75, 1, 0] : undefined);
    expect(warnings.map(({ code }) => code)).toEqual(keyword.includes('C') ? ['attributes-left-out'] : []);
  });

  it('leaves out colors behind faces, and says of how many', () => {
    const { triangles, warnings } = read(`OFF 3 2 0\n${TRIANGLE.replace('3 0 1 2', '3 0 1 2 255 0 0\n3 2 1 0 7')}`);
    expect(triangles).toHaveLength(6);
    expect(warnings).toMatchObject([
      { code: 'attributes-left-out', count: 2 },
      { code: 'triangles-doubled', count: 1 },
    ]);
  });

  it.each([
    ['OFF BINARY\n\0\0\0', 'file-unsupported', /binary OFF/],
    ['nOFF 3\n3 1 0\n', 'file-unsupported', /nOFF/],
    ['4nOFF 3\n3 1 0\n', 'file-unsupported', /4nOFF/],
    ['OOFF\n3 1 0\n', 'file-invalid', /"OOFF"/],
    ['OFF\n3 -1 0\n', 'file-invalid', /numbers of vertices and faces/],
    ['OFF\n3.5 1 0\n', 'file-invalid', /numbers of vertices and faces/],
    ['OFF\n', 'file-truncated', /its counts/],
    [`OFF\n4 1 0\n${TRIANGLE}`, 'file-truncated', /face 0/],
    [`OFF\n3 2 0\n${TRIANGLE}`, 'file-truncated', /face 1/],
    [`OFF\n3 1 0\n0 0 0\n1 0 0\n`, 'file-truncated', /vertex 2/],
    [`OFF\n3 1 0\n${TRIANGLE.replace('3 0 1 2', '9 0 1 2')}`, 'file-truncated', /face 0/],
    [`OFF\n3 1 0\n${TRIANGLE.replace('3 0 1 2', '3 0 1 3')}`, 'file-invalid', /Line 6 .*"3" of 3/],
    [`OFF\n3 1 0\n${TRIANGLE.replace('3 0 1 2', 'x 0 1 2')}`, 'file-invalid', /Line 6 .*"x"/],
    [`OFF\n99999999 1 0\n${TRIANGLE}`, 'mesh-too-large', /99999999/],
    ['OFF\n0 0 0\n', 'file-invalid', /no vertices/],
    ['4OFF\n3 1 0\n0 0 0 0\n1 0 0 1\n0 1 0 1\n3 0 1 2\n', 'file-invalid', /Line 3/],
  ])('refuses %j', (text, code, message) => expect(attempt(() => read(text))).toMatchObject({ code, message, remedy: /./ }));
});
