/** Hostile OBJ, PLY, OFF and STL. */
import { list, repeat, text } from './make.mjs';

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

/** @type {Record<string, import('./make.mjs').Kind>} */
export const TEXTS = {
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
  'obj: groups': {
    reader: 'readObj',
    make: (n) => text(TRIANGLE_OBJ + list(n / 32, (i) => `g g${i}\nusemtl m${i}\nf 1 2 3\n`).join('')),
  },
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
  'ply: a list of more numbers than there are bytes': {
    reader: 'readPly',
    make: (n) =>
      Buffer.concat([
        text(
          PLY('binary_little_endian', `element vertex 3\n${XYZ}element face 1\nproperty list uint uchar vertex_indices\n`) +
            'abcdefghi',
        ),
        new Uint8Array(n).fill(255),
      ]),
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
};
