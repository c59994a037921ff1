// What the benchmark does to meshes: welding, and splitting edges until there are as many vertices as wanted.

/** @typedef {{ positions: Float64Array, triangles: Uint32Array }} Mesh */

/**
 * One vertex for every position, and which one each became; triangles that lose their area go.
 * @param {{ positions: ArrayLike<number>, triangles: ArrayLike<number> }} mesh @returns {Mesh & { to: number[] }}
 */
export function weld(mesh) {
  /** @type {Map<string, number>} */
  const known = new Map();
  /** @type {number[]} */
  const positions = [];
  const to = Array.from({ length: mesh.positions.length / 3 }, (_, v) => {
    const point = [0, 1, 2].map((axis) => mesh.positions[3 * v + axis] ?? 0);
    const number = known.get(point.join()) ?? known.size;
    if (number === known.size) {
      known.set(point.join(), number);
      positions.push(...point);
    }
    return number;
  });
  /** @type {number[]} */
  const triangles = [];
  for (let t = 0; t < mesh.triangles.length; t += 3) {
    const [a = 0, b = 0, c = 0] = [0, 1, 2].map((corner) => to[mesh.triangles[t + corner] ?? 0] ?? 0);
    if (a !== b && b !== c && c !== a) triangles.push(a, b, c);
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles), to };
}

/**
 * Splits the longest edge in the middle, again and again, until the mesh has `count` vertices: the surface and the numbers of the vertices
 * that it had stay. Of edges of one length the older comes first.
 * @param {Mesh} mesh @param {number} count @returns {Mesh}
 */
export function splitLongest(mesh, count) {
  const had = mesh.positions.length / 3;
  if (had > count) throw new Error(`The mesh has ${had} vertices already, ${count} are wanted.`);
  const positions = Array.from(mesh.positions);
  const triangles = Array.from(mesh.triangles);
  /** Triangles at an edge. @type {Map<number, number[]>} */
  const edges = new Map();
  const heap = new Heap();
  const key = (/** @type {number} */ a, /** @type {number} */ b) => (a < b ? a * 2 ** 26 + b : b * 2 ** 26 + a);
  const at = (/** @type {number} */ i) => positions[i] ?? 0;
  /** @param {number} a @param {number} b @param {number} triangle */
  const join = (a, b, triangle) => {
    const name = key(a, b);
    const there = edges.get(name);
    if (there) {
      there.push(triangle);
      return;
    }
    edges.set(name, [triangle]);
    heap.push(Math.hypot(at(3 * a) - at(3 * b), at(3 * a + 1) - at(3 * b + 1), at(3 * a + 2) - at(3 * b + 2)), name);
  };
  for (let t = 0; t < triangles.length; t += 3)
    for (let corner = 0; corner < 3; corner++) join(triangles[t + corner] ?? 0, triangles[t + ((corner + 1) % 3)] ?? 0, t);

  for (let middle = had; middle < count; middle++) {
    const name = heap.pop();
    const [a, b] = [Math.floor(name / 2 ** 26), name % 2 ** 26];
    for (let axis = 0; axis < 3; axis++) positions.push((at(3 * a + axis) + at(3 * b + axis)) / 2);
    const sides = edges.get(name) ?? [];
    edges.delete(name);
    for (const t of sides) {
      const first =
        [0, 1, 2].find((corner) => key(triangles[t + corner] ?? 0, triangles[t + ((corner + 1) % 3)] ?? 0) === name) ?? 0;
      const [p = 0, q = 0, opposite = 0] = [0, 1, 2].map((corner) => triangles[t + ((first + corner) % 3)]);
      const other = triangles.length;
      triangles[t] = p;
      triangles[t + 1] = middle;
      triangles[t + 2] = opposite;
      triangles.push(middle, q, opposite);
      const far = edges.get(key(q, opposite)) ?? [];
      far[far.indexOf(t)] = other;
      join(p, middle, t);
      join(middle, q, other);
      join(middle, opposite, t);
      join(middle, opposite, other);
    }
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

/** Names by length, the longest first, then the least name. */
class Heap {
  /** @type {number[]} */ #lengths = [];
  /** @type {number[]} */ #names = [];

  /** @param {number} length @param {number} name */
  push(length, name) {
    let i = this.#names.push(name) - 1;
    this.#lengths.push(length);
    while (i > 0 && this.#before(i, (i - 1) >> 1)) {
      this.#swap(i, (i - 1) >> 1);
      i = (i - 1) >> 1;
    }
  }

  pop() {
    const first = this.#names[0] ?? 0;
    this.#swap(0, this.#names.length - 1);
    this.#names.pop();
    this.#lengths.pop();
    for (let i = 0; ; ) {
      let best = i;
      for (const child of [2 * i + 1, 2 * i + 2]) if (child < this.#names.length && this.#before(child, best)) best = child;
      if (best === i) return first;
      this.#swap(i, best);
      i = best;
    }
  }

  /** @param {number} i @param {number} j */
  #before(i, j) {
    const [a = 0, b = 0] = [this.#lengths[i], this.#lengths[j]];
    return a > b || (a === b && (this.#names[i] ?? 0) < (this.#names[j] ?? 0));
  }

  /** @param {number} i @param {number} j */
  #swap(i, j) {
    for (const array of [this.#lengths, this.#names]) [array[i], array[j]] = [array[j] ?? 0, array[i] ?? 0];
  }
}
