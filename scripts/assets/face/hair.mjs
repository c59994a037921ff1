/** Hair combed back into a knot: made for this project from the base mesh's own scalp. */
import { encodePng } from '../png.mjs';
import { between, fbm, mixColor, noise } from './color.mjs';
import { bustFaces, islandOf } from './geometry.mjs';
import { carry, clip, fixed, join, partOf, subdivide } from './part.mjs';
import { raise } from './shell.mjs';

/** @typedef {import('./source.mjs').FaceSource} FaceSource */
/** @typedef {import('./part.mjs').Part} Part */

const SKULL = /** @type {const} */ ([0, 6.75, 0.45]);
const KNOT = /** @type {const} */ ([0, 7.68, -0.32]);
const KNOT_RADIUS = 0.3;
const DEGREE = Math.PI / 180;

/** The hairline: elevation over azimuth about the skull's center, both in degrees; 0 is straight ahead. */
const HAIRLINE = [
  [0, 40],
  [20, 41],
  [36, 38],
  [50, 27],
  [62, 14],
  [72, 3],
  [79, -6],
  [85, -4],
  [91, 5],
  [104, 6],
  [114, -8],
  [126, -25],
  [145, -37],
  [180, -41],
];

/**
 * How far above the hairline a place is, in radians: hair grows where this is positive.
 * @param {number} x
 * @param {number} y
 * @param {number} z
 */
export function aboveHairline(x, y, z) {
  const [dx, dy, dz] = [Math.abs(x - SKULL[0]), y - SKULL[1], z - SKULL[2]];
  const azimuth = Math.atan2(dx, dz) / DEGREE;
  const elevation = Math.atan2(dy, Math.hypot(dx, dz)) / DEGREE;
  const next = Math.max(
    1,
    HAIRLINE.findIndex(([a = 0]) => a >= azimuth),
  );
  const [a0 = 0, e0 = 0] = HAIRLINE[next - 1] ?? [];
  const [a1 = 180, e1 = 0] = HAIRLINE[next] ?? [];
  const line = e0 + (e1 - e0) * between(a0, a1, azimuth);
  return (elevation - line) * DEGREE;
}

/**
 * @param {FaceSource} source
 * @returns {Part}
 */
export function hairPart(source) {
  const scalp = bustFaces(source).filter((face) => {
    const t = face.t[0] ?? 0;
    return (
      islandOf(source.uvs[2 * t] ?? 0, source.uvs[2 * t + 1] ?? 0) !== 'other' &&
      face.v.some(
        (id) =>
          aboveHairline(source.reference[3 * id] ?? 0, source.reference[3 * id + 1] ?? 0, source.reference[3 * id + 2] ?? 0) >
          -0.25,
      )
    );
  });
  let cap = subdivide(source, subdivide(source, partOf(source, scalp)));
  const above = /** @type {(part: Part) => number[]} */ (
    (part) => {
      const p = carry(part, source.reference, true);
      return part.vertices.map((_, i) => aboveHairline(p[3 * i] ?? 0, p[3 * i + 1] ?? 0, p[3 * i + 2] ?? 0));
    }
  );
  cap = clip(
    cap,
    above(cap).map((h) => h + 0.03),
  );
  const inside = above(cap);
  // The edge dives under the skin, which is painted with the first hairs: no rim shows.
  raise(source, cap, (i) => -0.022 + 0.04 * between(-0.03, 0.06, inside[i] ?? 0) + 0.085 * between(0, 0.5, inside[i] ?? 0));
  combed(source, cap);
  return join([cap, knot()]);
}

/**
 * Where a place lies in the combing: around the axis from the skull's center to the knot (0 to 1), and along it.
 * @param {number} x
 * @param {number} y
 * @param {number} z
 * @returns {[number, number]}
 */
export function combing(x, y, z) {
  const length = Math.hypot(KNOT[1] - SKULL[1], KNOT[2] - SKULL[2]);
  const [ay, az] = [(KNOT[1] - SKULL[1]) / length, (KNOT[2] - SKULL[2]) / length];
  const [dy, dz] = [y - SKULL[1], z - SKULL[2]];
  // Across the axis: x, and what is at right angles to both, forward.
  const around = 0.5 + Math.atan2(x, dz * ay - dy * az) / (2 * Math.PI);
  return [around, Math.acos(Math.min(1, Math.max(-1, (dy * ay + dz * az) / Math.hypot(x, dy, dz)))) / Math.PI];
}

