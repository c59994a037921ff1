// A triangle mesh of where a field in space is zero. manifold-3d's marching tetrahedra on a fine grid say how the surface hangs together,
// always closed and manifold; their slivers, and how many they are, are mended by remesh(), which keeps to the field's own surface.
import Module from 'manifold-3d';
import { remesh } from './remesh.mjs';

/** @typedef {import('./remesh.mjs').Point} Point */

/** The parts of a `Solid` of web/models/solid-field.ts that are needed here.
 * @typedef {object} Solid
 * @property {(x: number, y: number, z: number) => number} distance
 * @property {(x: number, y: number, z: number) => number} radius
 * @property {readonly [number, number, number]} low
 * @property {readonly [number, number, number]} high
 * @property {number} thinnest the least radius of all limbs
 */

/** @typedef {{ positions: Float32Array, triangles: Uint32Array }} Grid */

/** Edges are at most this long in the radius of the limb that they are on: about six around it. */
const AROUND = 1;

/** The grid's edges in the radius of the thinnest limb. */
const GRID = 1.1;

/** An even mesh's vertices have this area in squares of the length of its edges: measured, since remesh() makes edges a bit short of asked. */
const AREA_OF_VERTEX = 0.89;

/**
 * @param {Solid} solid
 * @param {{ vertices: number }} options about how many vertices to make
 * @returns {Promise<{ positions: Float32Array, triangles: Uint32Array }>} The same every time, to the bit.
 */
export async function meshSolid(solid, { vertices }) {
  const grid = await marched(solid);
  const surface = surfaceOf(solid);
  const thick = (/** @type {Point} */ p) => AROUND * solid.radius(...p);
  const most = lengthFor(grid, thick, vertices);
  const { positions, triangles } = remesh(grid, { ...surface, size: (p) => Math.min(most, thick(p)) });
  return { positions: Float32Array.from(positions), triangles };
}

/** @param {Solid} solid */
async function marched(solid) {
  const wasm = await Module();
  wasm.setup();
  const finest = GRID * solid.thinnest;
  const margin = 2 * finest;
  const box = {
    min: /** @type {Point} */ (solid.low.map((value) => value - margin)),
    max: /** @type {Point} */ (solid.high.map((value) => value + margin)),
  };
  const body = wasm.Manifold.levelSet(insideOf(solid, 8 * finest), box, finest);
  const { numProp, vertProperties, triVerts, mergeFromVert } = body.getMesh();
  body.delete();
  if (numProp !== 3 || mergeFromVert.length > 0) throw new Error('Manifold gave vertices with more than places.');
  return { positions: vertProperties, triangles: triVerts };
}

/**
 * What Manifold wants: positive inside. One value stands for all of a block that is far from the surface, where the sign alone counts.
 * @param {Solid} solid @param {number} block
 */
function insideOf({ distance }, block) {
  /** @type {Map<string, number>} */
  const middles = new Map();
  return (/** @type {Point} */ [x, y, z]) => {
    const [i, j, k] = [Math.floor(x / block), Math.floor(y / block), Math.floor(z / block)];
    const key = `${i} ${j} ${k}`;
    const middle = middles.get(key) ?? distance((i + 0.5) * block, (j + 0.5) * block, (k + 0.5) * block);
    middles.set(key, middle);
    return Math.abs(middle) > 1.2 * block ? -middle : -distance(x, y, z);
  };
}

/** @param {Solid} solid @returns {Omit<import('./remesh.mjs').Surface, 'size'>} */
function surfaceOf({ distance, thinnest }) {
  const step = thinnest / 100;
  const gradient = (/** @type {Point} */ [x, y, z]) =>
    /** @type {Point} */ ([
      (distance(x + step, y, z) - distance(x - step, y, z)) / (2 * step),
      (distance(x, y + step, z) - distance(x, y - step, z)) / (2 * step),
      (distance(x, y, z + step) - distance(x, y, z - step)) / (2 * step),
    ]);
  return {
    normal: (p) => {
      const g = gradient(p);
      const length = Math.hypot(...g) || 1;
      return /** @type {Point} */ (g.map((value) => value / length));
    },
    // Newton's method, each step along the gradient where it is; no step is longer than a limb is thick, so that none lands on another limb.
    onto: (p) => {
      let at = p;
      for (let k = 0; k < 6; k++) {
        const value = distance(...at);
        if (Math.abs(value) < 1e-6) break;
        const g = gradient(at);
        const squared = Math.max(dotted(g), 0.04);
        const length = Math.max(-thinnest, Math.min(thinnest, value)) / squared;
        at = /** @type {Point} */ ([at[0] - length * g[0], at[1] - length * g[1], at[2] - length * g[2]]);
      }
      return at;
    },
  };
}

const dotted = (/** @type {Point} */ [x, y, z]) => x * x + y * y + z * z;

/** The length of edges that gives so many vertices. @param {Grid} grid @param {(p: Point) => number} thick @param {number} vertices */
function lengthFor({ positions, triangles }, thick, vertices) {
  /** @type {[area: number, thick: number][]} */
  const pieces = [];
  const at = (/** @type {number} */ v) => /** @type {Point} */ ([...positions.subarray(3 * v, 3 * v + 3)]);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [at(triangles[t] ?? 0), at(triangles[t + 1] ?? 0), at(triangles[t + 2] ?? 0)];
    const [ux, uy, uz, vx, vy, vz] = [b[0] - a[0], b[1] - a[1], b[2] - a[2], c[0] - a[0], c[1] - a[1], c[2] - a[2]];
    pieces.push([Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2, thick(a)]);
  }
  const count = (/** @type {number} */ most) =>
    pieces.reduce((sum, [area, thick]) => sum + area / (AREA_OF_VERTEX * Math.min(most, thick) ** 2), 0);
  let [low, high] = [1e-4, 10];
  for (let k = 0; k < 50; k++) {
    const length = Math.sqrt(low * high);
    if (count(length) > vertices) low = length;
    else high = length;
  }
  return high;
}
