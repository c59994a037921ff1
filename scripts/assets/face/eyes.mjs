/**
 * Eyeballs: a fine sphere with a cornea in place of MakeHuman's coarse one, and a painted iris.
 * Texture coordinates are polar about the gaze: the radius is the angle from it, so that an iris is a plain disk.
 */

import { boundsOf } from '../mesh.mjs';
import { encodePng } from '../png.mjs';
import { between, mixColor, ringNoise } from './color.mjs';

const RINGS = 18;
const SPOKES = 32;
/** Angles from the gaze, in radians. */
const IRIS = 0.56;
const PUPIL = 0.21;
/** The ball is drawn to here; the rest lies in the socket. */
const EXTENT = 1.75;

/**
 * @param {import('./source.mjs').FaceSource} source
 * @param {'helper-l-eye' | 'helper-r-eye'} group
 * @returns {import('./part.mjs').Part}
 */
export function eyeball(source, group) {
  const ids = [...new Set((source.groups.get(group) ?? []).flatMap((face) => face.v))];
  const points = ids.flatMap((id) => [...source.positions.subarray(3 * id, 3 * id + 3)]);
  const { min, max } = boundsOf(points);
  const radius = (max[0] - min[0] + max[1] - min[1]) / 4;
  const center = /** @type {const} */ ([(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, min[2] + radius]);
  const affine = affineCombination(points);
  /** @type {import('./part.mjs').Part} */
  const part = { vertices: [], triangles: [] };
  for (let r = 0; r <= RINGS; ++r)
    for (let s = 0; s <= SPOKES; ++s) {
      // Rings are closer together on the iris, where the silhouette of the cornea shows.
      const angle = EXTENT * (r / RINGS) ** 1.15;
      const around = (2 * Math.PI * s) / SPOKES;
      // The cornea: a spherical cap of smaller radius, smoothly let into the ball.
      const bulge = 1 + 0.045 * between(IRIS * 1.15, 0, angle);
      const x = center[0] + radius * bulge * Math.sin(angle) * Math.cos(around % (2 * Math.PI));
      const y = center[1] + radius * bulge * Math.sin(angle) * Math.sin(around % (2 * Math.PI));
      const z = center[2] + radius * bulge * Math.cos(angle);
      const reach = (0.5 * angle) / EXTENT;
      part.vertices.push({
        ids,
        weights: affine([x, y, z]),
        offset: [0, 0, 0],
        u: 0.5 + reach * Math.cos(around),
        v: 0.5 + reach * Math.sin(around),
      });
      if (r === 0 || s === 0) continue;
      const i = part.vertices.length - 1;
      const [a, b, c] = [i - SPOKES - 2, i - SPOKES - 1, i - 1];
      if (r > 1) part.triangles.push(a, c, b);
      part.triangles.push(b, c, i);
    }
  return part;
}

/**
 * Weights that write a point as an affine combination of given points, the shortest such: what moves the points moves
 * the new one by the affine map that fits their motion best.
 * @param {number[]} points 3 a point.
 * @returns {(p: [number, number, number]) => number[]}
 */
function affineCombination(points) {
  const n = points.length / 3;
  const mean = [0, 1, 2].map((d) => points.reduce((sum, value, i) => (i % 3 === d ? sum + value : sum), 0) / n);
  const local = points.map((value, i) => value - (mean[i % 3] ?? 0));
  const at = /** @type {(i: number, d: number) => number} */ ((i, d) => local[3 * i + d] ?? 0);
  const m = [0, 1, 2].map((r) =>
    [0, 1, 2].map((c) => Array.from({ length: n }, (_, i) => at(i, r) * at(i, c)).reduce((x, y) => x + y, 0)),
  );
  const g = /** @type {(r: number, c: number) => number} */ ((r, c) => m[r % 3]?.[c % 3] ?? 0);
  // The inverse of a symmetric 3 x 3 matrix by cofactors, indices taken round.
  const cofactor = /** @type {(r: number, c: number) => number} */ (
    (r, c) => g(r + 1, c + 1) * g(r + 2, c + 2) - g(r + 1, c + 2) * g(r + 2, c + 1)
  );
  const determinant = [0, 1, 2].reduce((sum, c) => sum + g(0, c) * cofactor(0, c), 0);
  return (p) => {
    const q = [0, 1, 2].map((r) =>
      [0, 1, 2].reduce((sum, c) => sum + (cofactor(c, r) / determinant) * ((p[c] ?? 0) - (mean[c] ?? 0)), 0),
    );
    return Array.from({ length: n }, (_, i) => 1 / n + at(i, 0) * (q[0] ?? 0) + at(i, 1) * (q[1] ?? 0) + at(i, 2) * (q[2] ?? 0));
  };
}

/**
 * @param {number} size
 * @returns {Uint8Array} A PNG.
 */
export function paintEye(size) {
  const pixels = new Uint8Array(4 * size * size).fill(255);
  for (let y = 0; y < size; ++y)
    for (let x = 0; x < size; ++x) {
      const dx = (x + 0.5) / size - 0.5;
      const dy = 0.5 - (y + 0.5) / size;
      const angle = Math.hypot(dx, dy) * 2 * EXTENT;
      const around = Math.atan2(dy, dx);
      // Sclera: off-white, warmer and darker towards the lids.
      let color = mixColor([236, 231, 226], [205, 178, 166], between(0.6, 1.35, angle));
      // Iris: fibers run outwards; light around the pupil, dark at the limbus.
      const turn = around / (2 * Math.PI);
      const fibers = (2 * ringNoise(turn, 36, 3 * angle) + ringNoise(turn, 80, 20 + 5 * angle)) / 3;
      const inner = between(PUPIL, IRIS, angle);
      let iris = mixColor([139, 100, 56], [74, 98, 84], between(0.05, 0.55, inner));
      iris = mixColor(iris, [160, 150, 110], 0.6 * between(0.45, 0.8, fibers));
      iris = mixColor(iris, [24, 30, 28], 0.8 * between(0.66, 1, inner));
      // Light from above falls through the cornea onto the far, lower side.
      iris = mixColor(iris, [190, 180, 140], 0.28 * between(0, -0.2, dy) * (1 - inner));
      iris = mixColor(iris, [14, 12, 12], 0.4 * between(0, 0.16, dy));
      color = mixColor(iris, color, between(IRIS - 0.03, IRIS + 0.05, angle));
      color = mixColor([9, 8, 9], color, between(PUPIL - 0.02, PUPIL + 0.025, angle + 0.012 * ringNoise(turn, 20, 3)));
      pixels.set(color.map(Math.round), 4 * (y * size + x));
    }
  return encodePng(pixels, size, size);
}
