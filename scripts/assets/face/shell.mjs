/** Surfaces grown from the base mesh: raised along their normals, with edges that look thick. */
import { weldExact } from '../mesh.mjs';
import { carry, restOf } from './part.mjs';

/** @typedef {import('./source.mjs').FaceSource} FaceSource */
/** @typedef {import('./part.mjs').Part} Part */

/**
 * Moves each vertex along its normal.
 * @param {FaceSource} source
 * @param {Part} part
 * @param {(i: number) => number} height
 */
export function raise(source, part, height) {
  const { normals } = restOf(source, part);
  part.vertices.forEach((vertex, i) => {
    const h = height(i);
    vertex.offset = [
      vertex.offset[0] + h * (normals[3 * i] ?? 0),
      vertex.offset[1] + h * (normals[3 * i + 1] ?? 0),
      vertex.offset[2] + h * (normals[3 * i + 2] ?? 0),
    ];
  });
}

/**
 * Edges that one triangle only uses, in that triangle's direction.
 * @param {FaceSource} source
 * @param {Part} part
 * @returns {[number, number][]}
 */
export function boundary(source, part) {
  const weld = weldExact(carry(part, source.positions, true));
  /** @type {Map<string, [number, number]>} */
  const open = new Map();
  for (let k = 0; k < part.triangles.length; ++k) {
    const i = part.triangles[k] ?? 0;
    const j = part.triangles[k - (k % 3) + ((k + 1) % 3)] ?? 0;
    const [a, b] = [weld[i], weld[j]];
    if (!open.delete(`${b}-${a}`)) open.set(`${a}-${b}`, [i, j]);
  }
  return [...open.values()];
}

/**
 * Turns the edges of a part inwards, so that it looks as thick as `depth`.
 * @param {FaceSource} source
 * @param {Part} part
 * @param {number} depth
 */
export function addRim(source, part, depth) {
  const { normals } = restOf(source, part);
  /** @type {Map<number, [number, number]>} */
  const copies = new Map();
  /** @type {(i: number) => [number, number]} The edge's own copy of a vertex, with normals of its own, and its inner end. */
  const copy = (i) => {
    const known = copies.get(i);
    if (known !== undefined) return known;
    const vertex = /** @type {import('./part.mjs').Vertex} */ (part.vertices[i]);
    const offset = /** @type {[number, number, number]} */ (vertex.offset.map((o, d) => o - depth * (normals[3 * i + d] ?? 0)));
    const outer = part.vertices.push({ ...vertex, group: 1 }, { ...vertex, offset, group: 1 }) - 2;
    copies.set(i, [outer, outer + 1]);
    return [outer, outer + 1];
  };
  for (const [i, j] of boundary(source, part)) {
    const [[io, ii], [jo, ji]] = [copy(i), copy(j)];
    part.triangles.push(jo, io, ii, jo, ii, ji);
  }
}
