/**
 * The skin's texture: triangles are drawn in the atlas, and each texel is colored by the place on the head it belongs to.
 * All colors are sRGB; all places are in the base mesh's units, on the reference head of
 * `source.mjs`, so that the paint stays where it is on a head of another identity.
 */
import { dilate, encodePng, rasterize } from '../png.mjs';
import { bell, between, fbm, mixColor, noise } from './color.mjs';
import { aboveHairline, combing } from './hair.mjs';

/** @typedef {import('./color.mjs').Color} Color */

/** @type {Color} */
const SKIN = [224, 172, 143];
/** @type {Color} */
const LIP = [186, 96, 92];
/** @type {Color} */
const BROW = [58, 38, 29];

/**
 * @param {number} x Distance from the middle line.
 * @returns {[number, number]} The upper and lower border of the lips.
 */
function lipBorders(x) {
  const half = Math.max(0, 1 - (x / 0.222) ** 2);
  const upper = 6.058 + 0.098 * half ** 0.85 - 0.018 * bell(x, 0, 0.032);
  const lower = 6.058 - 0.142 * half ** 0.72;
  return [upper, lower];
}

/**
 * How much of an eyebrow a place has, 0 to 1.
 * @param {number} x Distance from the middle line.
 * @param {number} y
 */
function brow(x, y) {
  const s = (x - 0.125) / 0.36;
  if (s < -0.1 || s > 1.1) return 0;
  const middle = 6.822 + 0.062 * Math.sin(Math.PI * Math.min(1, Math.max(0, s * 0.82 + 0.02))) - 0.035 * between(0.6, 1.05, s);
  const half = 0.04 * between(-0.1, 0.14, s) * (1 - 0.72 * between(0.35, 1.05, s));
  const across = (y - middle) / half;
  const body = between(1.25, 0.35, Math.abs(across)) * between(-0.06, 0.16, s) * between(1.08, 0.85, s);
  // Hairs lean outwards: rising at the inner end, lying along the brow at the outer one.
  const lean = 1.25 * between(0.9, -0.2, s) + 0.12 - 0.35 * across * between(0.2, 0.8, s);
  const [along, beside] = [x * Math.cos(lean) + (y - middle) * Math.sin(lean), (y - middle) * Math.cos(lean) - x * Math.sin(lean)];
  const hairs = 0.7 * noise(along * 22, beside * 190) + 0.3 * noise(along * 30 + 9, beside * 90);
  return body * (0.7 + 0.3 * between(0.25, 0.6, hairs));
}

/**
 * @param {number} x
 * @param {number} y
 * @param {number} z
 * @param {number} shade Ambient light that reaches the place, 0 to 1.
 * @returns {Color}
 */
function skinColor(x, y, z, shade) {
  const side = Math.abs(x);
  const front = between(0.75, 1.05, z);
  let color = mixColor(SKIN, [231, 184, 156], 0.6 * fbm(x * 5 + 40, y * 5 + z * 3));
  // Warmth where the blood is near: cheeks, the tip of the nose, ears, a little on the chin.
  const blush =
    0.36 * bell(side, 0.4, 0.22) * bell(y, 6.38, 0.21) * front +
    0.34 * bell(side, 0, 0.16) * bell(y, 6.33, 0.12) * between(1.3, 1.45, z) +
    0.5 * between(0.72, 0.8, side) * between(6.8, 6.6, y) * between(6.1, 6.3, y) +
    0.14 * bell(side, 0, 0.16) * bell(y, 5.78, 0.1);
  color = mixColor(color, [214, 118, 104], blush);
  // Lids and the hollows beside the nose a little deeper; the bridge, brow bone and cheekbone a little lighter.
  const lids = bell(side, 0.29, 0.17) * bell(y, 6.715, 0.075) * front;
  color = mixColor(color, [168, 104, 92], 0.42 * lids);
  color = mixColor(color, [176, 118, 108], 0.3 * bell(side, 0.26, 0.14) * bell(y, 6.575, 0.05) * front);
  color = mixColor(
    color,
    [240, 200, 176],
    0.25 * bell(side, 0, 0.05) * between(6.2, 6.45, y) * between(7.2, 6.8, y) * front +
      0.2 * bell(side, 0.46, 0.12) * bell(y, 6.5, 0.06) * front,
  );
  // Inside the nostrils.
  color = mixColor(color, [74, 34, 28], 0.75 * bell(side, 0.088, 0.034) * bell(y, 6.294, 0.018) * between(1.2, 1.25, z));
  // The roots of the lashes.
  color = mixColor(
    color,
    [70, 44, 38],
    0.5 * bell(side, 0.285, 0.13) * bell(y, 6.68, 0.06) * between(1.215, 1.19, z) * between(1.1, 1.14, z),
  );
  // Lips: full color inside, a soft border, a darker line where they meet.
  const [upper, lower] = lipBorders(side);
  if (z > 1.1 && side < 0.25 && y > 5.85 && y < 6.2) {
    const inside = Math.min(upper - y, y - lower);
    const soft = between(-0.008, 0.016, inside) * between(0.226, 0.2, side);
    const grain = noise(x * 90, y * 14);
    let lip = mixColor(LIP, [205, 120, 112], 0.75 * bell(y, 5.99, 0.035) * bell(side, 0, 0.12) + 0.18 * grain);
    lip = mixColor(lip, [136, 62, 62], 0.75 * bell(y, 6.058, 0.017));
    color = mixColor(color, lip, 0.88 * soft);
  }
  color = mixColor(color, BROW, 0.9 * brow(side, y) * between(0.9, 1, z));
  // The first hairs, which the cap grows out of.
  const above = aboveHairline(x, y, z);
  if (above > -0.2 && y > 5.8) {
    const [around, along] = combing(x, y, z);
    const strand = fbm(around * 420, along * 12);
    color = mixColor(
      color,
      [66, 43, 32],
      0.92 * between(-0.06 + 0.045 * strand, 0.012 + 0.02 * strand, above) + 0.16 * between(-0.12, 0, above),
    );
  }
  // Skin lets light through: what is in shade turns red before it turns dark.
  // Under the collar nothing is seen; its edge is shaded as softly as a collar that stands off would.
  const dark = (1 - shade) * between(5.25, 5.75, y + 0.3 * (z - 0.3)) * 0.8 + (1 - shade) * 0.2;
  return [color[0] * (1 - 0.46 * dark), color[1] * (1 - 0.62 * dark), color[2] * (1 - 0.64 * dark)];
}

/**
 * @param {{ uvs: ArrayLike<number>, positions: ArrayLike<number>, shade: ArrayLike<number>, triangles: ArrayLike<number> }} mesh `uvs` with v downward; `shade` one a vertex.
 * @param {number} size
 * @returns {Uint8Array} A PNG.
 */
export function paintSkin(mesh, size) {
  const pixels = new Uint8Array(4 * size * size);
  /** @type {(array: ArrayLike<number>, stride: number, d: number, corners: number[], weights: number[]) => number} */
  const blend = (array, stride, d, corners, weights) =>
    corners.reduce((sum, i, c) => sum + (weights[c] ?? 0) * (array[stride * i + d] ?? 0), 0);
  rasterize(mesh, size, (x, y, corners, weights) => {
    const [px = 0, py = 0, pz = 0] = [0, 1, 2].map((d) => blend(mesh.positions, 3, d, corners, weights));
    const color = skinColor(px, py, pz, blend(mesh.shade, 1, 0, corners, weights));
    pixels.set([...color.map(Math.round), 255], 4 * (y * size + x));
  });
  dilate(pixels, size);
  return encodePng(pixels, size, size);
}
