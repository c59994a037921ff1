/**
 * Small model files, sound ones and broken ones, in every format that holds a mesh and nothing else: what `readers-oracle.test.ts` reads, and
 * `node made-files.mjs FOLDER` writes for trimesh to read.
 */
import { mkdirSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

/** @typedef {{ points: number[][], faces: number[][] }} Shape Faces from 0, counter-clockwise. */

/** A prism over an outline of the plane, walls and two caps. @param {number[][]} outline @param {number} [height] @returns {Shape} */
export function prism(outline, height = 1) {
  const n = outline.length;
  const points = [0, height].flatMap((z) => outline.map(([x = 0, y = 0]) => [x, y, z]));
  const walls = outline.map((_, i) => [i, (i + 1) % n, n + ((i + 1) % n), n + i]);
  const lower = outline.map((_, i) => n - 1 - i);
  return { points, faces: [lower, outline.map((_, i) => n + i), ...walls] };
}

const square = [
  [0, 0],
  [2, 0],
  [2, 1],
  [0, 1],
];
const hexagon = Array.from({ length: 6 }, (_, i) => [Math.cos((i * Math.PI) / 3), Math.sin((i * Math.PI) / 3)]);
const ell = [
  [0, 0],
  [3, 0],
  [3, 1],
  [1, 1],
  [1, 2],
  [0, 2],
];
const u = [
  [0, 0],
  [3, 0],
  [3, 3],
  [2, 3],
  [2, 1],
  [1, 1],
  [1, 3],
  [0, 3],
];
const stairs = [
  [0, 0],
  [3, 0],
  [3, 1],
  [2, 1],
  [2, 2],
  [1, 2],
  [1, 3],
  [0, 3],
];
const lined = [
  [0, 0],
  [1, 0],
  [2, 0],
  [2, 1],
  [1, 1],
  [0, 1],
];
const star = Array.from({ length: 10 }, (_, i) => {
  const radius = i % 2 === 0 ? 2 : 0.75;
  return [radius * Math.cos((i * Math.PI) / 5), radius * Math.sin((i * Math.PI) / 5)];
});

/** @type {Record<string, Shape>} */
export const SHAPES = {
  tetrahedron: {
    points: [
      [0, 0, 0],
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ],
    faces: [
      [0, 2, 1],
      [0, 1, 3],
      [0, 3, 2],
      [1, 2, 3],
    ],
  },
  box: prism(square),
  hexagon: prism(hexagon, 2),
  ell: prism(ell),
  u: prism(u),
  stairs: prism(stairs, 0.5),
  lined: prism(lined),
  star: prism(star, 0.25),
  sheet: {
    points: [
      [0, 0, 0],
      [1, 0, 0],
      [1, 1, 0],
      [0, 1, 0],
    ],
    faces: [
      [0, 1, 2],
      [0, 2, 3],
    ],
  },
};

const encoder = new TextEncoder();
/** @param {string} text */
export const bytesOf = (text) => encoder.encode(text);

/** @param {number[][]} faces Fans: for formats of triangles, of shapes whose faces are convex. */
const fans = (faces) => faces.flatMap((face) => face.slice(2).map((corner, i) => [face[0] ?? 0, face[i + 1] ?? 0, corner]));

/** @param {Shape} shape */
export const obj = ({ points, faces }) =>
  `${[...points.map((p) => `v ${p.join(' ')}`), ...faces.map((face) => `f ${face.map((v) => v + 1).join(' ')}`)].join('\n')}\n`;

/** @param {Shape} shape @param {string} [keyword] */
export const off = ({ points, faces }, keyword = 'OFF') =>
  `${[keyword, `${points.length} ${faces.length} 0`, ...points.map((p) => p.join(' ')), ...faces.map((face) => [face.length, ...face].join(' '))].join('\n')}\n`;

/** @param {Shape} shape */
export const stl = ({ points, faces }) =>
  `${[
    'solid made',
    ...fans(faces).flatMap((face) => [
      'facet normal 0 0 0',
      'outer loop',
      ...face.map((v) => `vertex ${points[v]?.join(' ')}`),
      'endloop',
      'endfacet',
    ]),
    'endsolid made',
  ].join('\n')}\n`;

/** @param {Shape} shape @param {string} [header] */
export function binaryStl({ points, faces }, header = 'made') {
  const triangles = fans(faces);
  const bytes = new Uint8Array(84 + 50 * triangles.length);
  bytes.set(bytesOf(header).subarray(0, 80));
  const view = new DataView(bytes.buffer);
  view.setUint32(80, triangles.length, true);
  triangles.forEach((face, t) => {
    face.forEach((v, corner) => {
      points[v]?.forEach((x, axis) => {
        view.setFloat32(84 + 50 * t + 12 + 12 * corner + 4 * axis, x, true);
      });
    });
  });
  return bytes;
}

/** @param {Shape} shape @param {string} [type] */
export const plyHeader = ({ points, faces }, format = 'ascii', type = 'float') =>
  [
    'ply',
    `format ${format} 1.0`,
    `element vertex ${points.length}`,
    ...['x', 'y', 'z'].map((name) => `property ${type} ${name}`),
    `element face ${faces.length}`,
    'property list uchar int vertex_indices',
    'end_header\n',
  ].join('\n');

/** @param {Shape} shape */
export const ply = (shape) =>
  `${plyHeader(shape)}${[...shape.points.map((p) => p.join(' ')), ...shape.faces.map((face) => [face.length, ...face].join(' '))].join('\n')}\n`;

/** @param {Shape} shape @param {boolean} little @param {'float' | 'double'} [type] */
export function binaryPly(shape, little, type = 'float') {
  const head = bytesOf(plyHeader(shape, little ? 'binary_little_endian' : 'binary_big_endian', type));
  const size = type === 'float' ? 4 : 8;
  const corners = shape.faces.reduce((sum, face) => sum + 1 + 4 * face.length, 0);
  const bytes = new Uint8Array(head.length + 3 * size * shape.points.length + corners);
  bytes.set(head);
  const view = new DataView(bytes.buffer, head.length);
  let at = 0;
  for (const x of shape.points.flat()) {
    if (type === 'float') view.setFloat32(at, x, little);
    else view.setFloat64(at, x, little);
    at += size;
  }
  for (const face of shape.faces) {
    view.setUint8(at, face.length);
    at += 1;
    for (const v of face) {
      view.setInt32(at, v, little);
      at += 4;
    }
  }
  return bytes;
}

/** Text as UTF-16. @param {string} text @param {boolean} little @param {boolean} mark */
export function utf16(text, little, mark) {
  const marked = mark ? `\ufeff${text}` : text;
  const bytes = new Uint8Array(2 * marked.length);
  const view = new DataView(bytes.buffer);
  for (let i = 0; i < marked.length; i++) view.setUint16(2 * i, marked.charCodeAt(i), little);
  return bytes;
}

const TEXTS = { obj, ply, stl, off };
const CONVEX = ['tetrahedron', 'box', 'hexagon', 'lined', 'sheet'];
/** @param {Shape} shape @param {number[]} by @returns {Shape} */
export const moved = ({ points, faces }, by) => ({ points: points.map((p) => p.map((x, axis) => x + (by[axis] ?? 0))), faces });

/** Every file by its name. @returns {Map<string, Uint8Array>} */
export function madeFiles() {
  const files = new Map();
  const put = (/** @type {string} */ name, /** @type {string | Uint8Array} */ content) => {
    if (files.has(name)) throw new Error(`${name} is made twice`);
    files.set(name, typeof content === 'string' ? bytesOf(content) : content);
  };
  for (const [name, shape] of Object.entries(SHAPES)) {
    put(`${name}.obj`, obj(shape));
    put(`${name}-text.ply`, ply(shape));
    put(`${name}-little.ply`, binaryPly(shape, true));
    put(`${name}-big.ply`, binaryPly(shape, false, 'double'));
    put(`${name}.off`, off(shape));
    if (!CONVEX.includes(name)) continue;
    put(`${name}-text.stl`, stl(shape));
    put(`${name}-binary.stl`, binaryStl(shape));
  }
  const { box, tetrahedron } = SHAPES;
  if (!box || !tetrahedron) throw new Error('shapes are missing');
  for (const [ending, write] of Object.entries(TEXTS)) {
    const text = write(box);
    const lines = text.split('\n');
    put(`mark.${ending}`, `\ufeff${text}`);
    put(`utf16-little.${ending}`, utf16(text, true, true));
    put(`utf16-big.${ending}`, utf16(text, false, true));
    put(`utf16-no-mark.${ending}`, utf16(text, true, false));
    put(`crlf.${ending}`, text.replaceAll('\n', '\r\n'));
    put(`cr.${ending}`, text.replaceAll('\n', '\r'));
    put(`tabs.${ending}`, ending === 'ply' ? text : text.replaceAll(' ', '\t'));
    put(`no-last-line-end.${ending}`, text.trimEnd());
    put(`ctrl-z.${ending}`, `${text}\x1a`);
    put(`zeros.${ending}`, `${text}\0\0\0`);
    put(`far.${ending}`, write(moved(box, [5e5, 4e6, 100])));
    put(`cut-off.${ending}`, lines.slice(0, -4).join('\n').slice(0, -2));
    put(`half.${ending}`, text.slice(0, text.length / 2));
    put(`nan-used.${ending}`, text.replace('2 0 0', '2 nan 0'));
    put(`infinite-used.${ending}`, text.replace('2 0 0', 'inf 0 0'));
    put(`hexadecimal.${ending}`, text.replace('2 0 0', '0x2 0 0'));
    put(`huge.${ending}`, text.replaceAll('2 ', '1e400 '));
    put(`empty.${ending}`, '');
    put(`web-page.${ending}`, '<!DOCTYPE html>\n<html><body>404</body></html>\n');
  }
  const o = obj(box);
  put('index-zero.obj', o.replace('f 4', 'f 0'));
  put('index-beyond.obj', o.replace('f 4', 'f 99'));
  put(
    'index-negative.obj',
    `${obj({ ...box, faces: [] })}${box.faces.map((f) => `f ${f.map((v) => v - 8).join(' ')}`).join('\n')}`,
  );
  put('normal-nan.obj', `vn nan 0 0\n${o}`);
  put('two-corners.obj', `${o}f 1 2\n`);
  put('one-corner.obj', `${o}f 1\n`);
  put('unknown.obj', `hello world\n${o}`);
  put('continued.obj', o.replace('f 4 3', 'f 4 \\\n3'));
  put('colors.obj', o.replaceAll(/^v (.*)$/gm, 'v $1 0.5 0.5 0.5'));
  put('fourth.obj', o.replaceAll(/^v (.*)$/gm, 'v $1 1'));
  put('unused-nan.obj', `${o}v nan nan nan\n`);
  put('unused-far.obj', `${o}v 1e6 0 0\n`);
  put('flat.obj', `${o}f 1 2 2\n`);
  put('doubled.obj', `${o}f 1 2 6 5\n`);
  put('no-faces.obj', obj({ ...box, faces: [] }));
  put('lines-only.obj', `${obj({ ...box, faces: [] })}l 1 2\n`);
  put(
    'uvs.obj',
    `vt 0 0\nvt 1 0\nvt 1 1\n${obj({ ...tetrahedron, faces: [] })}f 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 1/1 4/2 3/3\nf 2/1 3/2 4/3\n`,
  );
  put('uvs-missing.obj', `${obj({ ...tetrahedron, faces: [] })}f 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 1/1 4/2 3/3\nf 2/1 3/2 4/3\n`);
  put('groups.obj', `mtllib a.mtl\no thing\ng a b\nusemtl red\ns 1\n${o}`);
  const p = ply(box);
  put('header-word.ply', p.replace('element vertex', 'made by hand\nelement vertex'));
  put('comment.ply', p.replace('element vertex', 'comment a b\nobj_info c\nelement vertex'));
  put('left-over-text.ply', `${p}1 2 3\nhello\n`);
  put('left-over-binary.ply', Uint8Array.from([...binaryPly(box, true), 1, 2, 3]));
  put('cut-off-binary.ply', binaryPly(box, true).slice(0, -7));
  put('index-beyond.ply', p.replace('4 3 2 1 0', '4 3 2 1 80'));
  put('index-below.ply', p.replace('4 3 2 1 0', '4 3 2 1 -1'));
  put('two-corners.ply', p.replace('element face 6', 'element face 7').concat('2 0 1\n'));
  put('no-faces.ply', ply({ ...box, faces: [] }));
  put('too-many.ply', p.replace('element vertex 8', 'element vertex 80'));
  put('version.ply', p.replace('1.0', '2.0'));
  const b = binaryStl(box);
  put('begins-with-solid.stl', binaryStl(box, 'solid made by a tool'));
  put('begins-with-facet.stl', binaryStl(box, 'solid x\nfacet normal 0 0 1\n'));
  put('begins-with-blank.stl', `\n\n  ${stl(box)}`);
  put('upper-case.stl', stl(box).toUpperCase());
  put('two-solids.stl', `${stl(box)}${stl(moved(tetrahedron, [5, 0, 0]))}`);
  put('normal-nan.stl', stl(box).replaceAll('normal 0 0 0', 'normal nan nan nan'));
  put('no-solid.stl', stl(box).replaceAll(/(end)?solid.*\n/g, ''));
  put('no-endsolid.stl', stl(box).replace(/endsolid.*\n/, ''));
  put('left-over.stl', Uint8Array.from([...b, 0, 0, 0]));
  put('cut-off-binary.stl', b.slice(0, -9));
  put('no-triangles.stl', b.slice(0, 84).fill(0, 80));
  put(
    'colors.stl',
    b.map((byte, i) => (i >= 84 && (i - 84) % 50 >= 48 ? 0x7f : byte)),
  );
  put('nothing.stl', 'solid nothing\nendsolid nothing\n');
  const f = off(box);
  put('one-line.off', f.replace('OFF\n', 'OFF '));
  put('no-keyword.off', f.replace('OFF\n', ''));
  put('comments.off', f.replace('OFF\n', 'OFF # here\n# and here\n\n'));
  put('face-colors.off', f.replaceAll(/^(4 .*)$/gm, '$1 255 0 0'));
  put('vertex-colors.off', off({ ...box, points: box.points.map((each) => [...each, 255, 0, 0, 255]) }, 'COFF'));
  put('two-corners.off', f.replace('8 6 0', '8 7 0').concat('2 0 1\n'));
  put('index-beyond.off', f.replace('4 3 2 1 0', '4 3 2 1 80'));
  put('too-many.off', f.replace('8 6 0', '8 60 0'));
  put('left-over.off', `${f}hello\n`);
  put('binary.off', f.replace('OFF\n', 'OFF BINARY\n'));
  put('any.off', off(box, 'nOFF'));
  put('four.off', off({ ...box, points: box.points.map((each) => [...each, 1]) }, '4OFF'));
  return files;
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  const folder = process.argv[2] ?? '.';
  mkdirSync(folder, { recursive: true });
  for (const [name, bytes] of madeFiles()) writeFileSync(path.join(folder, name), bytes);
}
