/** Bodies in space as data: limbs are chains of balls, and a tree of limbs says which of them flow into each other. */

type Point = readonly [x: number, y: number, z: number];

/** A place on a limb's middle line, and how thick the limb is there. */
export type Ball = readonly [x: number, y: number, z: number, radius: number];

export interface Limb {
  /** A smooth curve runs through their centers; radii go evenly from one to the next. */
  readonly balls: readonly Ball[];
  /** Makes the limb thinner along a unit direction, to a part of its radius: wings and ears. */
  readonly flat?: { readonly along: Point; readonly to: number };
  /** What the end of the limb is called; ends that only round something off have no name. */
  readonly tip?: string;
  /** Limbs that grow out of this one, and the size of the fillets where they do. */
  readonly limbs?: readonly Limb[];
  readonly fillet?: number;
}

export interface Solid {
  /** Negative inside, zero on the surface, about the distance from it. */
  readonly distance: (x: number, y: number, z: number) => number;
  /** How thick the nearest limb is: what triangles there have to be smaller than. */
  readonly radius: (x: number, y: number, z: number) => number;
  /** The least radius of all limbs. */
  readonly thinnest: number;
  /** A box around all. */
  readonly low: Point;
  readonly high: Point;
  /** Where limbs end: places on the surface. */
  readonly tips: ReadonlyMap<string, Point>;
}

const FILLET = 0.08;

/** Pieces of the curve from one ball to the next. */
const PIECES = 6;

/**
 * A body of limbs. A limb flows into the one that it grows from and, right at the root, into its neighbors there. All others stay
 * apart however near they come: a smooth union of everything would glue a hanging trunk to a foreleg.
 */
export function solid(root: Limb): Solid {
  const node = toNode(root);
  const low: [number, number, number] = [Infinity, Infinity, Infinity];
  const high: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  const tips = new Map<string, Point>();
  let thinnest = Infinity;
  visit(node, ({ chain, limb, flat }) => {
    for (let i = 0; i < chain.length; i += 4) {
      for (const axis of [0, 1, 2] as const) {
        low[axis] = Math.min(low[axis], (chain[i + axis] as number) - (chain[i + 3] as number));
        high[axis] = Math.max(high[axis], (chain[i + axis] as number) + (chain[i + 3] as number));
      }
    }
    for (let i = 3; i < chain.length; i += 4) thinnest = Math.min(thinnest, (chain[i] as number) / (flat?.stretch ?? 1));
    if (limb.tip) tips.set(limb.tip, endOf(chain, flat));
  });
  return {
    distance: (x, y, z) => treeDistance(node, x, y, z, Infinity),
    radius: (x, y, z) => nearestRadius(node, x, y, z).radius,
    thinnest,
    low,
    high,
    tips,
  };
}

interface Node {
  readonly limb: Limb;
  /** x y z radius of points close together on the curve. */
  readonly chain: Float64Array;
  /** A ball around all pieces from one of the limb's balls to the next. */
  readonly spans: readonly Ball[];
  readonly flat: Flat | undefined;
  readonly fillet: number;
  readonly limbs: readonly Node[];
  /** A ball around the limb and all that grow from it. */
  readonly around: Ball;
}

interface Flat {
  readonly along: Point;
  readonly stretch: number;
}

function toNode(limb: Limb): Node {
  const chain = curve(limb.balls);
  const limbs = (limb.limbs ?? []).map(toNode);
  const flat = limb.flat && { along: limb.flat.along, stretch: 1 / limb.flat.to };
  const fillet = limb.fillet ?? FILLET;
  const spans = limb.balls.slice(1).map((_, i) => ballAround(chain.subarray(4 * PIECES * i, 4 * PIECES * (i + 1) + 4)));
  return { limb, chain, spans, flat, fillet, limbs, around: ballAround(chain, limbs, fillet) };
}

function visit(node: Node, see: (node: Node) => void): void {
  see(node);
  for (const each of node.limbs) visit(each, see);
}

