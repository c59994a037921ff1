// Shapes made by formulas, as stand-ins for the models of the paper that are not public.

/** @typedef {import('./mesh.mjs').Mesh} Mesh */
/** @typedef {[number, number, number]} Vec3 */

/**
 * A box from the origin, every cell cut into six tetrahedra along its main diagonal (Kuhn), and its surface as triangles between the same
 * vertices.
 * @param {Vec3} size @param {Vec3} cells @returns {Mesh & { tetrahedra: Uint32Array }}
 */
export function kuhnGrid(size, cells) {
  const [nx, ny, nz] = cells;
  const number = (/** @type {number[]} */ [i = 0, j = 0, k = 0]) => i + (nx + 1) * (j + (ny + 1) * k);
  const positions = new Float64Array(3 * (nx + 1) * (ny + 1) * (nz + 1));
  /** @type {number[]} */
  const tetrahedra = [];
  const orders = [
    [0, 1, 2],
    [1, 2, 0],
    [2, 0, 1],
    [0, 2, 1],
    [1, 0, 2],
    [2, 1, 0],
  ];
  for (let k = 0; k <= nz; k++)
    for (let j = 0; j <= ny; j++)
      for (let i = 0; i <= nx; i++) {
        const at = [i, j, k];
        positions.set(
          at.map((step, axis) => ((size[axis] ?? 1) * step) / (cells[axis] ?? 1)),
          3 * number(at),
        );
        if (i === nx || j === ny || k === nz) continue;
        orders.forEach((order, o) => {
          const corner = [...at];
          const path = [number(corner)];
          for (const axis of order) {
            corner[axis] = (corner[axis] ?? 0) + 1;
            path.push(number(corner));
          }
          const [a = 0, b = 0, c = 0, d = 0] = path;
          // Odd orders run the other way round.
          tetrahedra.push(...(o < 3 ? [a, b, c, d] : [a, c, b, d]));
        });
      }
  return { positions, triangles: outside(tetrahedra), tetrahedra: Uint32Array.from(tetrahedra) };
}

/** The faces that only one tetrahedron has, seen from outside. @param {number[]} tetrahedra */
function outside(tetrahedra) {
  /** @type {Map<string, number[]>} */
  const faces = new Map();
  for (let t = 0; t < tetrahedra.length; t += 4) {
    const [a = 0, b = 0, c = 0, d = 0] = tetrahedra.slice(t, t + 4);
    for (const face of [
      [a, c, b],
      [a, b, d],
      [a, d, c],
      [b, c, d],
    ]) {
      const name = face.toSorted((x, y) => x - y).join();
      if (!faces.delete(name)) faces.set(name, face);
    }
  }
  return Uint32Array.from([...faces.values()].flat());
}

/** The surface of a box alone. @param {Vec3} size @param {Vec3} cells @returns {Mesh} */
export function box(size, cells) {
  const { positions, triangles } = kuhnGrid(size, cells);
  const used = [...new Set(triangles)].toSorted((a, b) => a - b);
  const to = new Map(used.map((v, i) => [v, i]));
  return {
    positions: Float64Array.from(used.flatMap((v) => [...positions.subarray(3 * v, 3 * v + 3)])),
    triangles: triangles.map((v) => to.get(v) ?? 0),
  };
}

/**
 * A closed tube about a curve in a plane: a pole at either end, rings between them.
 * @param {(t: number) => Vec3} curve For t from 0 to 1.
 * @param {(t: number) => number} radius @param {Vec3} side The plane's normal. @param {number} rings @param {number} sides
 * @returns {Mesh}
 */
