/** Limbs of a baked body by its skeleton: which there are, what they are bent to, and how much volume is in them then. */
import type { BodyData, Irbf, Skeleton } from '../../../wasm/ts/index.ts';

export type Place = readonly [number, number, number];

/** A branch of the skeleton and all that goes on from it. Lengths are in model units. */
export interface Limb {
  readonly branch: number;
  readonly branches: ReadonlySet<number>;
  /** Where it is joined to the rest: the first node of the branch. */
  readonly joint: Place;
  /** Nodes of the branch that are outside of the ball about the joint, and how far along each is from the first. */
  readonly line: readonly Place[];
  readonly along: readonly number[];
  readonly radii: readonly number[];
  /** How many spheres are on its branches. */
  readonly spheres: number;
  /** Positions in `body.voxels` of those that are nearest to its nodes. */
  readonly voxels: readonly number[];
}

const minus = (a: Place, b: Place): Place => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const plus = (a: Place, b: Place): Place => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const times = (a: Place, factor: number): Place => [a[0] * factor, a[1] * factor, a[2] * factor];
const dot = (a: Place, b: Place) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Place, b: Place): Place => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a: Place) => times(a, 1 / Math.hypot(...a));
const squared = (a: Place) => dot(a, a);
const placeAt = (numbers: ArrayLike<number>, i: number, stride = 3) =>
  [numbers[stride * i], numbers[stride * i + 1], numbers[stride * i + 2]] as unknown as Place;

/** The nodes of each branch, as places and distances to the surface. */
export function branchesOf({ skeleton, normalization: { center, diagonal } }: BodyData) {
  const { nodes, steps, lengths } = skeleton as Skeleton;
  let end = 0;
  return Array.from(lengths, (length) => {
    end += length;
    return Array.from(steps.subarray(end - length, end), (node) => ({
      node,
      place: plus(times(placeAt(nodes, node, 4), diagonal), center),
      radius: (nodes[4 * node + 3] as number) * diagonal,
    }));
  });
}

function voxelCells({ voxels, grid: { dimensions } }: BodyData): Place[] {
  const [nx, ny] = dimensions;
  return Array.from(voxels, (linear) => [linear % nx, Math.floor(linear / nx) % ny, Math.floor(linear / (nx * ny))]);
}

/** Where a voxel's center is; halves are its corners. */
const ofCell = ({ grid, normalization: { center, diagonal } }: BodyData, cell: Place) =>
  plus(times(plus(times(cell, grid.spacing), grid.origin), diagonal), center);

/**
 * All that reaches out of the rest by four of its own mean radii and a tenth of the body's diagonal, is thicker than two voxels somewhere,
 * as what is to have three spheres is, and is less than half of the body.
 */
export function limbsOf(body: BodyData): Limb[] {
  const { parents, sphereBranches } = body.skeleton as Skeleton;
  const branches = branchesOf(body);
  const starts = branches.map(([first, ...rest]) => {
    const isInBall = ({ place }: { place: Place }) => first && squared(minus(place, first.place)) <= first.radius ** 2;
    return rest.findLastIndex(isInBall) + 2;
  });
  // What is in the ball about a joint is not the limb's: it goes to what the limb grows from.
  const owned = branches.flatMap((nodes, b) =>
    nodes.map(({ place }, i) => ({ place, branch: i < (starts[b] as number) ? (parents[b] as number) : b })),
  );
  const nearest = voxelCells(body).map((cell) => {
    const [x, y, z] = ofCell(body, cell);
    let [branch, least] = [-1, Infinity];
    for (const each of owned) {
      const away = (each.place[0] - x) ** 2 + (each.place[1] - y) ** 2 + (each.place[2] - z) ** 2;
      if (away < least) [branch, least] = [each.branch, away];
    }
    return branch;
  });
  const limbs = branches.map((nodes, branch): Limb => {
    const within = new Set([branch]);
    parents.forEach((parent, child) => {
      if (within.has(parent)) within.add(child);
    });
    const own = nodes.slice(starts[branch]);
    const along = [0];
    for (let i = 1; i < own.length; i++)
      along.push((along[i - 1] as number) + Math.hypot(...minus(own[i]?.place as Place, own[i - 1]?.place as Place)));
    return {
      branch,
      branches: within,
      joint: nodes[0]?.place as Place,
      line: own.map(({ place }) => place),
      along,
      radii: own.map(({ radius }) => radius),
      spheres: sphereBranches.filter((each) => within.has(each)).length,
      voxels: nearest.flatMap((each, v) => (within.has(each) ? [v] : [])),
    };
  });
  const { diagonal } = body.normalization;
  return limbs.filter(
    ({ along, radii, voxels }) =>
      (along.at(-1) as number) > Math.max(4 * mean(radii), 0.1 * diagonal) &&
      Math.max(...radii) > body.grid.spacing * diagonal &&
      voxels.length < body.voxels.length / 2,
  );
}

