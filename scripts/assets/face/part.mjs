/**
 * Parts of the face: surfaces whose vertices are weighted sums of base-mesh vertices, so that whatever moves the base mesh
 * (the face units) moves the part too.
 */
import { smoothNormals, weldExact } from '../mesh.mjs';

/**
 * @typedef {object} Vertex
 * @property {number[]} ids Base vertices; empty for a vertex that nothing moves.
 * @property {number[]} weights One for each.
 * @property {[number, number, number]} offset Added to the weighted sum at rest, and not moved by anything.
 * @property {number} u
 * @property {number} v Upward, as in OBJ.
 * @property {number} [group] Normals are smooth within a group, 0 if none is given.
 * @property {[number, number, number]} [normal] Instead of the surface's own; nothing turns it.
 *
 * @typedef {object} Part
 * @property {Vertex[]} vertices
 * @property {number[]} triangles
 */

const SNAP = 0.006;

/**
 * Triangulates faces along the shorter diagonal, and makes one vertex of each pair of position and texture coordinate.
 * @param {import('./source.mjs').FaceSource} source
 * @param {import('./obj.mjs').Face[]} faces
 * @returns {Part}
 */
export function partOf(source, faces) {
  /** @type {Vertex[]} */
  const vertices = [];
  /** @type {number[]} */
  const triangles = [];
  /** @type {Map<string, number>} */
  const seen = new Map();
  for (const face of faces) {
    const [i = 0, j = 0, k = 0, l = 0] = face.v.map((id, corner) => {
      const t = face.t[corner] ?? 0;
      const key = `${id}/${t}`;
      const known = seen.get(key);
      if (known !== undefined) return known;
      seen.set(key, vertices.length);
      return (
        vertices.push({ ids: [id], weights: [1], offset: [0, 0, 0], u: source.uvs[2 * t] ?? 0, v: source.uvs[2 * t + 1] ?? 0 }) - 1
      );
    });
    const [a = 0, b = 0, c = 0, d = 0] = face.v;
    if (squaredDistance(source.positions, a, c) <= squaredDistance(source.positions, b, d)) triangles.push(i, j, k, i, k, l);
    else triangles.push(i, j, l, j, k, l);
  }
  return { vertices, triangles };
}

/**
 * @param {Float64Array} p
 * @param {number} i
 * @param {number} j
 */
function squaredDistance(p, i, j) {
  let sum = 0;
  for (let d = 0; d < 3; ++d) sum += ((p[3 * i + d] ?? 0) - (p[3 * j + d] ?? 0)) ** 2;
  return sum;
}

/**
 * The vertex (1 - t) p + t q.
 * @param {Vertex} p
 * @param {Vertex} q
 * @param {number} t
 * @returns {Vertex}
 */
function mix(p, q, t) {
  /** @type {Map<number, number>} */
  const sum = new Map();
  for (const [k, id] of p.ids.entries()) sum.set(id, (1 - t) * (p.weights[k] ?? 0));
  for (const [k, id] of q.ids.entries()) sum.set(id, (sum.get(id) ?? 0) + t * (q.weights[k] ?? 0));
  const lerp = /** @type {(x: number, y: number) => number} */ ((x, y) => x + t * (y - x));
  return {
    ids: [...sum.keys()],
    weights: [...sum.values()],
    offset: [lerp(p.offset[0], q.offset[0]), lerp(p.offset[1], q.offset[1]), lerp(p.offset[2], q.offset[2])],
    u: lerp(p.u, q.u),
    v: lerp(p.v, q.v),
    group: p.group ?? 0,
  };
}

/**
 * Keeps what lies where a scalar is positive, cutting triangles along its zero line.
 * @param {Part} part
 * @param {ArrayLike<number>} scalar One a vertex.
 * @returns {Part}
 */
export function clip(part, scalar) {
  /** @type {Vertex[]} */
  const vertices = [];
  /** @type {Map<string, number>} */
  const seen = new Map();
  /** @type {(key: string, make: () => Vertex) => number} */
  const add = (key, make) => {
    const known = seen.get(key);
    if (known !== undefined) return known;
    seen.set(key, vertices.length);
    return vertices.push(make()) - 1;
  };
  // A vertex almost on the line is taken to be on it, so that no slivers are cut.
  const values = Float64Array.from(scalar, (s) => (Math.abs(s) < SNAP ? 0 : s));
  /** @type {number[]} */
  const triangles = [];
  for (let k = 0; k < part.triangles.length; k += 3) {
    /** @type {number[]} */
    const polygon = [];
    for (let c = 0; c < 3; ++c) {
      const i = part.triangles[k + c] ?? 0;
      const j = part.triangles[k + ((c + 1) % 3)] ?? 0;
      const si = values[i] ?? 0;
      const sj = values[j] ?? 0;
      if (si >= 0) polygon.push(add(`${i}`, () => vertexOf(part, i)));
      if (si * sj < 0) {
        // Cut from the lower end, so that both triangles beside the edge get the same vertex.
        const [lo, hi, slo, shi] = i < j ? [i, j, si, sj] : [j, i, sj, si];
        polygon.push(add(`${lo}-${hi}`, () => mix(vertexOf(part, lo), vertexOf(part, hi), slo / (slo - shi))));
      }
    }
    for (let c = 2; c < polygon.length; ++c) triangles.push(polygon[0] ?? 0, polygon[c - 1] ?? 0, polygon[c] ?? 0);
  }
  return { vertices, triangles };
}