/** Catmull and Rom's curve through the balls. */
function curve(balls: readonly Ball[]): Float64Array {
  const out: number[] = [];
  const last = balls.length - 1;
  const at = (i: number) => balls[Math.min(Math.max(i, 0), last)] as Ball;
  for (let i = 0; i < last; i++) {
    const [p, a, b, q] = [at(i - 1), at(i), at(i + 1), at(i + 2)];
    for (let k = 0; k < PIECES; k++) {
      const t = k / PIECES;
      for (const d of [0, 1, 2] as const) {
        const [slopeA, slopeB] = [(b[d] - p[d]) / 2, (q[d] - a[d]) / 2];
        const turn = a[d] - b[d];
        out.push(a[d] + t * (slopeA + t * (-3 * turn - 2 * slopeA - slopeB + t * (2 * turn + slopeA + slopeB))));
      }
      out.push(a[3] + (b[3] - a[3]) * t * t * (3 - 2 * t));
    }
  }
  out.push(...at(last));
  return Float64Array.from(out);
}

/** Where the middle line, drawn on, leaves the last ball. */
function endOf(chain: Float64Array, flat: Flat | undefined): Point {
  const [x, y, z, radius] = chain.subarray(-4) as unknown as Ball;
  const [bx, by, bz] = chain.subarray(-8, -5) as unknown as Point;
  const [dx, dy, dz] = [x - bx, y - by, z - bz];
  const [nx, ny, nz] = flat?.along ?? [0, 0, 0];
  const more = (dx * nx + dy * ny + dz * nz) * ((flat?.stretch ?? 1) - 1);
  const scale = radius / Math.hypot(dx + more * nx, dy + more * ny, dz + more * nz);
  return [x + dx * scale, y + dy * scale, z + dz * scale];
}

function ballAround(chain: Float64Array, limbs: readonly Node[] = [], fillet = 0): Ball {
  const balls: Ball[] = limbs.map(({ around }) => around);
  for (let i = 0; i < chain.length; i += 4) balls.push(chain.subarray(i, i + 4) as unknown as Ball);
  const middle = [0, 1, 2].map((d) => balls.reduce((sum, ball) => sum + (ball[d] as number), 0) / balls.length);
  const [x, y, z] = middle as [number, number, number];
  return [x, y, z, fillet + Math.max(...balls.map(([bx, by, bz, r]) => Math.hypot(bx - x, by - y, bz - z) + r))];
}

/** The lesser of two distances, less where they are nearer to each other than `width`: a fillet. Elsewhere exactly the lesser. */
function smoothLesser(a: number, b: number, width: number): number {
  const overlap = width - Math.abs(a - b);
  return Math.min(a, b) - (overlap > 0 ? (overlap * overlap) / (4 * width) : 0);
}

/** Distance of a limb with all that grow from it. What is more than `limit` does not matter to the caller, and need not be right. */
function treeDistance(node: Node, x: number, y: number, z: number, limit: number): number {
  const [ax, ay, az, radius] = node.around;
  if (limit < Infinity && (x - ax) ** 2 + (y - ay) ** 2 + (z - az) ** 2 > (radius + Math.max(limit, 0)) ** 2) return Infinity;
  const own = chainDistance(node, x, y, z);
  if (node.limbs.length === 0) return own;
  const { fillet } = node;
  // Neighbors flow into each other only as far out as their common root's fillets reach.
  const between = fillet * Math.min(Math.max(1 - own / (3 * fillet), 0), 1);
  let grown = Infinity;
  for (const each of node.limbs) {
    const value = treeDistance(each, x, y, z, Math.min(own, limit, grown) + 2 * fillet);
    grown = between > 0 && grown < Infinity && value < Infinity ? smoothLesser(grown, value, between) : Math.min(grown, value);
  }
  return grown === Infinity ? own : smoothLesser(own, grown, fillet);
}

/** Distance of a limb alone. */
function chainDistance({ chain, spans, flat }: Node, x: number, y: number, z: number): number {
  return flat ? flatDistance(chain, flat, x, y, z) : nearestPiece(chain, spans, x, y, z).distance;
}

