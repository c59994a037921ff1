/** Files of a wanted size: a wavy sheet of triangles, or of concave octagons, in each format. */

/** A sheet of n × n cells. @param {number} n */
function sheet(n) {
  const points = [];
  for (let j = 0; j <= n; j++) for (let i = 0; i <= n; i++) points.push([i / n, j / n, 0.1 * Math.sin(i / 9) * Math.cos(j / 7)]);
  const faces = [];
  for (let j = 0; j < n; j++) {
    for (let i = 0; i < n; i++) {
      const a = j * (n + 1) + i;
      faces.push([a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]);
    }
  }
  return { points, faces };
}

const U = [
  [0, 0],
  [3, 0],
  [3, 3],
  [2, 3],
  [2, 1],
  [1, 1],
  [1, 3],
  [0, 3],
];

/** n × n octagons that are no fans. @param {number} n */
function octagons(n) {
  const cells = Array.from({ length: n * n }, (_, k) => [k % n, Math.floor(k / n)]);
  return {
    points: cells.flatMap(([i = 0, j = 0]) => U.map(([x = 0, y = 0]) => [4 * i + x, 4 * j + y, 0])),
    faces: cells.map((_, k) => U.map((_corner, i) => 8 * k + i)),
  };
}

/** @typedef {ReturnType<typeof sheet>} Shape */

const row = (/** @type {number[]} */ numbers) => numbers.map((x) => x.toFixed(6)).join(' ');
const bytesOf = (/** @type {string[]} */ lines) => new TextEncoder().encode(`${lines.join('\n')}\n`);
const plyHead = (/** @type {Shape} */ { points, faces }, /** @type {string} */ format) => [
  'ply',
  `format ${format} 1.0`,
  `element vertex ${points.length}`,
  ...['x', 'y', 'z'].map((name) => `property float ${name}`),
  `element face ${faces.length}`,
  'property list uchar int vertex_indices',
  'end_header',
];

/** @param {Shape} shape */
const obj = ({ points, faces }) =>
  bytesOf([...points.map((p) => `v ${row(p)}`), ...faces.map((face) => `f ${face.map((v) => v + 1).join(' ')}`)]);

/** @param {Shape} shape */
function binaryPly(shape) {
  const head = bytesOf(plyHead(shape, 'binary_little_endian'));
  const bytes = new Uint8Array(head.length + 12 * shape.points.length + 13 * shape.faces.length);
  bytes.set(head);
  const view = new DataView(bytes.buffer, head.length);
  shape.points.flat().forEach((x, i) => {
    view.setFloat32(4 * i, x, true);
  });
  shape.faces.forEach((face, i) => {
    const start = 12 * shape.points.length + 13 * i;
    view.setUint8(start, 3);
    face.forEach((v, k) => {
      view.setInt32(start + 1 + 4 * k, v, true);
    });
  });
  return bytes;
}

/** @param {Shape} shape */
function binaryStl({ points, faces }) {
  const bytes = new Uint8Array(84 + 50 * faces.length);
  const view = new DataView(bytes.buffer);
  view.setUint32(80, faces.length, true);
  faces.forEach((face, t) => {
    face
      .flatMap((v) => points[v] ?? [])
      .forEach((x, i) => {
        view.setFloat32(84 + 50 * t + 12 + 4 * i, x, true);
      });
  });
  return bytes;
}

/** @type {Record<string, (n: number) => Uint8Array<ArrayBuffer>>} */
const WRITERS = {
  OBJ: (n) => obj(sheet(n)),
  'OBJ, concave faces': (n) => obj(octagons(n)),
  'PLY, text': (n) => {
    const shape = sheet(n);
    return bytesOf([...plyHead(shape, 'ascii'), ...shape.points.map(row), ...shape.faces.map((face) => `3 ${face.join(' ')}`)]);
  },
  'PLY, binary': (n) => binaryPly(sheet(n)),
  'STL, text': (n) => {
    const { points, faces } = sheet(n);
    const facet = (/** @type {number[]} */ face) => [
      'facet normal 0 0 1',
      'outer loop',
      ...face.map((v) => `vertex ${row(points[v] ?? [])}`),
      'endloop',
      'endfacet',
    ];
    return bytesOf(['solid made', ...faces.flatMap(facet), 'endsolid made']);
  },
  'STL, binary': (n) => binaryStl(sheet(n)),
  OFF: (n) => {
    const { points, faces } = sheet(n);
    return bytesOf([
      'OFF',
      `${points.length} ${faces.length} 0`,
      ...points.map(row),
      ...faces.map((face) => `3 ${face.join(' ')}`),
    ]);
  },
};

export const KINDS = Object.keys(WRITERS);

/** A file of about so many bytes: within 3%, from 100 kB on. @param {string} kind @param {number} size */
export function fileOf(kind, size) {
  const write = /** @type {(n: number) => Uint8Array<ArrayBuffer>} */ (WRITERS[kind]);
  // A file grows as the square of n, but for the length of numbers.
  let n = 20;
  for (let step = 0; step < 4; step++) n = Math.max(Math.round(n * Math.sqrt(size / write(n).length)), 2);
  return write(n);
}
