/** Lashes: MakeHuman's four strips along the lids, with texture coordinates along the lid and from root to tip. */
import { boundsOf } from '../mesh.mjs';
import { encodePng } from '../png.mjs';
import { between, noise } from './color.mjs';
import { join, partOf } from './part.mjs';

/**
 * @param {import('./source.mjs').FaceSource} source
 * @returns {import('./part.mjs').Part}
 */
export function lashPart(source) {
  const strips = /** @type {const} */ (['l', 'r']).flatMap((side) => {
    const eye = (source.groups.get(`helper-${side}-eye`) ?? []).flatMap((face) => face.v);
    const { min, max } = boundsOf(eye.flatMap((id) => [...source.positions.subarray(3 * id, 3 * id + 3)]));
    const center = min.map((low, d) => (low + (max[d] ?? 0)) / 2);
    return [`helper-${side}-eyelashes-1`, `helper-${side}-eyelashes-2`].map((group, upper) => {
      const faces = source.groups.get(group) ?? [];
      const grid = gridOf(faces);
      const at = /** @type {(id: number, d: number) => number} */ ((id, d) => source.positions[3 * id + d] ?? 0);
      const [columns, rows] = [0, 1].map((d) => Math.max(...[...grid.values()].map((place) => place[d] ?? 0)));
      const isLong = (columns ?? 0) > (rows ?? 0);
      /** @type {(id: number) => [number, number]} */
      const place = (id) => {
        const [i = 0, j = 0] = grid.get(id) ?? [];
        return isLong ? [i / (columns ?? 1), j / (rows ?? 1)] : [j / (rows ?? 1), i / (columns ?? 1)];
      };
      /** @type {(coordinate: 0 | 1, end: 0 | 1, measure: (id: number) => number) => number} */
      const mean = (coordinate, end, measure) => {
        const ids = [...grid.keys()].filter((id) => place(id)[coordinate] === end);
        return ids.reduce((sum, id) => sum + measure(id), 0) / ids.length;
      };
      // Roots lie on the eye, tips away from it; a lid starts at the nose.
      const reach = /** @type {(id: number) => number} */ ((id) => Math.hypot(...center.map((c, d) => at(id, d) - c)));
      const rootFirst = mean(1, 0, reach) < mean(1, 1, reach);
      const noseFirst = mean(0, 0, (id) => Math.abs(at(id, 0))) < mean(0, 1, (id) => Math.abs(at(id, 0)));
      const part = partOf(source, faces);
      for (const vertex of part.vertices) {
        const [along, height] = place(vertex.ids[0] ?? 0);
        vertex.u = 0.5 * (0.02 + 0.96 * (noseFirst ? along : 1 - along) + upper);
        vertex.v = 0.02 + 0.96 * (rootFirst ? height : 1 - height);
      }
      return part;
    });
  });
  return join(strips);
}

/**
 * Whole-number coordinates on a patch of quads, spread from the first one; the least of either is 0.
 * @param {import('./obj.mjs').Face[]} faces
 * @returns {Map<number, [number, number]>} By base vertex.
 */
function gridOf(faces) {
  /** @type {Map<number, [number, number]>} */
  const grid = new Map();
  const [a = 0, b = 0, c = 0, d = 0] = faces[0]?.v ?? [];
  grid.set(a, [0, 0]).set(b, [1, 0]).set(c, [1, 1]).set(d, [0, 1]);
  let waiting = faces.slice(1);
  while (waiting.length > 0) {
    const later = waiting.filter(({ v }) => {
      const known = v.findIndex((id, k) => grid.has(id) && grid.has(v[(k + 1) % 4] ?? -1));
      if (known < 0) return true;
      const [p = 0, q = 0, r = 0, s = 0] = [0, 1, 2, 3].map((k) => v[(known + k) % 4] ?? 0);
      const [px, py] = grid.get(p) ?? [0, 0];
      const [qx, qy] = grid.get(q) ?? [0, 0];
      // All quads run round the same way: the other side lies a quarter turn to the left of p -> q.
      const [nx, ny] = [-(qy - py), qx - px];
      grid.set(r, [qx + nx, qy + ny]).set(s, [px + nx, py + ny]);
      return false;
    });
    if (later.length === waiting.length) throw new Error('A lash strip is not one patch of quads.');
    waiting = later;
  }
  const low = [0, 1].map((axis) => Math.min(...[...grid.values()].map((place) => place[axis] ?? 0)));
  for (const [id, [i, j]] of grid) grid.set(id, [i - (low[0] ?? 0), j - (low[1] ?? 0)]);
  return grid;
}

/**
 * Strokes that taper from root (below) to tip. The left half of the image is for lower lids, the right for upper ones.
 * @param {number} size
 * @returns {Uint8Array} A PNG with alpha.
 */
export function paintLashes(size) {
  const pixels = new Uint8Array(4 * size * size);
  for (let y = 0; y < size; ++y)
    for (let x = 0; x < size; ++x) {
      const upper = x >= size / 2;
      const along = ((2 * (x + 0.5)) / size) % 1;
      const height = 1 - (y + 0.5) / size;
      const count = upper ? 30 : 22;
      const curl = along - (along - 0.3) * 0.1 * height;
      const cell = Math.floor(curl * count);
      const reach =
        (upper ? 0.85 : 0.5) * (0.7 + 0.3 * noise(cell * 7.3, 1)) * between(0, 0.25, along) * between(1.02, 0.93, along);
      const within = Math.abs(curl * count - cell - 0.5);
      const width = 0.44 * (1 - height / Math.max(0.05, reach));
      const stroke = between(width + 0.12, width - 0.12, within) * between(reach, reach * 0.7, height);
      const root = upper ? 0.95 * between(0.3, 0.12, height) : 0.3 * between(0.14, 0.04, height);
      pixels.set(
        [14, 9, 8, Math.round(255 * Math.min(1, Math.max(root * between(0, 0.08, along), (upper ? 1 : 0.6) * stroke)))],
        4 * (y * size + x),
      );
    }
  return encodePng(pixels, size, size, true);
}
