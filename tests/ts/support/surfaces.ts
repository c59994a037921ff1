/** What surfaces are measured by, independently of the readers. */
import type { FileMesh } from '../../../web/assets/index.ts';

type Point = [number, number, number];

export const placeOf = ({ positions, origin = [0, 0, 0] }: FileMesh, vertex: number): Point => [
  origin[0] + (positions[3 * vertex] as number),
  origin[1] + (positions[3 * vertex + 1] as number),
  origin[2] + (positions[3 * vertex + 2] as number),
];

export const minus = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const cross = (a: Point, b: Point): Point => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const dot = (a: Point, b: Point): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Half the cross product of two edges, of each triangle. */
export function areaVectors(mesh: FileMesh): Point[] {
  return Array.from({ length: mesh.triangles.length / 3 }, (_, t) => {
    const [a, b, c] = [0, 1, 2].map((i) => placeOf(mesh, mesh.triangles[3 * t + i] as number)) as [Point, Point, Point];
    const twice = cross(minus(b, a), minus(c, a));
    return [twice[0] / 2, twice[1] / 2, twice[2] / 2];
  });
}

/** Half the sum of the corners' cross products: of a flat polygon, its area along its normal. */
export function polygonArea(corners: readonly Point[]): Point {
  const sum: Point = [0, 0, 0];
  const first = corners[0] as Point;
  for (let i = 1; i + 1 < corners.length; i++) {
    const part = cross(minus(corners[i] as Point, first), minus(corners[i + 1] as Point, first));
    for (const axis of [0, 1, 2] as const) sum[axis] += part[axis] / 2;
  }
  return sum;
}

/** The box of what triangles use, their number and area. */
export function measure(mesh: FileMesh) {
  const places = Array.from(mesh.triangles, (vertex) => placeOf(mesh, vertex));
  const reach = (pick: (...values: number[]) => number) =>
    [0, 1, 2].map((axis) => places.reduce((best, place) => pick(best, place[axis] as number), places[0]?.[axis] ?? Number.NaN));
  return {
    low: reach(Math.min),
    high: reach(Math.max),
    triangles: mesh.triangles.length / 3,
    area: areaVectors(mesh).reduce((sum, each) => sum + Math.hypot(...each), 0),
  };
}

/** How many directed edges have no other one that runs back: 0 for a closed surface. */
export function openEdges(triangles: ArrayLike<number>): number {
  const edges = new Map<string, number>();
  for (let i = 0; i < triangles.length; i++) {
    const [from, to] = [triangles[i] as number, triangles[i % 3 === 2 ? i - 2 : i + 1] as number];
    const [key, step] = from < to ? [`${from} ${to}`, 1] : [`${to} ${from}`, -1];
    edges.set(key, (edges.get(key) ?? 0) + step);
  }
  return [...edges.values()].filter((count) => count !== 0).length;
}
