/**
 * Wavefront OBJ with named groups, and MakeHuman's sparse `.target` files: text in, typed arrays out.
 * Only what the base mesh uses is read: `v`, `vt`, `g` and `f v/vt …`.
 */

/**
 * @typedef {object} Face One polygon: parallel arrays of vertex and texture-coordinate indices, zero-based.
 * @property {number[]} v
 * @property {number[]} t
 *
 * @typedef {object} ObjMesh
 * @property {Float64Array} positions 3 a vertex.
 * @property {Float64Array} uvs 2 a texture coordinate, v upward as OBJ has it.
 * @property {Map<string, Face[]>} groups Faces by group name.
 *
 * @typedef {object} SparseTarget Displacements of some vertices; all others stay.
 * @property {Uint32Array} indices
 * @property {Float64Array} deltas 3 an index.
 */

/**
 * @param {string} text
 * @returns {ObjMesh}
 */
export function parseObj(text) {
  /** @type {number[]} */
  const positions = [];
  /** @type {number[]} */
  const uvs = [];
  /** @type {Map<string, Face[]>} */
  const groups = new Map();
  let group = 'default';
  for (const line of text.split('\n')) {
    const words = line.trim().split(/\s+/);
    const keyword = words[0];
    if (keyword === 'v') positions.push(Number(words[1]), Number(words[2]), Number(words[3]));
    else if (keyword === 'vt') uvs.push(Number(words[1]), Number(words[2]));
    else if (keyword === 'g') group = words[1] ?? 'default';
    else if (keyword === 'f') {
      const corners = words.slice(1).map((word) => word.split('/').map(Number));
      const faces = groups.get(group) ?? [];
      faces.push({ v: corners.map((c) => (c[0] ?? 0) - 1), t: corners.map((c) => (c[1] ?? 0) - 1) });
      groups.set(group, faces);
    }
  }
  return { positions: Float64Array.from(positions), uvs: Float64Array.from(uvs), groups };
}

/**
 * @param {string} text Lines of `index dx dy dz`; `#` starts a comment.
 * @returns {SparseTarget}
 */
export function parseTarget(text) {
  /** @type {number[]} */
  const indices = [];
  /** @type {number[]} */
  const deltas = [];
  for (const line of text.split('\n')) {
    const words = line.trim().split(/\s+/);
    if (words.length < 4 || words[0]?.startsWith('#')) continue;
    indices.push(Number(words[0]));
    deltas.push(Number(words[1]), Number(words[2]), Number(words[3]));
  }
  return { indices: Uint32Array.from(indices), deltas: Float64Array.from(deltas) };
}

/**
 * Adds `weight` times a target to positions, in place.
 * @param {Float64Array} positions
 * @param {SparseTarget} target
 * @param {number} weight
 */
export function addTarget(positions, target, weight) {
  target.indices.forEach((index, k) => {
    for (let d = 0; d < 3; ++d) {
      const i = 3 * index + d;
      positions[i] = (positions[i] ?? 0) + weight * (target.deltas[3 * k + d] ?? 0);
    }
  });
}
