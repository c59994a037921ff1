import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { type ConformingTriangulation, conformingDelaunay } from './delaunay.ts';
import { refine } from './refine.ts';
import { resample, segmentDistance } from './resample.ts';
import { checkShape, extentOf, inside, type Shape, shapeArea } from './shape.ts';

/** A triangle mesh of a region of the plane. */
export interface PlaneMesh {
  /** n×2. */
  readonly positions: Float64Array;
  /** m×3, counter-clockwise. */
  readonly triangles: Uint32Array;
  /** k×2: the edges of the border, as pairs of vertices. */
  readonly border: Uint32Array;
  /** Smallest angle of all triangles, degrees. */
  readonly smallestAngle: number;
}

const MESH_SHAPE_DEFAULTS = { vertices: 2250, smoothing: 6 } as const;

/** More vertices than these are refused. */
const MOST_VERTICES = 60_000;

interface MeshShapeOptions {
  /** About how many vertices to make. */
  readonly vertices?: number;
  /** How often to move interior vertices to the middle of what surrounds them. */
  readonly smoothing?: number;
}

/**
 * A mesh of even triangles: points along the border, a hexagonal lattice inside, a few rounds of smoothing, a conforming Delaunay
 * triangulation of both, and Ruppert's refinement of what small angles are left. The same shape gives the same mesh.
 *
 * Throws what `checkShape` and `conformingDelaunay` throw, and 'invalid-option' for a number of vertices out of range.
 *
 * ```ts
 * const { positions, triangles, smallestAngle } = meshShape(gingerbreadMan(), { vertices: 2250 });
 * ```
 */
export function meshShape(shape: Shape, options: MeshShapeOptions = {}): PlaneMesh {
  const { vertices, smoothing } = { ...MESH_SHAPE_DEFAULTS, ...options };
  if (!(vertices >= 3 && vertices <= MOST_VERTICES)) {
    throw new HandlebodyError('invalid-option', {
      message: `A mesh of ${vertices} vertices was asked for.`,
      remedy: `Ask for 3 to ${MOST_VERTICES}.`,
    });
  }
  checkShape(shape);
  const spacing = spacingFor(shape, vertices);
  const border = evenBorder(shape, spacing);
  const walls = new Walls(border, 0.65 * spacing);
  let lattice = hexagons(border, spacing).filter(([x, y]) => walls.clear(x, y) && inside(border, x, y));
  for (let round = 0; round < smoothing; round++)
    lattice = smooth(conformingDelaunay(border, lattice.flat()), border, lattice, walls);
  const { points, triangles, border: edges } = withoutStrays(refine(border, lattice.flat(), spacing));
  return { positions: points, triangles, border: edges, smallestAngle: smallestAngle(points, triangles) };
}

/** Area of a mesh's triangles. */
export function meshArea({ positions, triangles }: Pick<PlaneMesh, 'positions' | 'triangles'>): number {
  let sum = 0;
  for (let t = 0; t < triangles.length; t += 3) sum += triangleArea(positions, triangles, t);
  return sum;
}

/** Signed area of the triangle whose first index is at `t`. */
export function triangleArea(positions: ArrayLike<number>, triangles: ArrayLike<number>, t: number): number {
  const [a, b, c] = [2 * (triangles[t] as number), 2 * (triangles[t + 1] as number), 2 * (triangles[t + 2] as number)];
  const [ax, ay] = [positions[a] as number, positions[a + 1] as number];
  const [ux, uy] = [(positions[b] as number) - ax, (positions[b + 1] as number) - ay];
  const [vx, vy] = [(positions[c] as number) - ax, (positions[c + 1] as number) - ay];
  return (ux * vy - uy * vx) / 2;
}

/** How many triangles are turned over, with the vertices at other places. */
export function countFlips(positions: ArrayLike<number>, triangles: ArrayLike<number>): number {
  let count = 0;
  for (let t = 0; t < triangles.length; t += 3) if (triangleArea(positions, triangles, t) < 0) count++;
  return count;
}

/** Smallest angle of all triangles, degrees. */
function smallestAngle(positions: ArrayLike<number>, triangles: ArrayLike<number>): number {
  let least = 180;
  for (let t = 0; t < triangles.length; t += 3) {
    for (let k = 0; k < 3; k++) {
      const [a, b, c] = [0, 1, 2].map((j) => 2 * (triangles[t + ((k + j) % 3)] as number)) as [number, number, number];
      const [ux, uy] = [
        (positions[b] as number) - (positions[a] as number),
        (positions[b + 1] as number) - (positions[a + 1] as number),
      ];
      const [vx, vy] = [
        (positions[c] as number) - (positions[a] as number),
        (positions[c + 1] as number) - (positions[a + 1] as number),
      ];
      least = Math.min(least, (Math.abs(Math.atan2(ux * vy - uy * vx, ux * vx + uy * vy)) * 180) / Math.PI);
    }
  }
  return least;
}

/** The spacing s that gives so many vertices: P/s on the border, and inside one for each hexagon of s²·√3/2, less a strip of 0.8 s. */
function spacingFor(shape: Shape, vertices: number): number {
  const area = shapeArea(shape);
  const perimeter = shape.reduce((sum, ring) => sum + perimeterOf(ring), 0);
  const hexagon = Math.sqrt(3) / 2;
  // vertices·s² − P·(1 − 0.8/hexagon)·s − area/hexagon = 0
  const linear = perimeter * (1 - 0.8 / hexagon);
  return (linear + Math.sqrt(linear * linear + (4 * vertices * area) / hexagon)) / (2 * vertices);
}

