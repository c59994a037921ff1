/** PNG in and out. Bytes depend on the pixels and on zlib alone: no time stamp is written. */
import { PNG } from 'pngjs';

/**
 * @param {Uint8Array} rgba 4 a pixel, sRGB, rows from the top.
 * @param {number} width
 * @param {number} height
 * @param {boolean} [alpha] Whether to keep the alpha channel.
 * @returns {Uint8Array}
 */
export function encodePng(rgba, width, height, alpha = false) {
  const png = new PNG({ width, height });
  png.data = Buffer.from(rgba.buffer, rgba.byteOffset, rgba.byteLength);
  // Strategy 1, "filtered": smaller by 4% than the run lengths that pngjs would look for.
  return new Uint8Array(
    PNG.sync.write(png, { colorType: alpha ? 6 : 2, inputHasAlpha: true, deflateLevel: 9, deflateStrategy: 1 }),
  );
}

/**
 * Averages a square texture down by a whole factor. Only texels that a triangle covers count, and what none covers is
 * filled from the nearest that is covered, so that no background shows along seams.
 * @param {Uint8Array} bytes A PNG.
 * @param {number} size The new width and height.
 * @param {{ uvs: ArrayLike<number>, triangles: ArrayLike<number> }} atlas `uvs` with v downward.
 * @param {(image: { width: number, data: Uint8Array }, covered: Uint8Array) => void} [retouch] Paints on the full-size texels.
 * @returns {Uint8Array} A PNG without alpha.
 */
export function shrinkTexture(bytes, size, atlas, retouch) {
  const image = PNG.sync.read(Buffer.from(bytes));
  const factor = image.width / size;
  if (image.width !== image.height || !Number.isInteger(factor))
    throw new Error(`Cannot shrink ${image.width} x ${image.height} to ${size} x ${size} by a whole factor.`);
  const covered = new Uint8Array(image.width * image.height);
  rasterize(atlas, image.width, (x, y) => {
    covered[y * image.width + x] = 1;
  });
  retouch?.(image, covered);
  const out = new Uint8Array(4 * size * size);
  for (let y = 0; y < size; ++y)
    for (let x = 0; x < size; ++x) {
      const texels = Array.from(
        { length: factor * factor },
        (_, k) => (y * factor + Math.floor(k / factor)) * image.width + x * factor + (k % factor),
      ).filter((texel) => covered[texel]);
      if (texels.length === 0) continue;
      const mean = [0, 1, 2].map((c) =>
        Math.round(texels.reduce((sum, texel) => sum + (image.data[4 * texel + c] ?? 0), 0) / texels.length),
      );
      out.set([...mean, 255], 4 * (y * size + x));
    }
  dilate(out, size);
  return encodePng(out, size, size);
}

/**
 * Visits every texel whose center a triangle covers.
 * @param {{ uvs: ArrayLike<number>, triangles: ArrayLike<number> }} atlas `uvs` with v downward.
 * @param {number} size
 * @param {(x: number, y: number, corners: number[], weights: number[]) => void} visit With the triangle's vertices and barycentric weights.
 */
export function rasterize(atlas, size, visit) {
  for (let k = 0; k < atlas.triangles.length; k += 3) {
    const corners = [0, 1, 2].map((c) => atlas.triangles[k + c] ?? 0);
    const [ax = 0, bx = 0, cx = 0] = corners.map((i) => (atlas.uvs[2 * i] ?? 0) * size - 0.5);
    const [ay = 0, by = 0, cy = 0] = corners.map((i) => (atlas.uvs[2 * i + 1] ?? 0) * size - 0.5);
    const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    if (area === 0) continue;
    for (let y = Math.max(0, Math.ceil(Math.min(ay, by, cy))); y <= Math.min(size - 1, Math.max(ay, by, cy)); ++y)
      for (let x = Math.max(0, Math.ceil(Math.min(ax, bx, cx))); x <= Math.min(size - 1, Math.max(ax, bx, cx)); ++x) {
        const b = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area;
        const c = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area;
        if (Math.min(b, c, 1 - b - c) >= -1e-9) visit(x, y, corners, [1 - b - c, b, c]);
      }
  }
}

/**
 * Fills what no triangle covers from its neighbors, so that filtering across an island's edge finds skin.
 * @param {Uint8Array} pixels RGBA; alpha 0 is uncovered.
 * @param {number} size
 */
export function dilate(pixels, size) {
  let front = Array.from({ length: size * size }, (_, i) => i).filter((i) => pixels[4 * i + 3] === 0);
  while (front.length > 0) {
    /** @type {[number, number][]} */
    const filled = [];
    /** @type {number[]} */
    const rest = [];
    for (const i of front) {
      const x = i % size;
      const from = [x > 0 ? i - 1 : -1, x < size - 1 ? i + 1 : -1, i - size, i + size].find(
        (j) => j >= 0 && j < size * size && pixels[4 * j + 3] === 255,
      );
      if (from === undefined) rest.push(i);
      else filled.push([i, from]);
    }
    if (filled.length === 0) return;
    for (const [i, from] of filled) pixels.copyWithin(4 * i, 4 * from, 4 * from + 4);
    front = rest;
  }
}
