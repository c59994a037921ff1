// Even triangles on a smooth closed surface: long edges are split, short ones collapsed, edges turned towards six at each vertex, and
// vertices moved along the surface to the middle of their neighbors (Botsch and Kobbelt 2004). No step changes how the surface hangs together.

/** @typedef {[number, number, number]} Point */

/**
 * @typedef {object} Surface
 * @property {(p: Point) => Point} onto the surface's place near p
 * @property {(p: Point) => Point} normal unit, outwards
 * @property {(p: Point) => number} size how long edges are to be at p
 */

/**
 * @param {{ positions: ArrayLike<number>, triangles: ArrayLike<number> }} mesh closed and manifold
 * @param {Surface} surface
 * @param {number} [rounds]
 * @returns {{ positions: Float64Array, triangles: Uint32Array }} vertices and triangles renumbered
 */
export function remesh(mesh, surface, rounds = 6) {
  const work = new Working(mesh, surface);
  for (let round = 0; round < rounds; round++) {
    work.split();
    work.collapse();
    work.turn();
    work.smooth();
  }
  for (let round = 0; round < 4; round++) {
    work.turnToDelaunay();
    work.smooth();
  }
  work.turnToDelaunay();
  return work.packed();
}

const minus = (/** @type {Point} */ a, /** @type {Point} */ b) => /** @type {Point} */ ([a[0] - b[0], a[1] - b[1], a[2] - b[2]]);
const middle = (/** @type {Point} */ a, /** @type {Point} */ b) =>
  /** @type {Point} */ ([(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2]);
const dot = (/** @type {Point} */ a, /** @type {Point} */ b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (/** @type {Point} */ a, /** @type {Point} */ b) =>
  /** @type {Point} */ ([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]);
const distance = (/** @type {Point} */ a, /** @type {Point} */ b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
const normalOf = (/** @type {Point} */ a, /** @type {Point} */ b, /** @type {Point} */ c) => cross(minus(b, a), minus(c, a));

/** Least cosine between a triangle's normal and the surface's that a step may make. */
const LEANING = 0.3;

class Working {
  /** @param {{ positions: ArrayLike<number>, triangles: ArrayLike<number> }} mesh @param {Surface} surface */
  constructor({ positions, triangles }, surface) {
    this.surface = surface;
    /** @type {Point[]} */
    this.at = Array.from({ length: positions.length / 3 }, (_, v) =>
      surface.onto([positions[3 * v] ?? 0, positions[3 * v + 1] ?? 0, positions[3 * v + 2] ?? 0]),
    );
    /** How long edges are to be at each vertex, and the way outwards there: asked for once, since fields are slow. */
    this.size = this.at.map(surface.size);
    this.out = this.at.map(surface.normal);
    /** Triangles around each vertex, as three vertices from that one on; a vertex that is gone has none. @type {Point[][]} */
    this.fans = this.at.map(() => []);
    for (let t = 0; t < triangles.length; t += 3) {
      this.add([triangles[t] ?? 0, triangles[t + 1] ?? 0, triangles[t + 2] ?? 0]);
    }
  }

  /** @param {number} v @returns {Point} */
  p(v) {
    return /** @type {Point} */ (this.at[v]);
  }

  /** @param {number} v @returns {Point[]} */
  fan(v) {
    return /** @type {Point[]} */ (this.fans[v]);
  }

  /** @param {Point} triangle */
  add(triangle) {
    for (const v of triangle) this.fan(v).push(triangle);
  }

  /** @param {Point} triangle */
  remove(triangle) {
    for (const v of triangle) this.fan(v).splice(this.fan(v).indexOf(triangle), 1);
  }

  /** The triangle in which b follows a. @param {number} a @param {number} b */
  left(a, b) {
    return this.fan(a).find(([i, j, k]) => (i === a && j === b) || (j === a && k === b) || (k === a && i === b));
  }

  /** @param {number} a @returns {number[]} */
  neighbors(a) {
    return this.fan(a).map((triangle) => /** @type {number} */ (triangle[(triangle.indexOf(a) + 1) % 3]));
  }

  /** Every edge once, as it is now. @returns {[number, number][]} */
  edges() {
    return this.fans.flatMap((_, a) =>
      this.neighbors(a)
        .filter((b) => a < b)
        .map((b) => /** @type {[number, number]} */ ([a, b])),
    );
  }

  /** An edge's length in what it is to be. @param {number} a @param {number} b */
  relative(a, b) {
    return (2 * distance(this.p(a), this.p(b))) / ((this.size[a] ?? 0) + (this.size[b] ?? 0));
  }

  /** The vertices across an edge. @param {number} a @param {number} b */
  across(a, b) {
    const [left, right] = [this.left(a, b), this.left(b, a)];
    if (!left || !right) return undefined;
    const third = (/** @type {Point} */ triangle) => triangle[0] + triangle[1] + triangle[2] - a - b;
    return { left, right, c: third(left), d: third(right) };
  }

  split() {
    const long = this.edges().filter(([a, b]) => this.relative(a, b) > 4 / 3);
    for (const [a, b] of long.sort((e, f) => this.relative(...f) - this.relative(...e))) {
      const pair = this.across(a, b);
      if (!pair || this.relative(a, b) <= 4 / 3) continue;
      const v = this.at.length;
      this.at.push(this.surface.onto(middle(this.p(a), this.p(b))));
      this.size.push(this.surface.size(this.p(v)));
      this.out.push(this.surface.normal(this.p(v)));
      this.fans.push([]);
      const { left, right, c, d } = pair;
      this.remove(left);
      this.remove(right);
      for (const triangle of [
        [a, v, c],
        [v, b, c],
        [b, v, d],
        [v, a, d],
      ])
        this.add(/** @type {Point} */ (triangle));
    }
  }

  collapse() {
    const short = this.edges().filter(([a, b]) => this.relative(a, b) < 4 / 5);
    for (const [a, b] of short.sort((e, f) => this.relative(...e) - this.relative(...f))) {
      const pair = this.across(a, b);
      if (!pair || this.relative(a, b) >= 4 / 5) continue;
      // Two vertices may become one where they have no neighbors in common but the two across: else the surface would pinch.
      const near = new Set(this.neighbors(a));
      const others = this.neighbors(b);
      if (others.filter((v) => near.has(v)).length !== 2 || near.size + others.length < 9) continue;
      if (this.neighbors(pair.c).length < 4 || this.neighbors(pair.d).length < 4) continue;
      const place = this.surface.onto(middle(this.p(a), this.p(b)));
      const size = this.surface.size(place);
      const kept = [...this.fan(a), ...this.fan(b)].filter((t) => t !== pair.left && t !== pair.right);
      const long = [...near, ...others].some(
        (v) => v !== a && v !== b && (2 * distance(place, this.p(v))) / (size + (this.size[v] ?? 0)) > 4 / 3,
      );
      if (long || !kept.every((t) => this.faces(t, [a, b], place))) continue;
      this.remove(pair.left);
      this.remove(pair.right);
      this.at[a] = place;
      this.size[a] = size;
      this.out[a] = this.surface.normal(place);
      for (const triangle of [...this.fan(b)]) {
        this.remove(triangle);
        this.add(/** @type {Point} */ (triangle.map((v) => (v === b ? a : v))));
      }
    }
  }

  /** A triangle's corners with some vertices at another place. @param {Point} triangle @param {number[]} moved @param {Point} place */
  corners(triangle, moved, place) {
    return /** @type {[Point, Point, Point]} */ (triangle.map((v) => (moved.includes(v) ? place : this.p(v))));
  }

  /** Whether a triangle, with some vertices at another place, looks the way that the surface does. @param {Point} triangle @param {number[]} [moved] @param {Point} [place] */
  faces(triangle, moved = [], place = [0, 0, 0]) {
    const n = normalOf(...this.corners(triangle, moved, place));
    const length = Math.hypot(...n);
    return length > 0 && triangle.every((v) => dot(n, /** @type {Point} */ (this.out[v])) > LEANING * length);
  }

  /** Turns edges where `better` says so. @param {(a: number, b: number, c: number, d: number) => boolean} better */
  turnWhere(better) {
    for (const [a, b] of this.edges()) {
      const pair = this.across(a, b);
      if (!pair) continue;
      const { left, right, c, d } = pair;
      if (!better(a, b, c, d) || this.left(c, d) || this.left(d, c)) continue;
      if (this.fan(a).length < 4 || this.fan(b).length < 4) continue;
      if (!this.faces([a, d, c]) || !this.faces([d, b, c])) continue;
      this.remove(left);
      this.remove(right);
      this.add([a, d, c]);
      this.add([d, b, c]);
    }
  }

  turn() {
    const off = (/** @type {number} */ v, /** @type {number} */ change) => (this.fan(v).length + change - 6) ** 2;
    this.turnWhere((a, b, c, d) => off(a, -1) + off(b, -1) + off(c, 1) + off(d, 1) < off(a, 0) + off(b, 0) + off(c, 0) + off(d, 0));
  }

  turnToDelaunay() {
    const angle = (/** @type {number} */ v, /** @type {number} */ a, /** @type {number} */ b) => {
      const [u, w] = [minus(this.p(a), this.p(v)), minus(this.p(b), this.p(v))];
      return Math.atan2(Math.hypot(...cross(u, w)), dot(u, w));
    };
    this.turnWhere((a, b, c, d) => angle(c, a, b) + angle(d, a, b) > Math.PI + 1e-6);
  }

  smooth() {
    for (let v = 0; v < this.at.length; v++) {
      if (this.fan(v).length === 0) continue;
      // Triangles weigh by their area in what it is to be, so that vertices go to where they are missing.
      const sum = [0, 0, 0];
      let total = 0;
      for (const triangle of this.fan(v)) {
        const [a, b, c] = this.corners(triangle, [], [0, 0, 0]);
        const size = triangle.reduce((s, i) => s + (this.size[i] ?? 0), 0);
        const weight = Math.hypot(...normalOf(a, b, c)) / (size * size);
        total += weight;
        for (const d of [0, 1, 2]) sum[d] = (sum[d] ?? 0) + (weight * ((a[d] ?? 0) + (b[d] ?? 0) + (c[d] ?? 0))) / 3;
      }
      const goal = /** @type {Point} */ (sum.map((value) => value / total));
      const normal = /** @type {Point} */ (this.out[v]);
      const step = minus(goal, this.p(v));
      const off = dot(step, normal);
      const to = /** @type {Point} */ (this.p(v).map((value, d) => value + (step[d] ?? 0) - off * (normal[d] ?? 0)));
      const place = this.surface.onto(to);
      if (!this.fan(v).every((triangle) => this.faces(triangle, [v], place))) continue;
      this.at[v] = place;
      this.size[v] = this.surface.size(place);
      this.out[v] = this.surface.normal(place);
    }
  }

  packed() {
    const number = new Map();
    this.fans.forEach((fan, v) => {
      if (fan.length > 0) number.set(v, number.size);
    });
    const triangles = this.fans.flatMap((fan, v) => fan.filter((triangle) => triangle[0] === v));
    return {
      positions: Float64Array.from([...number.keys()].flatMap((v) => this.p(v))),
      triangles: Uint32Array.from(triangles.flat(), (v) => number.get(v)),
    };
  }
}
