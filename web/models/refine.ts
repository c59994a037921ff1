import { type ConformingTriangulation, conformingDelaunay } from './delaunay.ts';
import { inside, type Shape } from './shape.ts';

/** Angles below this are refined, degrees: Ruppert's algorithm is sure to end up to 20.7 where the border has no acute corner. */
const LEAST_ANGLE = 20.5;
/** Acute corners would go on for ever: rounds, and the shortest edge as a part of the spacing, put an end to it. */
const ROUNDS = 12;
const SHORTEST = 0.15;

/**
 * Delaunay refinement (Ruppert 1995), a batch a round: a triangle with a small angle gets the middle of its circumcircle as a new point, or,
 * where that lies in the smallest circle around an edge of the border, this edge is split.
 */
export function refine(border: Shape, interior: number[], spacing: number): ConformingTriangulation {
  let mesh = conformingDelaunay(border, interior);
  let points = interior;
  for (let round = 0; round < ROUNDS; round++) {
    const centers = badCenters(mesh);
    if (centers.length === 0) break;
    const rings = ringsOf(mesh);
    const split = new Set<number>();
    const added: number[] = [];
    for (let i = 0; i < centers.length; i += 2) {
      const [x, y] = [centers[i] as number, centers[i + 1] as number];
      const edges = encroached(mesh, x, y);
      for (const edge of edges) if (lengthOf(mesh, edge) > SHORTEST * spacing) split.add(edge);
      if (edges.length > 0 || !inside(rings, x, y)) continue;
      if (isApart(added, x, y, SHORTEST * spacing) && isApart(points, x, y, SHORTEST * spacing)) added.push(x, y);
    }
    if (split.size === 0 && added.length === 0) break;
    points = [...points, ...added];
    mesh = conformingDelaunay(ringsOf(mesh, split), points);
  }
  return mesh;
}

/** Middles of the circumcircles of all triangles with a small angle, x y x y …. */
function badCenters({ points, triangles }: ConformingTriangulation): number[] {
  const out: number[] = [];
  // The smallest angle's sine is the shortest edge over the circumcircle's diameter.
  const sine = Math.sin((LEAST_ANGLE * Math.PI) / 180);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [2 * (triangles[t] as number), 2 * (triangles[t + 1] as number), 2 * (triangles[t + 2] as number)];
    const [ax, ay] = [points[a] as number, points[a + 1] as number];
    const [ux, uy] = [(points[b] as number) - ax, (points[b + 1] as number) - ay];
    const [vx, vy] = [(points[c] as number) - ax, (points[c + 1] as number) - ay];
    const [uu, vv, twice] = [ux * ux + uy * uy, vx * vx + vy * vy, 2 * (ux * vy - uy * vx)];
    const [cx, cy] = [(vy * uu - uy * vv) / twice, (ux * vv - vx * uu) / twice];
    const shortest = Math.sqrt(Math.min(uu, vv, (ux - vx) ** 2 + (uy - vy) ** 2));
    if (shortest < 2 * Math.hypot(cx, cy) * sine) out.push(ax + cx, ay + cy);
  }
  return out;
}

/** Edges of the border in whose smallest circle a place lies, by their number. */
function encroached({ points, border }: ConformingTriangulation, x: number, y: number): number[] {
  const out: number[] = [];
  for (let e = 0; e < border.length; e += 2) {
    const [a, b] = [2 * (border[e] as number), 2 * (border[e + 1] as number)];
    const [ux, uy] = [(points[a] as number) - x, (points[a + 1] as number) - y];
    const [vx, vy] = [(points[b] as number) - x, (points[b + 1] as number) - y];
    if (ux * vx + uy * vy < 0) out.push(e / 2);
  }
  return out;
}

function lengthOf({ points, border }: ConformingTriangulation, edge: number): number {
  const [a, b] = [2 * (border[2 * edge] as number), 2 * (border[2 * edge + 1] as number)];
  return Math.hypot((points[a] as number) - (points[b] as number), (points[a + 1] as number) - (points[b + 1] as number));
}

function isApart(points: readonly number[], x: number, y: number, distance: number): boolean {
  for (let i = 0; i < points.length; i += 2)
    if (Math.hypot((points[i] as number) - x, (points[i + 1] as number) - y) < distance) return false;
  return true;
}

/** The border's rings, with the middle of some edges. */
function ringsOf({ points, border }: ConformingTriangulation, split: ReadonlySet<number> = new Set()): Shape {
  const rings: Float64Array[] = [];
  let ring: number[] = [];
  let first = border[0];
  for (let e = 0; e < border.length; e += 2) {
    const [a, b] = [border[e] as number, border[e + 1] as number];
    const [ax, ay, bx, by] = [points[2 * a], points[2 * a + 1], points[2 * b], points[2 * b + 1]] as [
      number,
      number,
      number,
      number,
    ];
    ring.push(ax, ay);
    if (split.has(e / 2)) ring.push((ax + bx) / 2, (ay + by) / 2);
    if (b !== first) continue;
    rings.push(Float64Array.from(ring));
    ring = [];
    first = border[e + 2];
  }
  return rings;
}
