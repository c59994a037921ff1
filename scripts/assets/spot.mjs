/** Spot the cow: a binary PLY of geometry-central's tests, inside potpourri3d's source package. */
import { between, mixColor } from './face/color.mjs';
import { PACKAGES, readFromPackage } from './fetch.mjs';
import { coarse, smoothNormals, standOnGround } from './mesh.mjs';

const PLY = 'potpourri3d-1.4.0/deps/geometry-central/test/assets/spot.ply';

/**
 * Reads a little-endian PLY of float x, y, z vertices and uchar/int index lists of triangles, which is all Spot needs.
 * @param {Uint8Array} bytes
 * @returns {{ positions: Float32Array, triangles: Uint32Array }}
 */
function parsePly(bytes) {
  const end = 'end_header\n';
  const text = Buffer.from(bytes.buffer, bytes.byteOffset, Math.min(bytes.byteLength, 4096)).toString('latin1');
  const header = text.slice(0, text.indexOf(end)).replaceAll('\r', '');
  const properties = header.match(/^property .*$/gm)?.join('; ');
  if (
    !header.includes('binary_little_endian') ||
    properties !== 'property float x; property float y; property float z; property list uchar int vertex_indices'
  )
    throw new Error(`Not the PLY that was expected: ${properties ?? 'no header'}.`);
  const vertices = Number(/element vertex (\d+)/.exec(header)?.[1]);
  const faces = Number(/element face (\d+)/.exec(header)?.[1]);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const start = text.indexOf(end) + end.length;
  const positions = Float32Array.from({ length: 3 * vertices }, (_, i) => view.getFloat32(start + 4 * i, true));
  const triangles = new Uint32Array(3 * faces);
  for (let f = 0; f < faces; ++f) {
    const at = start + 12 * vertices + 13 * f;
    if (view.getUint8(at) !== 3) throw new Error(`Face ${f} is not a triangle.`);
    for (let c = 0; c < 3; ++c) triangles[3 * f + c] = view.getInt32(at + 1 + 4 * c, true);
  }
  return { positions, triangles };
}

/** Dark patches: center and radius. @type {[number, number, number, number][]} */
const PATCHES = [
  [0.02, 0.62, 0.2, 0.17],
  [-0.3, 0.5, -0.2, 0.19],
  [-0.42, 0.62, 0.12, 0.14],
  [0.12, 0.42, -0.25, 0.13],
  [0.28, 0.9, 0.17, 0.15],
];

/** Marks on either side: center, radius and softness, and their color. @type {[[number, number, number, number, number], [number, number, number]][]} */
const MARKS = [
  [
    [0.5, 0.66, 0, 0.13, 0.05],
    [0.72, 0.4, 0.36],
  ],
  [
    [0.4, 0.83, 0.15, 0.036, 0.012],
    [0.012, 0.01, 0.01],
  ],
  [
    [0.25, 1.03, 0.1, 0.07, 0.015],
    [0.5, 0.42, 0.3],
  ],
];

/**
 * A cow's coat, a color a vertex: made by this project, since the file has none. Places are on the finished model.
 * @param {Float32Array} positions
 * @returns {Uint8Array} RGBA in linear light.
 */
function coat(positions) {
  const colors = new Uint8Array((4 * positions.length) / 3).fill(255);
  for (let i = 0; i < positions.length; i += 3) {
    const [x, y, z] = [positions[i] ?? 0, positions[i + 1] ?? 0, positions[i + 2] ?? 0];
    const near = /** @type {(cx: number, cy: number, cz: number, radius: number, soft: number) => number} */ (
      (cx, cy, cz, radius, soft) => between(radius + soft, radius - soft, Math.hypot(x - cx, y - cy, z - cz))
    );
    const wobble = 0.03 * Math.sin(17 * x + 9 * z) * Math.sin(13 * y - 11 * z);
    const dark = Math.max(...PATCHES.map(([cx, cy, cz, radius]) => near(cx, cy, cz, radius + wobble, 0.032)));
    let color = mixColor([0.86, 0.81, 0.73], [0.1, 0.075, 0.065], dark);
    for (const [[cx, cy, cz, radius, soft], paint] of MARKS)
      color = mixColor(color, paint, Math.max(near(cx, cy, cz, radius, soft), near(cx, cy, -cz, radius, soft)));
    color = mixColor(color, [0.08, 0.06, 0.055], between(0.055, 0.035, y));
    colors.set(
      color.map((c) => Math.round(255 * c)),
      (4 * i) / 3,
    );
  }
  return colors;
}

/**
 * @returns {import('./mesh.mjs').Model} Y up, nose along +x, feet at y = 0; 2,930 vertices in the file's order.
 */
export function spot() {
  const ply = parsePly(readFromPackage(PACKAGES.potpourri3d, [PLY]).get(PLY) ?? new Uint8Array());
  const turned = new Float64Array(ply.positions.length);
  for (let i = 0; i < turned.length; i += 3) {
    // The file looks along -z: a quarter turn about y, (x, y, z) -> (-z, y, x), makes it look along +x as the dog does.
    turned[i] = -(ply.positions[i + 2] ?? 0);
    turned[i + 1] = ply.positions[i + 1] ?? 0;
    turned[i + 2] = ply.positions[i] ?? 0;
  }
  const positions = standOnGround(turned, 1.6);
  return {
    name: 'spot',
    positions,
    normals: coarse(smoothNormals(positions, ply.triangles), 512),
    uvs: null,
    triangles: ply.triangles,
    colors: coat(positions),
    material: { color: [1, 1, 1, 1], roughness: 0.7, texture: null },
    license: 'CC0-1.0 (by third-party account)',
  };
}
