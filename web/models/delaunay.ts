import Delaunator from 'delaunator';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { Shape } from './shape.ts';

/** Points that may be added to the border for each that it has: enough for narrow gaps, and an end for what has none. */
const MOST_SPLITS = 24;

/** A triangulation of a shape: every edge of the border is a chain of its edges, and no triangle lies outside. */
export interface ConformingTriangulation {
  /** x y x y …: the border's points first, ring by ring, then those that were given, then the ones that split the border. */
  readonly points: Float64Array;
  /** Three points each, counter-clockwise. */
  readonly triangles: Uint32Array;
  /** Two points each: the border, split where it had to be. */
  readonly border: Uint32Array;
}

/** An edge of the border; `shell` at an end that is an acute corner. */
type Piece = readonly [a: number, b: number];

/**
 * The conforming Delaunay triangulation of a shape and points inside it: edges of the border that are missing from the Delaunay
 * triangulation of the points are split until none is. At acute corners they are split at powers of two from the corner (Ruppert 1995's
 * concentric shells), where two edges would split each other for ever otherwise. What lies inside is found by crossing the border from
 * outside, so no test of a point against the shape decides.
 *
 * The shape has to be sound (`checkShape`). Throws 'outline-too-fine' when the border had to be split more than {@link MOST_SPLITS}
 * times as often as it has points: some gap is too narrow for the points beside it.
 */
export function conformingDelaunay(shape: Shape, interior: ArrayLike<number>): ConformingTriangulation {
  const points: number[] = [];
  let pieces: Piece[] = [];
  for (const ring of shape) {
    const [first, n] = [points.length / 2, ring.length / 2];
    for (let i = 0; i < n; i++) {
      points.push(ring[2 * i] as number, ring[2 * i + 1] as number);
      pieces.push([first + i, first + ((i + 1) % n)]);
    }
  }
  const acute = acuteCorners(points, pieces);
  const given = pieces.length;
  for (let i = 0; i < interior.length; i++) points.push(interior[i] as number);
  const limit = points.length / 2 + MOST_SPLITS * given;

  for (;;) {
    const { triangles, halfedges } = surrounded(points);
    const present = new Map<number, number>();
    const key = (a: number, b: number) => a * 2 ** 26 + b;
    for (let e = 0; e < triangles.length; e++) present.set(key(triangles[e] as number, triangles[after(e)] as number), e);
    const kept: Piece[] = [];
    for (const piece of pieces) {
      const [a, b] = piece;
      if (present.has(key(a, b)) || present.has(key(b, a))) kept.push(piece);
      else {
        const middle = points.length / 2;
        points.push(...splitPoint(points, piece, acute));
        kept.push([a, middle], [middle, b]);
      }
    }
    if (kept.length === pieces.length) return cut(points, pieces, triangles, halfedges, (a, b) => present.get(key(a, b)));
    pieces = kept;
    if (points.length / 2 > limit) {
      throw new HandlebodyError('outline-too-fine', {
        message: 'The outline has a gap that is too narrow for its points.',
        remedy: 'Move the parts of the outline that nearly touch away from each other.',
      });
    }
  }
}

const after = (e: number) => (e % 3 === 2 ? e - 2 : e + 1);

/** Delaunay's triangulation of the points inside a wide square, so that their border is as ordinary as their inside. */
function surrounded(points: readonly number[]): { triangles: Uint32Array; halfedges: Int32Array } {
  let [left, bottom, right, top] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i += 2) {
    left = Math.min(left, points[i] as number);
    right = Math.max(right, points[i] as number);
    bottom = Math.min(bottom, points[i + 1] as number);
    top = Math.max(top, points[i + 1] as number);
  }
  const [x, y, r] = [(left + right) / 2, (bottom + top) / 2, 4 * Math.max(right - left, top - bottom)];
  const all = new Float64Array(points.length + 8);
  all.set(points);
  all.set([x - r, y - r, x + r, y - r, x + r, y + r, x - r, y + r], points.length);
  return new Delaunator(all);
}

/** Corners of less than 60 degrees, at which edges are split on shells. */
function acuteCorners(points: readonly number[], pieces: readonly Piece[]): Set<number> {
  const acute = new Set<number>();
  const before = new Map(pieces.map(([a, b]) => [b, a]));
  for (const [b, c] of pieces) {
    const a = before.get(b) as number;
    const [ux, uy] = [
      (points[2 * a] as number) - (points[2 * b] as number),
      (points[2 * a + 1] as number) - (points[2 * b + 1] as number),
    ];
    const [vx, vy] = [
      (points[2 * c] as number) - (points[2 * b] as number),
      (points[2 * c + 1] as number) - (points[2 * b + 1] as number),
    ];
    if (ux * vx + uy * vy > 0.5 * Math.hypot(ux, uy) * Math.hypot(vx, vy)) acute.add(b);
  }
  return acute;
}

function splitPoint(points: readonly number[], [a, b]: Piece, acute: ReadonlySet<number>): [number, number] {
  const [ax, ay] = [points[2 * a] as number, points[2 * a + 1] as number];
  const [bx, by] = [points[2 * b] as number, points[2 * b + 1] as number];
  let t = 0.5;
  if (acute.has(a) !== acute.has(b)) {
    const length = Math.hypot(bx - ax, by - ay);
    const shell = 2 ** Math.round(Math.log2(length / 2)) / length;
    t = acute.has(a) ? shell : 1 - shell;
  }
  return [ax + (bx - ax) * t, ay + (by - ay) * t];
}

/** Keeps the triangles inside: from the wide square inwards, every edge of the border that is crossed changes sides. */
function cut(
  points: readonly number[],
  pieces: readonly Piece[],
  triangles: Uint32Array,
  halfedges: Int32Array,
  edgeOf: (a: number, b: number) => number | undefined,
): ConformingTriangulation {
  const wall = new Uint8Array(triangles.length);
  for (const [a, b] of pieces) {
    for (const e of [edgeOf(a, b), edgeOf(b, a)]) if (e !== undefined) wall[e] = 1;
  }
  const count = points.length / 2;
  /** 0 unknown, 1 outside, 2 inside. */
  const side = new Uint8Array(triangles.length / 3);
  const start = Math.floor(triangles.findIndex((a) => a >= count) / 3);
  side[start] = 1;
  const stack = [start];
  for (let t = stack.pop(); t !== undefined; t = stack.pop()) {
    for (let e = 3 * t; e < 3 * t + 3; e++) {
      const twin = halfedges[e] as number;
      if (twin < 0) continue;
      const next = Math.floor(twin / 3);
      if (side[next] !== 0) continue;
      side[next] = wall[e] === 1 ? 3 - (side[t] as number) : (side[t] as number);
      stack.push(next);
    }
  }
  const kept: number[] = [];
  for (let t = 0; t < side.length; t++) {
    if (side[t] !== 2) continue;
    const [a, b, c] = [triangles[3 * t] as number, triangles[3 * t + 1] as number, triangles[3 * t + 2] as number];
    if (counterClockwise(points, a, b, c)) kept.push(a, b, c);
    else kept.push(a, c, b);
  }
  return { points: Float64Array.from(points), triangles: Uint32Array.from(kept), border: Uint32Array.from(pieces.flat()) };
}

function counterClockwise(points: readonly number[], a: number, b: number, c: number): boolean {
  const [ax, ay] = [points[2 * a] as number, points[2 * a + 1] as number];
  return (
    ((points[2 * b] as number) - ax) * ((points[2 * c + 1] as number) - ay) >
    ((points[2 * b + 1] as number) - ay) * ((points[2 * c] as number) - ax)
  );
}