/**
 * One triangle into four. New vertices bulge towards the tangent planes of the edge's ends, which keeps a coarse skull
 * round (the edge case of Phong tessellation, Boubekeur and Alexa 2008).
 * @param {import('./source.mjs').FaceSource} source
 * @param {Part} part
 * @returns {Part}
 */
export function subdivide(source, part) {
  const positions = carry(part, source.positions, true);
  const normals = smoothNormals(positions, part.triangles);
  const vertices = [...part.vertices];
  /** @type {Map<string, number>} */
  const seen = new Map();
  /** @type {(i: number, j: number) => number} */
  const middle = (i, j) => {
    const key = i < j ? `${i}-${j}` : `${j}-${i}`;
    const known = seen.get(key);
    if (known !== undefined) return known;
    const vertex = mix(vertexOf(part, Math.min(i, j)), vertexOf(part, Math.max(i, j)), 0.5);
    /** @type {(from: number, to: number) => number} */
    const height = (from, to) =>
      [0, 1, 2].reduce(
        (sum, d) => sum + (normals[3 * from + d] ?? 0) * ((positions[3 * to + d] ?? 0) - (positions[3 * from + d] ?? 0)),
        0,
      );
    // The middle lies half the end's height off the tangent plane at either end; Phong tessellation goes 3/4 of the way
    // to the mean of the two projections.
    const [hi, hj] = [0.5 * height(i, j), 0.5 * height(j, i)];
    for (const d of /** @type {const} */ ([0, 1, 2]))
      vertex.offset[d] -= 0.375 * (hi * (normals[3 * i + d] ?? 0) + hj * (normals[3 * j + d] ?? 0));
    seen.set(key, vertices.length);
    return vertices.push(vertex) - 1;
  };
  /** @type {number[]} */
  const triangles = [];
  for (let k = 0; k < part.triangles.length; k += 3) {
    const [a = 0, b = 0, c = 0] = part.triangles.slice(k, k + 3);
    const [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
    triangles.push(a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca);
  }
  return { vertices, triangles };
}

/**
 * Values that live on base vertices, 3 each, carried to a part's vertices.
 * @param {Part} part
 * @param {Float64Array} values
 * @param {boolean} [atRest] Whether these are rest positions, to which a vertex's own offset belongs.
 * @returns {Float64Array}
 */
export function carry(part, values, atRest = false) {
  const out = new Float64Array(3 * part.vertices.length);
  part.vertices.forEach(({ ids, weights, offset }, i) => {
    for (let d = 0; d < 3; ++d) {
      let sum = atRest ? (offset[d] ?? 0) : 0;
      for (let k = 0; k < ids.length; ++k) sum += (weights[k] ?? 0) * (values[3 * (ids[k] ?? 0) + d] ?? 0);
      out[3 * i + d] = sum;
    }
  });
  return out;
}

/**
 * Rest positions and smooth normals of a part.
 * @param {import('./source.mjs').FaceSource} source
 * @param {Part} part
 */
export function restOf(source, part) {
  const positions = carry(part, source.positions, true);
  const weld = weldExact(positions, (i) => part.vertices[i]?.group ?? 0);
  return { positions, weld, normals: normalsOf(part, positions, weld) };
}

/**
 * @param {Part} part
 * @param {ArrayLike<number>} positions
 * @param {Uint32Array} weld
 * @returns {Float64Array}
 */
export function normalsOf(part, positions, weld) {
  const normals = smoothNormals(positions, part.triangles, weld);
  part.vertices.forEach(({ normal }, i) => {
    if (normal) normals.set(normal, 3 * i);
  });
  return normals;
}

/**
 * Several parts as one, in order.
 * @param {Part[]} parts
 * @returns {Part}
 */
export function join(parts) {
  /** @type {Part} */
  const all = { vertices: [], triangles: [] };
  for (const part of parts) {
    const start = all.vertices.length;
    for (const vertex of part.vertices) all.vertices.push(vertex);
    for (const index of part.triangles) all.triangles.push(start + index);
  }
  return all;
}

/**
 * A vertex where it is asked for, that nothing moves.
 * @param {number} x
 * @param {number} y
 * @param {number} z
 * @param {number} u
 * @param {number} v
 * @returns {Vertex}
 */
export function fixed(x, y, z, u, v) {
  return { ids: [], weights: [], offset: [x, y, z], u, v };
}

/**
 * @param {Part} part
 * @param {number} i
 * @returns {Vertex}
 */
function vertexOf(part, i) {
  const vertex = part.vertices[i];
  if (!vertex) throw new RangeError(`No vertex ${i}.`);
  return vertex;
}
