/**
 * Ambient occlusion by casting rays from every vertex: which part of the light from all around reaches it.
 * Triangles are sorted into a grid of cells; rays are short, so few cells are visited.
 */

const RAYS = 48;
const REACH = 0.6;
const CELL = 0.12;
/** Rays start this far off the surface, so that they do not meet the triangles they start from. */
const BIAS = 0.008;

/**
 * @param {{ positions: Float64Array, normals: Float64Array, triangles: number[] }} surface Where light is wanted.
 * @param {{ positions: Float64Array, triangles: number[] }[]} blockers What is in the way.
 * @returns {Float64Array} One a vertex, 0 (dark) to 1.
 */
export function ambientLight(surface, blockers) {
  /** @type {Map<number, number[][]>} */
  const grid = new Map();
  const cell = /** @type {(x: number) => number} */ ((x) => Math.floor(x / CELL) + 512);
  const keyOf = /** @type {(i: number, j: number, k: number) => number} */ ((i, j, k) => (i * 1024 + j) * 1024 + k);
  for (const { positions, triangles } of blockers)
    for (let t = 0; t < triangles.length; t += 3) {
      const corners = [0, 1, 2].flatMap((c) => [
        ...positions.subarray(3 * (triangles[t + c] ?? 0), 3 * (triangles[t + c] ?? 0) + 3),
      ]);
      const range = [0, 1, 2].map((d) => [
        cell(Math.min(corners[d] ?? 0, corners[d + 3] ?? 0, corners[d + 6] ?? 0)),
        cell(Math.max(corners[d] ?? 0, corners[d + 3] ?? 0, corners[d + 6] ?? 0)),
      ]);
      const [[i0 = 0, i1 = 0] = [], [j0 = 0, j1 = 0] = [], [k0 = 0, k1 = 0] = []] = range;
      for (let i = i0; i <= i1; ++i)
        for (let j = j0; j <= j1; ++j)
          for (let k = k0; k <= k1; ++k) {
            const key = keyOf(i, j, k);
            const list = grid.get(key);
            if (list) list.push(corners);
            else grid.set(key, [corners]);
          }
    }

  const directions = Array.from({ length: RAYS }, (_, i) => {
    // A Fibonacci lattice of the hemisphere, denser towards the pole as the cosine law asks.
    const radius = Math.sqrt((i + 0.5) / RAYS);
    const turn = i * 2.399963229728653;
    return [radius * Math.cos(turn), radius * Math.sin(turn), Math.sqrt(1 - radius * radius)];
  });
  const count = surface.positions.length / 3;
  const light = new Float64Array(count);
  for (let v = 0; v < count; ++v) {
    const n = [...surface.normals.subarray(3 * v, 3 * v + 3)];
    const [nx = 0, ny = 0, nz = 0] = n;
    const origin = [...surface.positions.subarray(3 * v, 3 * v + 3)].map((x, d) => x + BIAS * (n[d] ?? 0));
    // A frame about the normal (Duff et al. 2017).
    const sign = nz >= 0 ? 1 : -1;
    const a = -1 / (sign + nz);
    const b = nx * ny * a;
    const tangent = [1 + sign * nx * nx * a, sign * b, -sign * nx];
    const bitangent = [b, sign + ny * ny * a, -ny];
    let sum = 0;
    for (const [dx = 0, dy = 0, dz = 0] of directions) {
      const ray = n.map((value, d) => dx * (tangent[d] ?? 0) + dy * (bitangent[d] ?? 0) + dz * value);
      const hit = firstHit(origin, ray);
      // What blocks from afar darkens less.
      sum += hit === null ? 1 : (hit / REACH) ** 1.2;
    }
    light[v] = sum / RAYS;
  }
  return light;

  /**
   * @param {number[]} origin
   * @param {number[]} ray
   * @returns {number | null}
   */
  function firstHit(origin, ray) {
    const [ox = 0, oy = 0, oz = 0] = origin;
    const [rx = 0, ry = 0, rz = 0] = ray;
    let previous = -1;
    for (let s = 0; s <= REACH; s += CELL / 3) {
      const key = keyOf(cell(ox + s * rx), cell(oy + s * ry), cell(oz + s * rz));
      if (key === previous) continue;
      previous = key;
      let nearest = Number.POSITIVE_INFINITY;
      for (const triangle of grid.get(key) ?? []) nearest = Math.min(nearest, intersect(triangle, ox, oy, oz, rx, ry, rz));
      if (nearest < REACH) return nearest;
    }
    return null;
  }
}

/**
 * Möller and Trumbore's test.
 * @param {number[]} t Nine coordinates.
 * @param {number} ox
 * @param {number} oy
 * @param {number} oz
 * @param {number} rx
 * @param {number} ry
 * @param {number} rz
 * @returns {number} The distance, or infinity.
 */
function intersect(t, ox, oy, oz, rx, ry, rz) {
  const [ax = 0, ay = 0, az = 0, bx = 0, by = 0, bz = 0, cx = 0, cy = 0, cz = 0] = t;
  const [ux, uy, uz] = [bx - ax, by - ay, bz - az];
  const [vx, vy, vz] = [cx - ax, cy - ay, cz - az];
  const [px, py, pz] = [ry * vz - rz * vy, rz * vx - rx * vz, rx * vy - ry * vx];
  const determinant = ux * px + uy * py + uz * pz;
  if (Math.abs(determinant) < 1e-12) return Number.POSITIVE_INFINITY;
  const [sx, sy, sz] = [ox - ax, oy - ay, oz - az];
  const u = (sx * px + sy * py + sz * pz) / determinant;
  if (u < 0 || u > 1) return Number.POSITIVE_INFINITY;
  const [qx, qy, qz] = [sy * uz - sz * uy, sz * ux - sx * uz, sx * uy - sy * ux];
  const v = (rx * qx + ry * qy + rz * qz) / determinant;
  if (v < 0 || u + v > 1) return Number.POSITIVE_INFINITY;
  const distance = (vx * qx + vy * qy + vz * qz) / determinant;
  return distance > 0 ? distance : Number.POSITIVE_INFINITY;
}
