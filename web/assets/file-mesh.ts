/** What the readers of OBJ, PLY, STL and OFF share: the mesh that they give, and how it is made of what they find. */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { chooseOrigin } from '../../wasm/ts/origin.ts';
import { areaNormals } from './area-normals.ts';
import { MAX_VERTICES } from './concatenate.ts';
import { cutFaces } from './cut-polygons.ts';
import { FLAT } from './ear-clipping.ts';
import type { FileWarning, PassedOver } from './file-warnings.ts';
import { countDoubled, joinVertices } from './join-vertices.ts';

/** A mesh as simple files hold it: one list of vertices, in the order of the file. */
export interface FileMesh {
  /** n×3; about `origin`, where there is one. */
  readonly positions: Float32Array;
  /** m×3, counter-clockwise seen from outside; none for a cloud of points. */
  readonly triangles: Uint32Array;
  /** n×3, of unit length, where the file has one normal a vertex. */
  readonly normals: Float32Array | undefined;
  /** n×2, from the top left as in glTF, where the file has one pair a vertex. */
  readonly uvs: Float32Array | undefined;
  /**
   * Where the positions begin, exact as floats: a vertex lies at `origin` + `positions`. Only in a mesh that is more than 1,000 of its
   * diagonals away from the coordinates' origin, whose shape floats would not hold there.
   */
  readonly origin?: readonly [number, number, number];
  /** What was passed over or left out, with how many: one for each kind. */
  readonly warnings: readonly FileWarning[];
}

/** More triangles would need more memory than a page has. */
const MAX_TRIANGLES = 1 << 25;

/** What a reader has found. */
interface Found {
  readonly format: 'OBJ' | 'PLY' | 'STL' | 'OFF';
  /** n×3; NaN where the file has no number that a float can hold. */
  readonly positions: Float64Array;
  /** Vertices of all corners, below n, and the corners of each face, 3 or more. */
  readonly corners: Uint32Array;
  readonly sizes: Uint32Array;
  /** Whether the file says that it has faces: without any it is a cloud of points. */
  readonly hasFaces: boolean;
  readonly passed: PassedOver;
  /** The error for a vertex that is used and has no place: it names the line or the byte. */
  readonly badVertex: (vertex: number) => HandlebodyError;
  /** Whether each face brought vertices of its own, which become one where they lie at one place. */
  readonly join?: boolean;
}

export interface Surface {
  readonly positions: Float32Array;
  readonly triangles: Uint32Array;
  readonly origin?: readonly [number, number, number];
}

/**
 * Cuts faces into triangles, chooses an origin, and looks for what is wrong with the whole: the same for all formats. Vertices that no face
 * uses set nothing.
 *
 * Throws 'file-invalid' for a mesh without vertices, one whose faces give no triangle, or a vertex in use that has no place.
 */
export function makeSurface(found: Found): Surface {
  const { format, positions: places, corners, sizes, passed, badVertex, hasFaces } = found;
  if (places.length === 0 || (hasFaces && sizes.length === 0)) throw empty(found);
  const isUsed = usedVertices(places.length / 3, corners, hasFaces);
  for (let vertex = 0; vertex < isUsed.length; vertex++) {
    if (!Number.isNaN((places[3 * vertex] as number) + (places[3 * vertex + 1] as number) + (places[3 * vertex + 2] as number)))
      continue;
    if (isUsed[vertex]) throw badVertex(vertex);
    passed.note('positions-bad', () => badVertex(vertex));
  }
  const triangles = cutFaces(places, { corners, sizes }, (face) => {
    passed.note('faces-crossing', () => faceError(format, face, 'crosses itself'));
  });
  const placed = { ...placeVertices(places, isUsed), triangles };
  const surface = found.join ? joined(placed) : placed;
  noteOdd(surface, format, passed);
  return surface;
}

/** A surface whose triangles each brought vertices of their own: those at one place, as floats, become one, in the order of the first. */
function joined({ positions, triangles, origin }: Surface): Surface {
  const first = joinVertices(positions);
  const numbers = new Uint32Array(first.length);
  let count = 0;
  for (let vertex = 0; vertex < first.length; vertex++) {
    if (first[vertex] !== vertex) continue;
    positions.copyWithin(3 * count, 3 * vertex, 3 * vertex + 3);
    numbers[vertex] = count++;
  }
  for (let i = 0; i < triangles.length; i++) triangles[i] = numbers[first[triangles[i] as number] as number] as number;
  return { positions: positions.slice(0, 3 * count), triangles, ...(origin && { origin }) };
}

/** Vertices of faces; in a cloud, all. */
function usedVertices(count: number, corners: Uint32Array, hasFaces: boolean): Uint8Array {
  const isUsed = new Uint8Array(count);
  if (!hasFaces) return isUsed.fill(1);
  for (let i = 0; i < corners.length; i++) isUsed[corners[i] as number] = 1;
  return isUsed;
}

