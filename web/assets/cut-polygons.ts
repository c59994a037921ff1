/** Faces of any number of corners, in space, as triangles. */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { crossesItself } from './crossing-edges.ts';
import { clipEars, FLAT } from './ear-clipping.ts';

/** Faces as lists: vertices of all corners one after another, and how many each face has, 3 or more. */
interface Faces {
  readonly corners: Uint32Array;
  readonly sizes: Uint32Array;
}

/** Ear clipping takes quadratic time at worst, up to a second for this sum of squares of the numbers of corners. */
const MAX_SQUARES = 1e8;
/** And where a face crosses itself, a hundred times as long: from this sum on that is looked for first. */
const MANY_SQUARES = 2e5;

type Vector = [number, number, number];

/**
 * Vertices three by three: n − 2 triangles for a face of n corners, in the order of the faces.
 *
 * - A face is cut into the fan of its first corner where no triangle of it is flat or turned over, as in every convex face whose corners are
 *   not on a line; a quad, flat or not, else by its other diagonal.
 * - Other faces are cut by ear clipping in the plane across the sum of their corners' cross products (Newell's normal). Together the
 *   triangles have the polygon's area, and each edge of the polygon is one of theirs.
 * - A face that crosses itself, for which `onCrossing` is called, or that lies on a line, has no right triangles: it is cut into its fan.
 *
 * Throws 'mesh-too-large' for concave faces with so many corners that cutting them would take minutes.
 */
export function cutFaces(positions: Float64Array, { corners, sizes }: Faces, onCrossing: (face: number) => void): Uint32Array {
  if (corners.length === 3 * sizes.length) return corners;
  const triangles = new Uint32Array(3 * (corners.length - 2 * sizes.length));
  let [start, out, squares] = [0, 0, 0];
  for (let face = 0; face < sizes.length; face++) {
    const size = sizes[face] as number;
    const put = (a: number, b: number, c: number) => {
      triangles[out++] = corners[start + a] as number;
      triangles[out++] = corners[start + b] as number;
      triangles[out++] = corners[start + c] as number;
    };
    const putFan = (apex: number) => {
      for (let i = 1; i < size - 1; i++) put(apex, (apex + i) % size, (apex + i + 1) % size);
    };
    if (size === 3) putFan(0);
    else {
      const polygon = gather(positions, corners, start, size);
      const normal = newell(polygon);
      if (!normal || isFanRight(polygon, normal, 0)) putFan(0);
      else if (size === 4 && isFanRight(polygon, normal, 1)) putFan(1);
      else {
        squares += size * size;
        if (squares > MAX_SQUARES) throw tooLarge(face, size);
        const flat = flatten(polygon, normal);
        const cut = squares > MANY_SQUARES && crossesItself(flat) ? undefined : clipEars(flat);
        if (!cut) {
          onCrossing(face);
          putFan(0);
        } else for (let i = 0; i < cut.length; i += 3) put(cut[i] as number, cut[i + 1] as number, cut[i + 2] as number);
      }
    }
    start += size;
  }
  return triangles;
}

/** A face's corners about its first one, scaled to about 1, so that no product overflows. */
function gather(positions: Float64Array, corners: Uint32Array, start: number, size: number): Float64Array {
  const polygon = new Float64Array(3 * size);
  let extent = 0;
  for (let i = 0; i < size; i++) {
    for (let axis = 0; axis < 3; axis++) {
      const value =
        (positions[3 * (corners[start + i] as number) + axis] as number) -
        (positions[3 * (corners[start] as number) + axis] as number);
      polygon[3 * i + axis] = value;
      extent = Math.max(extent, Math.abs(value));
    }
  }
  // By a power of two, which keeps every bit.
  const scale = extent > 0 ? 2 ** -Math.floor(Math.log2(extent)) : 1;
  for (let i = 0; i < polygon.length; i++) polygon[i] = (polygon[i] as number) * scale;
  return polygon;
}

/** The polygon's unit normal; undefined where it has no area. */
function newell(polygon: Float64Array): Vector | undefined {
  const sum: Vector = [0, 0, 0];
  for (let i = 3; i < polygon.length - 3; i += 3) {
    const [x, y, z] = crossAt(polygon, 0, i, i + 3);
    sum[0] += x;
    sum[1] += y;
    sum[2] += z;
  }
  const length = Math.hypot(...sum);
  return length > FLAT ? [sum[0] / length, sum[1] / length, sum[2] / length] : undefined;
}

function crossAt(polygon: Float64Array, a: number, b: number, c: number): Vector {
  const p = (at: number, axis: number) => (polygon[at + axis] as number) - (polygon[a + axis] as number);
  return [p(b, 1) * p(c, 2) - p(b, 2) * p(c, 1), p(b, 2) * p(c, 0) - p(b, 0) * p(c, 2), p(b, 0) * p(c, 1) - p(b, 1) * p(c, 0)];
}

/** Whether each triangle of the fan of a corner looks along the normal and is not flat. */
function isFanRight(polygon: Float64Array, [nx, ny, nz]: Vector, apex: number): boolean {
  const size = polygon.length / 3;
  for (let i = 1; i < size - 1; i++) {
    const [a, b, c] = [3 * apex, 3 * ((apex + i) % size), 3 * ((apex + i + 1) % size)];
    const [x, y, z] = crossAt(polygon, a, b, c);
    const longest = Math.max(squaredLength(polygon, a, b), squaredLength(polygon, b, c), squaredLength(polygon, c, a));
    if (!(x * nx + y * ny + z * nz > FLAT * longest)) return false;
  }
  return true;
}

function squaredLength(polygon: Float64Array, a: number, b: number): number {
  let sum = 0;
  for (let axis = 0; axis < 3; axis++) sum += ((polygon[b + axis] as number) - (polygon[a + axis] as number)) ** 2;
  return sum;
}

/** Coordinates in the plane across the normal (Duff et al., 2017): in a plane across an axis they are the polygon's own, to the last bit. */
function flatten(polygon: Float64Array, [nx, ny, nz]: Vector): Float64Array {
  const sign = nz < 0 ? -1 : 1;
  const a = -1 / (sign + nz);
  const b = nx * ny * a;
  const [u, v]: [Vector, Vector] = [
    [1 + sign * nx * nx * a, sign * b, -sign * nx],
    [b, sign + ny * ny * a, -ny],
  ];
  const xy = new Float64Array((polygon.length / 3) * 2);
  for (let i = 0; i < polygon.length / 3; i++) {
    const [x, y, z] = polygon.subarray(3 * i, 3 * i + 3) as unknown as Vector;
    xy[2 * i] = u[0] * x + u[1] * y + u[2] * z;
    xy[2 * i + 1] = v[0] * x + v[1] * y + v[2] * z;
  }
  return xy;
}

function tooLarge(face: number, size: number): HandlebodyError {
  return new HandlebodyError('mesh-too-large', {
    message: `Cutting the file's concave faces would take minutes: face ${face} has ${size} corners.`,
    remedy: 'Let the modeler cut large faces into triangles.',
  });
}
