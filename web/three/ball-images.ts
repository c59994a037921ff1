/** Balls and lines under a deformation of space: matrices that draw them as copies of one ball and one bar, from the images of a few points. */
import type { BodyData } from '../../wasm/ts/runtime.ts';

type Numbers = ArrayLike<number>;
type Writable = Float32Array | Float64Array;

/** Numbers of a matrix, column by column, as three.js has them; and of the ends of a ball's three diameters. */
const MATRIX = 16;
const ENDS = 18;
const MIDDLE = [0, 0, 0] as const;

/**
 * Ends of three diameters at right angles of each of a body's spheres, model units: 18 numbers a sphere. The first diameter of a stretched
 * one, an ellipsoid of revolution, is its long one; those of a plain one lie along x, y and z.
 */
export function ballEnds(body: BodyData): Float64Array {
  const { spheres, sphereAxes: axes } = body;
  const middles = placesOf(body, spheres);
  const ends = new Float64Array((spheres.length / 4) * ENDS);
  const halves = new Float64Array(9);
  for (let ball = 0, at = 0; at < ends.length; ball++, at += ENDS) {
    const radius = (spheres[4 * ball + 3] as number) * body.normalization.diagonal;
    const [x, y, z] = [0, 1, 2].map((axis) => (axes?.[3 * ball + axis] ?? 0) * body.normalization.diagonal) as [
      number,
      number,
      number,
    ];
    if (x === 0 && y === 0 && z === 0) halves.set([radius, 0, 0, 0, radius, 0, 0, 0, radius]);
    else {
      halves.set([x, y, z]);
      writeAcross(halves, 3, 6, x, y, z, radius);
    }
    for (let i = 0; i < 9; i++) {
      const middle = middles[3 * ball + (i % 3)] as number;
      const end = at + 6 * Math.floor(i / 3) + (i % 3);
      ends[end] = middle - (halves[i] as number);
      ends[end + 3] = middle + (halves[i] as number);
    }
  }
  return ends;
}

/** Places that a body gives in solver space, four numbers each of which three are read, in model units: three numbers each. */
export function placesOf({ normalization, mesh }: BodyData, rows: Numbers): Float64Array {
  const { center, diagonal } = normalization;
  return Float64Array.from({ length: (rows.length / 4) * 3 }, (_, i) => {
    const axis = (i % 3) as 0 | 1 | 2;
    return (rows[4 * Math.floor(i / 3) + axis] as number) * diagonal + center[axis] + (mesh.origin?.[axis] ?? 0);
  });
}

/** Matrices that take the unit ball to balls whose diameters have these ends (18 numbers each), about an origin. Allocates nothing. */
export function ballMatrices(ends: Numbers, out: Writable, origin: Numbers = MIDDLE): void {
  for (let from = 0, to = 0; from < ends.length; from += ENDS, to += MATRIX) {
    for (let axis = 0; axis < 3; axis++) {
      let middle = 0;
      for (let k = 0; k < 3; k++) {
        const one = ends[from + 6 * k + axis] as number;
        const other = ends[from + 6 * k + 3 + axis] as number;
        out[to + 4 * k + axis] = (other - one) / 2;
        middle += one + other;
      }
      // Before it is rounded to a float: far from the origin the difference alone has digits enough.
      out[to + 12 + axis] = middle / 6 - (origin[axis] as number);
    }
    out[to + 3] = out[to + 7] = out[to + 11] = 0;
    out[to + 15] = 1;
  }
}

/**
 * Matrices that take a bar along y, of length 1 and radius 1 about its middle, to lines of this radius between places (three numbers each);
 * `joints` has the numbers of both places of each line. Allocates nothing.
 */
export function barMatrices(places: Numbers, joints: Uint32Array, radius: number, out: Writable, origin: Numbers = MIDDLE): void {
  for (let bar = 0, to = 0; 2 * bar < joints.length; bar++, to += MATRIX) {
    const from = 3 * (joints[2 * bar] as number);
    const end = 3 * (joints[2 * bar + 1] as number);
    for (let axis = 0; axis < 3; axis++) {
      const a = places[from + axis] as number;
      const b = places[end + axis] as number;
      out[to + 4 + axis] = b - a;
      out[to + 12 + axis] = (a + b) / 2 - (origin[axis] as number);
    }
    writeAcross(out, to + 8, to, out[to + 4] as number, out[to + 5] as number, out[to + 6] as number, radius);
    out[to + 3] = out[to + 7] = out[to + 11] = 0;
    out[to + 15] = 1;
  }
}

/**
 * Writes two vectors of a length, at right angles to (x, y, z) and to each other, so that the three make a right-handed frame in this order
 * (Duff et al. 2017, Building an orthonormal basis, revisited). For no direction at all, those of z.
 */
function writeAcross(out: Writable, first: number, second: number, x: number, y: number, z: number, length: number): void {
  const size = Math.sqrt(x * x + y * y + z * z);
  const nx = size > 0 ? x / size : 0;
  const ny = size > 0 ? y / size : 0;
  const nz = size > 0 ? z / size : 1;
  const sign = nz < 0 ? -1 : 1;
  const a = -1 / (sign + nz);
  const b = nx * ny * a;
  out[first] = length * (1 + sign * nx * nx * a);
  out[first + 1] = length * sign * b;
  out[first + 2] = -length * sign * nx;
  out[second] = length * b;
  out[second + 1] = length * (sign + ny * ny * a);
  out[second + 2] = -length * ny;
}