/**
 * Texture coordinates along the combing, from the hairline to the knot: u around the knot's axis, v towards it. Vertices
 * on the seam are doubled, so that no triangle spans it.
 * @param {FaceSource} source
 * @param {Part} cap
 */
function combed(source, cap) {
  const p = carry(cap, source.reference, true);
  cap.vertices.forEach((vertex, i) => {
    [vertex.u, vertex.v] = combing(p[3 * i] ?? 0, p[3 * i + 1] ?? 0, p[3 * i + 2] ?? 0);
  });
  for (let k = 0; k < cap.triangles.length; k += 3) {
    const us = [0, 1, 2].map((c) => cap.vertices[cap.triangles[k + c] ?? 0]?.u ?? 0);
    if (Math.max(...us) - Math.min(...us) < 0.5) continue;
    for (let c = 0; c < 3; ++c) {
      const vertex = cap.vertices[cap.triangles[k + c] ?? 0];
      if (vertex && vertex.u < 0.5) cap.triangles[k + c] = cap.vertices.push({ ...vertex, u: vertex.u + 1 }) - 1;
    }
  }
}

/** @returns {Part} A knot of hair: a ball, a little flat, wound about its axis. */
function knot() {
  /** @type {Part} */
  const part = { vertices: [], triangles: [] };
  const [rings, spokes] = [14, 28];
  const axis = Math.atan2(KNOT[1] - SKULL[1], -(KNOT[2] - SKULL[2]));
  for (let r = 0; r <= rings; ++r)
    for (let s = 0; s <= spokes; ++s) {
      const polar = (Math.PI * r) / rings;
      const around = (2 * Math.PI * (s % spokes)) / spokes;
      const wound = 1 + 0.035 * Math.sin(2 * around + 5 * polar);
      const [side, front, up] = [
        Math.sin(polar) * Math.sin(around) * wound,
        Math.sin(polar) * Math.cos(around) * wound,
        0.8 * Math.cos(polar),
      ];
      const y = up * Math.sin(axis) + front * Math.cos(axis);
      const z = -up * Math.cos(axis) + front * Math.sin(axis);
      // Winding: the strands' direction turns with the polar angle.
      part.vertices.push(
        fixed(
          KNOT[0] + KNOT_RADIUS * side,
          KNOT[1] + KNOT_RADIUS * y,
          KNOT[2] + KNOT_RADIUS * z,
          0.35 * (r / rings) + (0.25 * s) / spokes,
          0.25 + (0.6 * s) / spokes,
        ),
      );
      if (r === 0 || s === 0) continue;
      const i = part.vertices.length - 1;
      const [a, b, c] = [i - spokes - 2, i - spokes - 1, i - 1];
      if (r > 1) part.triangles.push(a, c, b);
      if (r < rings) part.triangles.push(b, c, i);
    }
  return part;
}

/**
 * Strands: noise that is fine across the combing and long along it.
 * @param {number} width
 * @param {number} height
 * @returns {Uint8Array} A PNG.
 */
export function paintHair(width, height) {
  const pixels = new Uint8Array(4 * width * height).fill(255);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const u = x / width;
      const v = y / height;
      // Sampled on a circle, so that the texture meets itself where u wraps.
      const ring = /** @type {(turns: number, shift: number) => number} */ (
        (turns, shift) => fbm(turns * Math.cos(2 * Math.PI * u) + 50 + shift, turns * Math.sin(2 * Math.PI * u) + 50 + 3 * v)
      );
      const locks = ring(9, 0);
      const strands = ring(44, 7);
      let color = mixColor([52, 33, 24], [98, 66, 46], between(0.3, 0.75, 0.45 * locks + 0.55 * strands));
      color = mixColor(color, [132, 92, 62], 0.35 * between(0.62, 0.8, strands) * between(0.4, 0.6, locks));
      color = mixColor(color, [30, 19, 15], 0.5 * between(0.42, 0.3, locks));
      color = mixColor(color, [30, 19, 15], 0.08 * noise(u * 300, v * 4));
      pixels.set(color.map(Math.round), 4 * (y * width + x));
    }
  return encodePng(pixels, width, height);
}
