import { HandlebodyError } from '../../wasm/ts/errors.ts';

/** Points of a closed curve, x y x y …; the last is joined to the first. */
export type Ring = Float64Array;

/**
 * A region of the plane: what lies inside an odd number of its rings. Outer rings and holes need no order and no direction; rings neither
 * cross nor touch each other or themselves.
 */
export type Shape = readonly Ring[];

/** More points than these are refused: an outline of that many is better simplified. */
const MOST_OUTLINE_POINTS = 20_000;

/** Area inside of a ring, positive where it runs counter-clockwise (y upwards). */
export function signedArea(ring: ArrayLike<number>): number {
  let sum = 0;
  const [x0, y0] = [ring[0] ?? 0, ring[1] ?? 0];
  for (let i = 2; i + 3 < ring.length; i += 2) {
    const [ax, ay] = [(ring[i] as number) - x0, (ring[i + 1] as number) - y0];
    const [bx, by] = [(ring[i + 2] as number) - x0, (ring[i + 3] as number) - y0];
    sum += ax * by - ay * bx;
  }
  return sum / 2;
}

/** Area of a shape: rings inside an even number of others count, the rest are holes. */
export function shapeArea(shape: Shape): number {
  let area = 0;
  for (const ring of shape) {
    const depth = shape.filter((other) => other !== ring && insideRing(other, ring[0] as number, ring[1] as number)).length;
    area += (depth % 2 === 0 ? 1 : -1) * Math.abs(signedArea(ring));
  }
  return area;
}

/** Whether a point lies inside a shape; on its border either answer may come. */
export function inside(shape: Shape, x: number, y: number): boolean {
  let odd = false;
  for (const ring of shape) if (insideRing(ring, x, y)) odd = !odd;
  return odd;
}

function insideRing(ring: Ring, x: number, y: number): boolean {
  let odd = false;
  let [ax, ay] = [ring[ring.length - 2] as number, ring[ring.length - 1] as number];
  for (let i = 0; i < ring.length; i += 2) {
    const [bx, by] = [ring[i] as number, ring[i + 1] as number];
    if (by > y !== ay > y && x < ((ax - bx) * (y - by)) / (ay - by) + bx) odd = !odd;
    [ax, ay] = [bx, by];
  }
  return odd;
}

interface Extent {
  readonly low: readonly [number, number];
  readonly high: readonly [number, number];
}

/** The smallest upright rectangle around points x y x y …. */
export function extentOf(...rings: ArrayLike<number>[]): Extent {
  let [left, bottom, right, top] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const ring of rings) {
    for (let i = 0; i < ring.length; i += 2) {
      const [x, y] = [ring[i] as number, ring[i + 1] as number];
      if (x < left) left = x;
      if (x > right) right = x;
      if (y < bottom) bottom = y;
      if (y > top) top = y;
    }
  }
  return { low: [left, bottom], high: [right, top] };
}

/** A shape moved to the origin and scaled, so that its longer side is `size`; and how: out = (in − middle) · scale. */
export function centered(shape: Shape, size: number): { shape: Shape; middle: readonly [number, number]; scale: number } {
  const { low, high } = extentOf(...shape);
  const middle = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2] as const;
  const scale = size / Math.max(high[0] - low[0], high[1] - low[1], 1e-300);
  return { shape: shape.map((ring) => ring.map((value, k) => (value - middle[k % 2 === 0 ? 0 : 1]) * scale)), middle, scale };
}

/**
 * Refuses what encloses no region. Throws `HandlebodyError`: 'outline-too-few' (a ring of fewer than three different points),
 * 'outline-not-finite', 'outline-too-fine' (more than {@link MOST_OUTLINE_POINTS}), 'outline-no-area', 'outline-crosses' (the message names
 * both edges; an edge has the number of its first point, counted through all rings).
 */