/** Turns about an axis of length 1, right-handed. */
function turned(v: Place, axis: Place, angle: number): Place {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return plus(plus(times(v, c), times(cross(axis, v), s)), times(axis, dot(axis, v) * (1 - c)));
}

/** An axis that is square to a direction, and `turn` says which. */
export function axisAcross(direction: Place, turn: number): Place {
  const along = unit(direction);
  const least = along.map(Math.abs).indexOf(Math.min(...along.map(Math.abs)));
  const other = [0, 1, 2].map((d) => Number(d === least)) as unknown as Place;
  return turned(unit(cross(along, other)), along, turn);
}

/**
 * The line bent by `angle` about an axis: evenly between two lengths along it, as an elastic rod between two clamps is, and as one piece
 * beyond. Every step between its nodes keeps its length, so that there is nothing to stretch or squeeze.
 */
export function bentLine({ line, along }: Limb, axis: Place, angle: number, [from, to]: readonly [number, number]): Place[] {
  const places = line.slice(0, 1);
  for (let i = 1; i < line.length; i++) {
    const middle = ((along[i] as number) + (along[i - 1] as number)) / 2;
    const part = Math.max(0, Math.min(1, (middle - from) / (to - from)));
    places.push(plus(places[i - 1] as Place, turned(minus(line[i] as Place, line[i - 1] as Place), axis, part * angle)));
  }
  return places;
}

/** From one node of a line to its last. */
export const toEnd = (line: readonly Place[], from: number): Place => minus(line.at(-1) as Place, line[from] as Place);

/** In degrees. */
export const angleBetween = (a: Place, b: Place) => (Math.atan2(Math.hypot(...cross(a, b)), dot(a, b)) * 180) / Math.PI;

export const lengthOf = (line: readonly Place[]) =>
  line.slice(1).reduce((sum, place, i) => sum + Math.hypot(...minus(place, line[i] as Place)), 0);

/** Where places are under a deformation. */
export function movedLine(irbf: Irbf, line: readonly Place[]): Place[] {
  const moved = irbf.evaluate(line.flat());
  return line.map((_, i) => placeAt(moved, i));
}

/** Six tetrahedra of a cube, one for each path from corner 0 to corner 7, where corner i + 2j + 4k is (i, j, k). */
const TETRAHEDRA = [
  [0, 1, 3, 7],
  [0, 2, 6, 7],
  [0, 4, 5, 7],
  [0, 5, 1, 7],
  [0, 6, 4, 7],
  [0, 3, 2, 7],
] as const;

/** Volume of some of a body's voxels under a deformation, in their volume at rest. Corners are found once. */
export function volumeMeter(body: BodyData, voxels: readonly number[]): (irbf: Irbf) => number {
  const cells = voxelCells(body);
  const numbers = new Map<string, number>();
  const points: number[] = [];
  const corners = voxels.map((v) =>
    Array.from({ length: 8 }, (_, c) => {
      const corner = plus(cells[v] as Place, [(c & 1) - 0.5, ((c >> 1) & 1) - 0.5, (c >> 2) - 0.5]);
      const known = numbers.get(corner.join());
      if (known !== undefined) return known;
      numbers.set(corner.join(), numbers.size);
      points.push(...ofCell(body, corner));
      return numbers.size - 1;
    }),
  );
  const rest = voxels.length * (body.grid.spacing * body.normalization.diagonal) ** 3;
  return (irbf) => {
    const moved = irbf.evaluate(points);
    let sum = 0;
    for (const cube of corners) {
      for (const [a, ...others] of TETRAHEDRA) {
        const start = placeAt(moved, cube[a] as number);
        const [p, q, r] = others.map((corner) => minus(placeAt(moved, cube[corner] as number), start)) as [Place, Place, Place];
        sum += dot(p, cross(q, r)) / 6;
      }
    }
    return sum / rest;
  };
}

export const mean = (values: readonly number[]) => values.reduce((a, b) => a + b, 0) / values.length;
