/** Triangle meshes as typed arrays: welding, smooth normals, placing. */

/**
 * @typedef {object} Model
 * @property {string} name
 * @property {Float32Array} positions 3 a vertex, Y up, in the file's vertex order.
 * @property {Float32Array} normals 3 a vertex, unit.
 * @property {Float32Array | null} uvs 2 a vertex, v downward as glTF has it; null where the source has none.
 * @property {Uint32Array} triangles 3 a triangle, counterclockwise from outside.
 * @property {Uint8Array | null} colors RGBA in linear light, 4 a vertex, multiplied onto the base color; null for none.
 * @property {{ color: [number, number, number, number], roughness: number, texture: Uint8Array | null }} material `color` is linear; `texture` is a PNG.
 * @property {string} license
 */

/**
 * Gives vertices at exactly the same position one number.
 * @param {ArrayLike<number>} positions
 * @param {(i: number) => number} [group] Vertices of different groups stay apart, which keeps an edge between them hard.
 * @returns {Uint32Array} For each vertex, the first vertex at its position.
 */
export function weldExact(positions, group = () => 0) {
  const count = positions.length / 3;
  const weld = new Uint32Array(count);
  /** @type {Map<string, number>} */
  const seen = new Map();
  for (let i = 0; i < count; ++i) {
    // `+ 0` turns -0 into 0, so that the two are one place.
    const key = `${(positions[3 * i] ?? 0) + 0},${(positions[3 * i + 1] ?? 0) + 0},${(positions[3 * i + 2] ?? 0) + 0},${group(i)}`;
    const first = seen.get(key);
    if (first === undefined) seen.set(key, i);
    weld[i] = first ?? i;
  }
  return weld;
}

/**
 * Area-weighted vertex normals, smooth across vertices that `weld` joins.
 * @param {ArrayLike<number>} positions
 * @param {ArrayLike<number>} triangles
 * @param {Uint32Array} [weld]
 * @returns {Float64Array}
 */
export function smoothNormals(positions, triangles, weld = weldExact(positions)) {
  const p = /** @type {(i: number) => number} */ ((i) => positions[i] ?? 0);
  const normals = new Float64Array(positions.length);
  for (let k = 0; k < triangles.length; k += 3) {
    const [a, b, c] = [0, 1, 2].map((corner) => weld[triangles[k + corner] ?? 0] ?? 0);
    const i = 3 * (a ?? 0);
    const j = 3 * (b ?? 0);
    const l = 3 * (c ?? 0);
    const ux = p(j) - p(i);
    const uy = p(j + 1) - p(i + 1);
    const uz = p(j + 2) - p(i + 2);
    const vx = p(l) - p(i);
    const vy = p(l + 1) - p(i + 1);
    const vz = p(l + 2) - p(i + 2);
    // The cross product's length is twice the area: summing it unnormalised is the weighting.
    for (const corner of [i, j, l]) {
      normals[corner] = (normals[corner] ?? 0) + uy * vz - uz * vy;
      normals[corner + 1] = (normals[corner + 1] ?? 0) + uz * vx - ux * vz;
      normals[corner + 2] = (normals[corner + 2] ?? 0) + ux * vy - uy * vx;
    }
  }
  for (let i = 0; i < weld.length; ++i) {
    const from = 3 * (weld[i] ?? 0);
    if (from !== 3 * i) normals.copyWithin(3 * i, from, from + 3);
  }
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i] ?? 0, normals[i + 1] ?? 0, normals[i + 2] ?? 0);
    if (length === 0) normals[i + 1] = 1;
    else for (let d = 0; d < 3; ++d) normals[i + d] = (normals[i + d] ?? 0) / length;
  }
  return normals;
}

/**
 * To multiples of 1/parts: floats of few digits, which compress to less.
 * @param {ArrayLike<number>} numbers
 * @param {number} parts A power of two.
 */
export function coarse(numbers, parts) {
  return Float32Array.from(numbers, (value) => Math.round(value * parts) / parts);
}

/**
 * The bounding box, as the least and greatest corner.
 * @param {ArrayLike<number>} positions
 * @returns {{ min: [number, number, number], max: [number, number, number] }}
 */
export function boundsOf(positions) {
  /** @type {[number, number, number]} */
  const min = [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY];
  /** @type {[number, number, number]} */
  const max = [Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (let i = 0; i < positions.length; ++i) {
    const d = /** @type {0 | 1 | 2} */ (i % 3);
    min[d] = Math.min(min[d], positions[i] ?? 0);
    max[d] = Math.max(max[d], positions[i] ?? 0);
  }
  return { min, max };
}

/**
 * Scales to a bounding-box diagonal, and stands the model on y = 0, centered in x and z.
 * @param {Float64Array} positions
 * @param {number} diagonal
 * @returns {Float32Array}
 */
export function standOnGround(positions, diagonal) {
  const { min, max } = boundsOf(positions);
  const scale = diagonal / Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
  const origin = [(min[0] + max[0]) / 2, min[1], (min[2] + max[2]) / 2];
  return Float32Array.from(positions, (value, i) => (value - (origin[i % 3] ?? 0)) * scale);
}