export function tube(curve, radius, side, rings, sides) {
  /** @type {number[]} */
  const positions = [...curve(0)];
  for (let ring = 1; ring < rings; ring++) {
    const t = ring / rings;
    const center = curve(t);
    const [from, to] = [curve(t - 1e-4), curve(t + 1e-4)];
    const tangent = unit([to[0] - from[0], to[1] - from[1], to[2] - from[2]]);
    const up = cross(tangent, side);
    for (let s = 0; s < sides; s++) {
      const [c, d] = [radius(t) * Math.cos((2 * Math.PI * s) / sides), radius(t) * Math.sin((2 * Math.PI * s) / sides)];
      for (let axis = 0; axis < 3; axis++) positions.push((center[axis] ?? 0) + c * (side[axis] ?? 0) + d * (up[axis] ?? 0));
    }
  }
  positions.push(...curve(1));
  const end = positions.length / 3 - 1;
  /** @type {number[]} */
  const triangles = [];
  const at = (/** @type {number} */ ring, /** @type {number} */ s) =>
    ring === 0 ? 0 : ring === rings ? end : 1 + (ring - 1) * sides + (s % sides);
  for (let ring = 0; ring < rings; ring++)
    for (let s = 0; s < sides; s++) {
      const [a, b, c, d] = [at(ring, s), at(ring, s + 1), at(ring + 1, s + 1), at(ring + 1, s)];
      if (ring > 0) triangles.push(a, b, c);
      if (ring < rings - 1) triangles.push(a, c, d);
    }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

/** @param {Vec3} middle @param {Vec3} half @returns {Mesh} */
function ellipsoid(middle, half) {
  const ball = tube(
    (t) => [0, -Math.cos(Math.PI * t), 0],
    (t) => Math.sin(Math.PI * t),
    [0, 0, 1],
    20,
    32,
  );
  return { ...ball, positions: ball.positions.map((x, i) => (middle[i % 3] ?? 0) + x * (half[i % 3] ?? 1)) };
}

/** One mesh of several. @param {Mesh[]} parts @returns {Mesh} */
function together(parts) {
  /** @type {number[]} */
  const positions = [];
  /** @type {number[]} */
  const triangles = [];
  for (const part of parts) {
    const first = positions.length / 3;
    for (const x of part.positions) positions.push(x);
    for (const v of part.triangles) triangles.push(first + v);
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

/** Blunt at both ends. @param {number} t */
const blunt = (t) => Math.min(1, 4 * Math.sqrt(t * (1 - t)));

export const bar = () => box([10, 2, 2], [91, 18, 18]);

/** A bar along two waves. @returns {Mesh} */
export function sinusBar() {
  const { positions, triangles } = box([10, 1, 1], [100, 10, 10]);
  for (let i = 0; i < positions.length; i += 3)
    positions[i + 1] = (positions[i + 1] ?? 0) + 0.8 * Math.sin((4 * Math.PI * (positions[i] ?? 0)) / 10);
  return { positions, triangles };
}

export const snake = () =>
  tube(
    (t) => [8 * t, 0, 0.8 * Math.sin(3 * Math.PI * t)],
    (t) => 0.3 * blunt(t) * (1 - 0.5 * t),
    [0, 1, 0],
    120,
    20,
  );

export const crescent = () =>
  tube(
    (t) => [Math.cos(Math.PI * (1.4 * t - 0.2)), Math.sin(Math.PI * (1.4 * t - 0.2)), 0],
    (t) => 0.35 * Math.sin(Math.PI * t),
    [0, 0, 1],
    60,
    20,
  );

/** Two flat shells that almost touch, on a hinge: three components. */
export const shells = () =>
  together([
    ellipsoid([0, 0.17, 0], [1, 0.16, 1]),
    ellipsoid([0, -0.17, 0], [1, 0.16, 1]),
    tube(
      (t) => [-0.85, 0, 0.5 * (2 * t - 1)],
      (t) => 0.22 * blunt(t),
      [0, 1, 0],
      20,
      24,
    ),
  ]);

/** A ball with arms that swing down and up again, each a component. @param {number} arms */
export const ballWithArms = (arms) =>
  together([
    ellipsoid([0, 0, 0], [0.8, 0.9, 0.8]),
    ...Array.from({ length: arms }, (_, arm) => {
      const angle = (2 * Math.PI * arm) / arms;
      const [x, z] = [Math.cos(angle), Math.sin(angle)];
      return tube(
        (t) => [x * (0.4 + 2.6 * t), -0.4 - 0.5 * Math.sin(1.5 * Math.PI * t), z * (0.4 + 2.6 * t)],
        (t) => 0.24 * blunt(t) * (1 - 0.6 * t),
        [-z, 0, x],
        60,
        16,
      );
    }),
  ]);

/** @param {Vec3} v @returns {Vec3} */
function unit([x, y, z]) {
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
}

/** @param {Vec3} a @param {Vec3} b @returns {Vec3} */
function cross([a, b, c], [x, y, z]) {
  return [b * z - c * y, c * x - a * z, a * y - b * x];
}
