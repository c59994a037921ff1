/** Small helpers for painting: sRGB triples of 0 to 255, smooth steps and value noise. */

/** @typedef {[number, number, number]} Color */

/**
 * @param {Color} a
 * @param {Color} b
 * @param {number} t
 * @returns {Color}
 */
export function mixColor(a, b, t) {
  const k = Math.min(1, Math.max(0, t));
  return [a[0] + k * (b[0] - a[0]), a[1] + k * (b[1] - a[1]), a[2] + k * (b[2] - a[2])];
}

/**
 * A smooth step: 0 at `from`, 1 at `to`, which may be the lesser.
 * @param {number} from
 * @param {number} to
 * @param {number} x
 */
export function between(from, to, x) {
  const t = Math.min(1, Math.max(0, (x - from) / (to - from)));
  return t * t * (3 - 2 * t);
}

/**
 * @param {number} x
 * @param {number} center
 * @param {number} width
 */
export function bell(x, center, width) {
  return Math.exp(-(((x - center) / width) ** 2));
}

/**
 * @param {number} x
 * @param {number} y
 */
function hash(x, y) {
  let h = Math.imul(x, 374761393) + Math.imul(y, 668265263);
  h = Math.imul(h ^ (h >>> 13), 1274126177);
  return ((h ^ (h >>> 16)) >>> 0) / 4294967296;
}

/**
 * Value noise between 0 and 1, the same on every machine.
 * @param {number} x
 * @param {number} y
 */
export function noise(x, y) {
  const i = Math.floor(x);
  const j = Math.floor(y);
  const u = between(0, 1, x - i);
  const v = between(0, 1, y - j);
  const low = hash(i, j) + u * (hash(i + 1, j) - hash(i, j));
  const high = hash(i, j + 1) + u * (hash(i + 1, j + 1) - hash(i, j + 1));
  return low + v * (high - low);
}

/**
 * Value noise around a circle, between 0 and 1, that meets itself.
 * @param {number} turn Around the circle, 1 a turn.
 * @param {number} cells How many values a turn.
 * @param {number} row Another row is another noise; rows blend.
 */
export function ringNoise(turn, cells, row) {
  const x = (turn - Math.floor(turn)) * cells;
  const i = Math.floor(x);
  const j = Math.floor(row);
  const [u, v] = [between(0, 1, x - i), between(0, 1, row - j)];
  const value = /** @type {(r: number) => number} */ (
    (r) => hash(i % cells, r) + u * (hash((i + 1) % cells, r) - hash(i % cells, r))
  );
  return value(j) + v * (value(j + 1) - value(j));
}

/**
 * Three octaves of value noise, between 0 and 1.
 * @param {number} x
 * @param {number} y
 */
export function fbm(x, y) {
  return (4 * noise(x, y) + 2 * noise(2 * x + 31, 2 * y + 17) + noise(4 * x + 67, 4 * y + 43)) / 7;
}
