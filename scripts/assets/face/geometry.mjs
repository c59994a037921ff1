/** The head cut out of the base mesh: skin, the inside of the mouth, teeth and tongue, as parts. */

import { boundsOf } from '../mesh.mjs';
import { between } from './color.mjs';
import { carry, clip, join, partOf } from './part.mjs';

/** @typedef {import('./source.mjs').FaceSource} FaceSource */
/** @typedef {import('./part.mjs').Part} Part */
/** @typedef {'face' | 'neck' | 'left socket' | 'right socket' | 'mouth' | 'other'} Island */

/**
 * Which island of MakeHuman's texture atlas a place belongs to. The islands lie apart, so boxes tell them from each other.
 * @param {number} u
 * @param {number} v
 * @returns {Island}
 */
export function islandOf(u, v) {
  if (u > 0.64 && v > 0.145) return 'face';
  if (u > 0.75 && v < 0.14) return 'mouth';
  if (u < 0.08 && v > 0.54 && v < 0.64) return 'right socket';
  if (u < 0.16 && v > 0.54 && v < 0.64) return 'left socket';
  if (u > 0.2 && u < 0.56 && v > 0.79) return 'neck';
  return 'other';
}

/**
 * Faces of the body in some islands, near the head.
 * @param {FaceSource} source
 * @param {Island[]} islands
 * @returns {import('./obj.mjs').Face[]}
 */
function bodyFaces(source, islands) {
  return (source.groups.get('body') ?? []).filter(
    (face) =>
      islands.includes(islandOf(source.uvs[2 * (face.t[0] ?? 0)] ?? 0, source.uvs[2 * (face.t[0] ?? 0) + 1] ?? 0)) &&
      face.v.every((id) => Math.abs(source.positions[3 * id] ?? 0) < 1.6 && (source.positions[3 * id + 1] ?? 0) > 4.4),
  );
}

/**
 * All the body's faces about the head and shoulders, whatever their island.
 * @param {FaceSource} source
 */
export function bustFaces(source) {
  return bodyFaces(source, ['face', 'neck', 'other']);
}

/**
 * The skin: head and neck, down to where the garment has covered it.
 * @param {FaceSource} source
 * @returns {Part}
 */
export function skinPart(source) {
  const part = partOf(source, bodyFaces(source, ['face', 'neck', 'left socket', 'right socket']));
  const p = carry(part, source.positions, true);
  const kept = clip(
    part,
    part.vertices.map((_, i) =>
      Math.min(aboveNeckline(p, i) + 0.09, 0.75 - Math.abs(p[3 * i] ?? 0) * ((p[3 * i + 1] ?? 0) < 5.9 ? 1 : 0)),
    ),
  );
  for (const vertex of kept.vertices) [vertex.u, vertex.v] = atlas(vertex.u, vertex.v);
  return kept;
}

/**
 * Height above the plane of the neckline, which falls towards the front.
 * @param {Float64Array} p
 * @param {number} i
 */
export function aboveNeckline(p, i) {
  return (p[3 * i + 1] ?? 0) - 5.39 - 0.26 * (0.72 - (p[3 * i + 2] ?? 0));
}

/**
 * MakeHuman's atlas gives the scalp more room than the face. This one spreads the face over most of the square, with the
 * eyes, nose and mouth largest; each island is warped by a monotone function of either coordinate, so none folds over.
 * @param {number} u
 * @param {number} v
 * @returns {[number, number]}
 */
function atlas(u, v) {
  const island = islandOf(u, v);
  // From 0 to 1 as t does, fastest at `middle`, over about `width` to either side.
  const swell = /** @type {(t: number, middle: number, width: number) => number} */ (
    (t, middle, width) => {
      const [low = 0, at = 0, high = 1] = [0, t, 1].map((x) => (x - middle) / Math.hypot(width, x - middle));
      return (at - low) / (high - low);
    }
  );
  if (island === 'face')
    return [0.01 + 0.98 * swell((v - 0.1475) / 0.672, 0.5, 0.17), 0.165 + 0.83 * swell((0.994 - u) / 0.354, 0.3, 0.26)];
  if (island === 'neck') return [0.12 + (0.87 * (u - 0.2)) / 0.36, 0.005 + (0.15 * (v - 0.79)) / 0.19];
  const left = island === 'left socket';
  return [0.008 + 0.04 * ((u - (left ? 0.086 : 0.012)) / 0.065) + (left ? 0.05 : 0), 0.01 + 0.13 * ((v - 0.547) / 0.086)];
}

/**
 * The inside of the mouth, the teeth and the tongue as one part, with a color a vertex: dark behind, lighter in front.
 * @param {FaceSource} source
 * @returns {{ part: Part, colors: Uint8Array }}
 */
export function mouthPart(source) {
  /** @type {[Part, [number, number, number]][]} In linear light. */
  const pieces = [
    [partOf(source, bodyFaces(source, ['mouth'])), [0.17, 0.036, 0.033]],
    [partOf(source, source.groups.get('helper-upper-teeth') ?? []), [0.56, 0.51, 0.43]],
    [partOf(source, source.groups.get('helper-lower-teeth') ?? []), [0.44, 0.395, 0.335]],
    [partOf(source, source.groups.get('helper-tongue') ?? []), [0.3, 0.075, 0.072]],
  ];
  for (const [part] of pieces.slice(1, 3)) {
    // The strips are coarse and open: teeth are lit as the smooth arch that they stand in.
    const p = carry(part, source.positions);
    part.vertices.forEach((vertex, i) => {
      const [x, z] = [1.6 * (p[3 * i] ?? 0), (p[3 * i + 2] ?? 0) - 0.85];
      const length = Math.hypot(x, 0.1, z);
      vertex.normal = [x / length, 0.1 / length, z / length];
    });
  }
  const front = boundsOf(carry(pieces[1]?.[0] ?? join([]), source.positions)).max[2];
  const colors = pieces.flatMap(([part, color], piece) => {
    const p = carry(part, source.positions);
    return part.vertices.flatMap((_, i) => {
      // Light reaches the lips and the front teeth only.
      const depth = Math.max(0, front - (p[3 * i + 2] ?? 0));
      const corner = 1 - 0.8 * between(0.13, 0.3, Math.abs(p[3 * i] ?? 0));
      const light = piece === 0 ? Math.max(0.2, 1 - depth / 0.16) : corner * Math.max(0.12, 1 - depth / 0.36);
      return [...color.map((c) => Math.round(255 * c * light)), 255];
    });
  });
  return { part: join(pieces.map(([part]) => part)), colors: Uint8Array.from(colors) };
}