export function checkShape(shape: Shape): void {
  const count = shape.reduce((sum, ring) => sum + ring.length / 2, 0);
  if (shape.length === 0) throw tooFew(0, 0);
  if (count > MOST_OUTLINE_POINTS) {
    throw new HandlebodyError('outline-too-fine', {
      message: `The outline has ${count} points, more than ${MOST_OUTLINE_POINTS}.`,
      remedy: 'Simplify it first.',
    });
  }
  let first = 0;
  for (const ring of shape) {
    const different = new Set<string>();
    for (let i = 0; i < ring.length; i += 2) {
      const [x, y] = [ring[i] as number, ring[i + 1] as number];
      if (!(Math.abs(x) < 1e100 && Math.abs(y) < 1e100)) {
        throw new HandlebodyError('outline-not-finite', {
          message: `Point ${first + i / 2} of the outline is at (${x}, ${y}).`,
          remedy: 'Give two finite numbers of ordinary size for every point.',
          culprit: { kind: 'point', index: first + i / 2 },
        });
      }
      if (different.size < 3) different.add(`${x} ${y}`);
    }
    if (different.size < 3) throw tooFew(different.size, first);
    first += ring.length / 2;
  }
  const { low, high } = extentOf(...shape);
  const span = Math.max(high[0] - low[0], high[1] - low[1]);
  checkCrossings(shape);
  if (!(Math.abs(shapeArea(shape)) > 1e-9 * span * span)) {
    throw new HandlebodyError('outline-no-area', {
      message: 'The outline encloses no area: its points lie on one line.',
      remedy: 'Draw a shape that has an inside.',
    });
  }
}

function tooFew(count: number, first: number): HandlebodyError {
  return new HandlebodyError('outline-too-few', {
    message: `An outline of ${count} ${count === 1 ? 'point' : 'different points'} encloses nothing.`,
    remedy: 'Give at least three points, not all at one place.',
    culprit: { kind: 'point', index: first },
  });
}

interface Edge {
  readonly index: number;
  readonly next: number;
  readonly ax: number;
  readonly ay: number;
  readonly bx: number;
  readonly by: number;
  readonly left: number;
  readonly right: number;
}

/** Sweeps over the edges from left to right and compares those that overlap. */
function checkCrossings(shape: Shape): void {
  const edges: Edge[] = [];
  let first = 0;
  for (const ring of shape) {
    const n = ring.length / 2;
    for (let i = 0; i < n; i++) {
      const j = (i + 1) % n;
      const [ax, ay, bx, by] = [ring[2 * i], ring[2 * i + 1], ring[2 * j], ring[2 * j + 1]] as [number, number, number, number];
      edges.push({ index: first + i, next: first + j, ax, ay, bx, by, left: Math.min(ax, bx), right: Math.max(ax, bx) });
    }
    first += n;
  }
  edges.sort((a, b) => a.left - b.left);
  let active: Edge[] = [];
  for (const edge of edges) {
    active = active.filter(({ right }) => right >= edge.left);
    for (const other of active) {
      if (!cross(edge, other)) continue;
      const [one, two] = edge.index < other.index ? [edge.index, other.index] : [other.index, edge.index];
      throw new HandlebodyError('outline-crosses', {
        message: `Edge ${one} and edge ${two} of the outline cross or touch.`,
        remedy: 'Move their points so that the outline never meets itself.',
        culprit: { kind: 'point', index: one },
      });
    }
    active.push(edge);
  }
}

/** Twice the area of a triangle, zero where rounding could decide its sign. */
function turn(ax: number, ay: number, bx: number, by: number, cx: number, cy: number): number {
  const [left, right] = [(bx - ax) * (cy - ay), (by - ay) * (cx - ax)];
  const area = left - right;
  return Math.abs(area) <= 4e-16 * (Math.abs(left) + Math.abs(right)) ? 0 : area;
}

function cross(p: Edge, q: Edge): boolean {
  // Neighbors share a point; they may not fold back onto each other.
  if (p.next === q.index || q.next === p.index) {
    const [a, b] = p.next === q.index ? [p, q] : [q, p];
    const folds = (a.bx - a.ax) * (b.bx - b.ax) + (a.by - a.ay) * (b.by - b.ay) < 0;
    return folds && turn(a.ax, a.ay, a.bx, a.by, b.bx, b.by) === 0;
  }
  if (Math.max(p.ay, p.by) < Math.min(q.ay, q.by) || Math.max(q.ay, q.by) < Math.min(p.ay, p.by)) return false;
  const [a, b] = [turn(p.ax, p.ay, p.bx, p.by, q.ax, q.ay), turn(p.ax, p.ay, p.bx, p.by, q.bx, q.by)];
  const [c, d] = [turn(q.ax, q.ay, q.bx, q.by, p.ax, p.ay), turn(q.ax, q.ay, q.bx, q.by, p.bx, p.by)];
  if (a === 0 && b === 0 && c === 0 && d === 0) return Math.max(p.left, q.left) <= Math.min(p.right, q.right);
  return a * b <= 0 && c * d <= 0;
}