/** The one place where results are kept: an object for each of a million calls would be most of the time. */
const found = { distance: 0, radius: 0 };

/** The distance from a chain, and its radius at the nearest place. */
function nearestPiece(chain: Float64Array, spans: readonly Ball[], x: number, y: number, z: number): typeof found {
  let nearest = Infinity;
  for (let s = 0; s < spans.length; s++) {
    const span = spans[s] as Ball;
    const [sx, sy, sz] = [x - span[0], y - span[1], z - span[2]];
    // A span that is farther away than the nearest piece so far has none that is nearer.
    if (Math.sqrt(sx * sx + sy * sy + sz * sz) - span[3] >= nearest) continue;
    const end = 4 * PIECES * (s + 1);
    for (let i = 4 * PIECES * s + 4; i <= end; i += 4) {
      const px = x - (chain[i - 4] as number);
      const py = y - (chain[i - 3] as number);
      const pz = z - (chain[i - 2] as number);
      const dx = (chain[i] as number) - (chain[i - 4] as number);
      const dy = (chain[i + 1] as number) - (chain[i - 3] as number);
      const dz = (chain[i + 2] as number) - (chain[i - 2] as number);
      const t = Math.min(Math.max((px * dx + py * dy + pz * dz) / (dx * dx + dy * dy + dz * dz || 1), 0), 1);
      const qx = px - t * dx;
      const qy = py - t * dy;
      const qz = pz - t * dz;
      const radius = (chain[i - 1] as number) + ((chain[i + 3] as number) - (chain[i - 1] as number)) * t;
      const distance = Math.sqrt(qx * qx + qy * qy + qz * qz) - radius;
      if (distance >= nearest) continue;
      nearest = distance;
      found.radius = radius;
    }
  }
  found.distance = nearest;
  return found;
}

/** Stretched along its thin direction a flat limb is round; there, a distance over the length of its gradient is one to first order. */
function flatDistance(chain: Float64Array, { along, stretch }: Flat, x: number, y: number, z: number): number {
  const [nx, ny, nz] = along;
  const more = stretch - 1;
  let nearest = Infinity;
  let out = Infinity;
  for (let i = 4; i < chain.length; i += 4) {
    const dx = (chain[i] as number) - (chain[i - 4] as number);
    const dy = (chain[i + 1] as number) - (chain[i - 3] as number);
    const dz = (chain[i + 2] as number) - (chain[i - 2] as number);
    const px = x - (chain[i - 4] as number);
    const py = y - (chain[i - 3] as number);
    const pz = z - (chain[i - 2] as number);
    const up = more * (dx * nx + dy * ny + dz * nz);
    const over = more * (px * nx + py * ny + pz * nz);
    const [ux, uy, uz] = [dx + up * nx, dy + up * ny, dz + up * nz];
    const [vx, vy, vz] = [px + over * nx, py + over * ny, pz + over * nz];
    const t = Math.min(Math.max((vx * ux + vy * uy + vz * uz) / (ux * ux + uy * uy + uz * uz || 1), 0), 1);
    const [qx, qy, qz] = [vx - t * ux, vy - t * uy, vz - t * uz];
    const length = Math.sqrt(qx * qx + qy * qy + qz * qz);
    const distance = length - (chain[i - 1] as number) * (1 - t) - (chain[i + 3] as number) * t;
    if (distance >= nearest) continue;
    nearest = distance;
    const slant = more * (qx * nx + qy * ny + qz * nz);
    out = (distance * length) / (Math.hypot(qx + slant * nx, qy + slant * ny, qz + slant * nz) || 1);
  }
  return out;
}

function nearestRadius(node: Node, x: number, y: number, z: number): { distance: number; radius: number } {
  const { distance, radius } = nearestPiece(node.chain, node.spans, x, y, z);
  const own = node.flat
    ? { distance: flatDistance(node.chain, node.flat, x, y, z), radius: radius / node.flat.stretch }
    : { distance, radius };
  return node.limbs.reduce((best, each) => {
    const other = nearestRadius(each, x, y, z);
    return other.distance < best.distance ? other : best;
  }, own);
}