function placeVertices(
  places: Float64Array,
  isUsed: Uint8Array,
): { positions: Float32Array; origin?: readonly [number, number, number] } {
  const low: [number, number, number] = [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY];
  const high: [number, number, number] = [Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (let vertex = 0; vertex < isUsed.length; vertex++) {
    if (!isUsed[vertex]) continue;
    for (let axis = 0; axis < 3; axis++) {
      const value = places[3 * vertex + axis] as number;
      if (value < (low[axis] as number)) low[axis] = value;
      if (value > (high[axis] as number)) high[axis] = value;
    }
  }
  const origin = chooseOrigin(low, high);
  const positions = new Float32Array(places.length);
  for (const axis of [0, 1, 2] as const) {
    const start = origin?.[axis] ?? 0;
    for (let i = axis; i < positions.length; i += 3) positions[i] = (places[i] as number) - start;
  }
  // What no face uses must not be NaN in the files that are made of this, nor larger than the surface.
  const some = 3 * isUsed.indexOf(1);
  for (let vertex = 0; vertex < isUsed.length; vertex++) {
    const at = 3 * vertex;
    if (
      !Number.isFinite((positions[at] as number) + (positions[at + 1] as number) + (positions[at + 2] as number)) &&
      !isUsed[vertex]
    )
      positions.copyWithin(at, some, some + 3);
  }
  return origin ? { positions, origin } : { positions };
}

/** Counts triangles without area and such as are there twice. */
function noteOdd({ positions: p, triangles }: Surface, format: Found['format'], passed: PassedOver): void {
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * (triangles[t] as number), 3 * (triangles[t + 1] as number), 3 * (triangles[t + 2] as number)];
    const [ux, uy, uz] = [at(p, b) - at(p, a), at(p, b + 1) - at(p, a + 1), at(p, b + 2) - at(p, a + 2)];
    const [vx, vy, vz] = [at(p, c) - at(p, a), at(p, c + 1) - at(p, a + 1), at(p, c + 2) - at(p, a + 2)];
    const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const longest = Math.max(
      ux * ux + uy * uy + uz * uz,
      vx * vx + vy * vy + vz * vz,
      (ux - vx) * (ux - vx) + (uy - vy) * (uy - vy) + (uz - vz) * (uz - vz),
    );
    if (!(x * x + y * y + z * z > FLAT * FLAT * longest * longest))
      passed.note('triangles-flat', () => triangleError(format, t / 3, 'has no area'));
  }
  let first = 0;
  const doubled = countDoubled(triangles, (triangle) => {
    first = triangle;
  });
  if (doubled > 0) passed.note('triangles-doubled', () => triangleError(format, first, 'is there a second time'), doubled);
}

const at = (numbers: Float32Array, i: number) => numbers[i] as number;

/**
 * Scales normals to unit length. Those that have none are replaced by what the surface gives there; of vertices that no face uses, and in a
 * cloud, by one that points up. `onBad` is called for each of a vertex in use.
 */
export function finishNormals(
  rows: Float32Array,
  { positions, triangles }: Surface,
  onBad?: (vertex: number) => void,
): Float32Array {
  let [smooth, isUsed]: [Float32Array | undefined, Uint8Array | undefined] = [undefined, undefined];
  for (let i = 0; i < rows.length; i += 3) {
    const length = Math.hypot(at(rows, i), at(rows, i + 1), at(rows, i + 2));
    if (length > 1e-30 && length < Number.POSITIVE_INFINITY) {
      for (let axis = 0; axis < 3; axis++) rows[i + axis] = at(rows, i + axis) / length;
      continue;
    }
    smooth ??= areaNormals(positions, triangles);
    isUsed ??= usedVertices(rows.length / 3, triangles, triangles.length > 0);
    if (isUsed[i / 3]) onBad?.(i / 3);
    for (let axis = 0; axis < 3; axis++) rows[i + axis] = at(smooth, i + axis);
  }
  return rows;
}

/** Throws 'mesh-too-large' where a file has more vertices or triangles than can be held. */
export function checkCounts(vertices: number, triangles: number): void {
  if (vertices <= MAX_VERTICES && triangles <= MAX_TRIANGLES) return;
  throw new HandlebodyError('mesh-too-large', {
    message: `The file has ${vertices} vertices and ${triangles} triangles or more; at most ${MAX_VERTICES} and ${MAX_TRIANGLES} can be read.`,
    remedy: 'Simplify the model, or use one of its parts.',
  });
}

/** Why there is nothing in the file: what was passed over first, if anything was. */
function empty({ format, positions, passed }: Found): HandlebodyError {
  const codes = ['faces-degenerate', 'statements-unknown', 'keyword-missing', 'data-left-over'] as const;
  const message = `The ${format} file has no ${positions.length === 0 ? 'vertices' : 'face of three corners'}.`;
  return (
    passed.firstOf(codes) ?? new HandlebodyError('file-invalid', { message, remedy: 'Export the model again, with its surface.' })
  );
}

function faceError(format: string, face: number, what: string): HandlebodyError {
  return new HandlebodyError('file-invalid', {
    message: `Face ${face} of the ${format} file ${what}.`,
    remedy: 'Cut it into triangles, or read the file without "strict".',
  });
}

function triangleError(format: string, triangle: number, what: string): HandlebodyError {
  return new HandlebodyError('file-invalid', {
    message: `Triangle ${triangle} of the ${format} file ${what}.`,
    remedy: 'Remove it, or read the file without "strict".',
    culprit: { kind: 'triangle', index: triangle },
  });
}
