// What a closed triangle mesh is like.

/** @typedef {{ positions: ArrayLike<number>, triangles: ArrayLike<number> }} Mesh */

/**
 * `unmatched`: edges that do not lie in exactly two triangles, in opposite ways. `genus` counts the handles of one closed surface.
 * @param {Mesh} mesh
 */
export function facts({ positions, triangles }) {
  const count = positions.length / 3;
  /** @type {Map<number, number>} */
  const directed = new Map();
  let [volume, smallestAngle, smallestArea] = [0, 180, Number.POSITIVE_INFINITY];
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [0, 1, 2].map((i) => triangles[t + i] ?? 0);
    const places = corners.map((v) => placeOf(positions, v));
    for (const i of [0, 1, 2]) {
      const edge = (corners[i] ?? 0) * count + (corners[(i + 1) % 3] ?? 0);
      directed.set(edge, (directed.get(edge) ?? 0) + 1);
      const [p = [], q = [], r = []] = [places[i], places[(i + 1) % 3], places[(i + 2) % 3]];
      const n = cross(minus(q, p), minus(r, p));
      const twice = Math.hypot(...n);
      smallestArea = Math.min(smallestArea, twice / 2);
      smallestAngle = Math.min(smallestAngle, (Math.atan2(twice, dot(minus(q, p), minus(r, p))) * 180) / Math.PI);
      if (i === 0) volume += dot(p, n) / 6;
    }
  }
  const back = (/** @type {number} */ edge) => (edge % count) * count + Math.floor(edge / count);
  const unmatched = [...directed].filter(([edge, times]) => times !== 1 || directed.get(back(edge)) !== 1).length;
  const genus = 1 - (count - directed.size / 2 + triangles.length / 3) / 2;
  return {
    unmatched,
    genus,
    parts: parts(
      triangles,
      Array.from({ length: count }, (_, v) => v),
    ),
    volume,
    smallestAngle,
    smallestArea,
  };
}

/** How many connected parts some of a mesh's vertices make. @param {ArrayLike<number>} triangles @param {readonly number[]} vertices */
export function parts(triangles, vertices) {
  const leader = new Map(vertices.map((v) => [v, v]));
  const find = (/** @type {number} */ v) => {
    let at = v;
    for (let up = leader.get(at) ?? at; up !== at; up = leader.get(at) ?? at) at = up;
    leader.set(v, at);
    return at;
  };
  for (let i = 0; i < triangles.length; i++) {
    const [a, b] = [triangles[i] ?? 0, triangles[i % 3 === 2 ? i - 2 : i + 1] ?? 0];
    if (leader.has(a) && leader.has(b)) leader.set(find(a), find(b));
  }
  return vertices.filter((v) => find(v) === v).length;
}

/** @param {Mesh} mesh @param {readonly number[]} place */
export function nearestVertex({ positions }, place) {
  let [best, nearest] = [0, Number.POSITIVE_INFINITY];
  for (let v = 0; v < positions.length / 3; v++) {
    const distance = Math.hypot(...minus(placeOf(positions, v), place));
    if (distance < nearest) [best, nearest] = [v, distance];
  }
  return best;
}

/** @param {ArrayLike<number>} positions @param {number} v */
const placeOf = (positions, v) => [positions[3 * v] ?? 0, positions[3 * v + 1] ?? 0, positions[3 * v + 2] ?? 0];
/** @param {readonly number[]} a @param {readonly number[]} b */
const minus = (a, b) => a.map((value, d) => value - (b[d] ?? 0));
/** @param {readonly number[]} a @param {readonly number[]} b */
const dot = (a, b) => a.reduce((sum, value, d) => sum + value * (b[d] ?? 0), 0);
/** @param {readonly number[]} a @param {readonly number[]} b */
const cross = ([ax = 0, ay = 0, az = 0], [bx = 0, by = 0, bz = 0]) => [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