function perimeterOf(ring: ArrayLike<number>): number {
  let length = 0;
  for (let i = 0, j = ring.length - 2; i < ring.length; j = i, i += 2)
    length += Math.hypot((ring[i] as number) - (ring[j] as number), (ring[i + 1] as number) - (ring[j + 1] as number));
  return length;
}

/** The border in even steps. Cutting corners short can make thin parts cross: then they keep more of their own points. */
function evenBorder(shape: Shape, spacing: number): Shape {
  for (const finer of [1, 0.5, 0.25]) {
    const border = shape.map((ring) => resample(ring, spacing * finer));
    try {
      checkShape(border);
      return border;
    } catch {}
  }
  return shape;
}

type Place = [number, number];

function hexagons(border: Shape, spacing: number): Place[] {
  const { low, high } = extentOf(...border);
  const rise = (spacing * Math.sqrt(3)) / 2;
  // From the middle outwards, so that a mirrored shape has a mirrored lattice.
  const [x, y] = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
  const [rows, columns] = [Math.ceil((high[1] - low[1]) / 2 / rise), Math.ceil((high[0] - low[0]) / 2 / spacing) + 1];
  const places: Place[] = [];
  for (let row = -rows; row <= rows; row++)
    for (let column = -columns; column <= columns; column++)
      places.push([x + (column + (row % 2 === 0 ? 0 : 0.5)) * spacing, y + row * rise]);
  return places;
}

/** The border, for the question whether a place keeps its distance; cells of a grid hold the edges near them. */
class Walls {
  readonly #distance: number;
  readonly #size: number;
  readonly #cells = new Map<string, number[]>();

  constructor(border: Shape, distance: number) {
    this.#distance = distance;
    this.#size = 4 * distance;
    for (const ring of border) {
      for (let i = 0, j = ring.length - 2; i < ring.length; j = i, i += 2) {
        const edge = [ring[j], ring[j + 1], ring[i], ring[i + 1]] as [number, number, number, number];
        const { low, high } = extentOf(edge);
        for (let cx = this.#cell(low[0] - distance); cx <= this.#cell(high[0] + distance); cx++)
          for (let cy = this.#cell(low[1] - distance); cy <= this.#cell(high[1] + distance); cy++) {
            const cell = this.#cells.get(`${cx} ${cy}`);
            if (cell) cell.push(...edge);
            else this.#cells.set(`${cx} ${cy}`, [...edge]);
          }
      }
    }
  }

  clear(x: number, y: number): boolean {
    const edges = this.#cells.get(`${this.#cell(x)} ${this.#cell(y)}`) ?? [];
    for (let i = 0; i < edges.length; i += 4) {
      const [ax, ay, bx, by] = [edges[i], edges[i + 1], edges[i + 2], edges[i + 3]] as [number, number, number, number];
      if (segmentDistance(x, y, ax, ay, bx, by) < this.#distance) return false;
    }
    return true;
  }

  #cell(x: number): number {
    return Math.floor(x / this.#size);
  }
}

/** Moves each interior point to the average of the centroids around it, weighted by area (a step of Lloyd's, on the mesh). */
function smooth({ points, triangles }: ConformingTriangulation, border: Shape, lattice: readonly Place[], walls: Walls): Place[] {
  const first = border.reduce((sum, ring) => sum + ring.length / 2, 0);
  const sums = new Float64Array(3 * lattice.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [triangles[t] as number, triangles[t + 1] as number, triangles[t + 2] as number];
    const area = triangleArea(points, triangles, t);
    const [x, y] = [0, 1].map((k) => corners.reduce((sum, corner) => sum + (points[2 * corner + k] as number), 0) / 3) as Place;
    for (const corner of corners) {
      const i = 3 * (corner - first);
      if (i < 0 || i >= sums.length) continue;
      sums[i] = (sums[i] as number) + area * x;
      sums[i + 1] = (sums[i + 1] as number) + area * y;
      sums[i + 2] = (sums[i + 2] as number) + area;
    }
  }
  return lattice.map((place, i) => {
    const area = sums[3 * i + 2] as number;
    if (!(area > 0)) return place;
    const moved: Place = [(sums[3 * i] as number) / area, (sums[3 * i + 1] as number) / area];
    return walls.clear(...moved) ? moved : place;
  });
}

/** Leaves out points that no triangle uses: such as fell onto the border. */
function withoutStrays({ points, triangles, border }: ConformingTriangulation): ConformingTriangulation {
  const numbers = new Int32Array(points.length / 2).fill(-1);
  for (const corner of triangles) numbers[corner] = 0;
  const kept: number[] = [];
  for (let i = 0; i < numbers.length; i++) {
    if (numbers[i] === -1) continue;
    numbers[i] = kept.length / 2;
    kept.push(points[2 * i] as number, points[2 * i + 1] as number);
  }
  const renumber = (i: number) => numbers[i] as number;
  return { points: Float64Array.from(kept), triangles: triangles.map(renumber), border: border.map(renumber) };
}
