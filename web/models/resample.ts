import type { Ring } from './shape.ts';

/** A corner is where the direction turns by more than this, in degrees. */
const CORNER = 35;

/**
 * A closed curve with points `spacing` apart as nearly as can be, measured along it. Corners keep their place; between two corners the
 * points are even. A ring has at least eight points, three where it is a triangle of three corners.
 */
export function resample(ring: Ring, spacing: number, corner = CORNER): Ring {
  const n = ring.length / 2;
  const at = (i: number): [number, number] => [ring[2 * (i % n)] as number, ring[2 * (i % n) + 1] as number];
  const lengths = Array.from({ length: n }, (_, i) => distance(at(i), at(i + 1)));
  const corners = Array.from({ length: n }, (_, i) => i).filter((i) => bend(at(i + n - 1), at(i), at(i + 1)) > corner);
  const stops = corners.length > 0 ? corners : [0];
  const total = lengths.reduce((sum, length) => sum + length, 0);
  const most = corners.length > 1 ? spacing : Math.min(spacing, total / 8);
  const out: number[] = [];
  stops.forEach((from, k) => {
    const to = k + 1 < stops.length ? (stops[k + 1] as number) : (stops[0] as number) + n;
    let length = 0;
    for (let i = from; i < to; i++) length += lengths[i % n] as number;
    const pieces = Math.max(1, Math.round(length / most));
    out.push(...at(from));
    let [i, gone] = [from, 0];
    for (let piece = 1; piece < pieces; piece++) {
      const wanted = (length * piece) / pieces;
      while (i < to - 1 && gone + (lengths[i % n] as number) < wanted) gone += lengths[i++ % n] as number;
      const t = Math.min((wanted - gone) / (lengths[i % n] || 1), 1);
      const [[ax, ay], [bx, by]] = [at(i), at(i + 1)];
      out.push(ax + (bx - ax) * t, ay + (by - ay) * t);
    }
  });
  return Float64Array.from(out);
}

/** Leaves out points that lie within `tolerance` of the line through those that stay (Ramer, Douglas and Peucker). */
export function simplify(ring: Ring, tolerance: number): Ring {
  const n = ring.length / 2;
  if (n <= 4) return ring;
  const x = (i: number) => ring[2 * (i % n)] as number;
  const y = (i: number) => ring[2 * (i % n) + 1] as number;
  let far = 0;
  for (let i = 1; i < n; i++) if (Math.hypot(x(i) - x(0), y(i) - y(0)) > Math.hypot(x(far) - x(0), y(far) - y(0))) far = i;
  const keep = new Uint8Array(n);
  keep[0] = keep[far] = 1;
  const spans: [number, number][] = [
    [0, far],
    [far, n],
  ];
  for (let span = spans.pop(); span; span = spans.pop()) {
    const [from, to] = span;
    let [worst, at] = [tolerance, -1];
    for (let i = from + 1; i < to; i++) {
      const off = segmentDistance(x(i), y(i), x(from), y(from), x(to), y(to));
      if (off > worst) [worst, at] = [off, i];
    }
    if (at < 0) continue;
    keep[at] = 1;
    spans.push([from, at], [at, to]);
  }
  const kept = Array.from({ length: n }, (_, i) => i).filter((i) => keep[i] === 1);
  return kept.length < 3 ? ring : Float64Array.from(kept.flatMap((i) => [x(i), y(i)]));
}

/** A ring without points that repeat the one before them, as a last one that closes it does. */
export function withoutRepeats(ring: Ring): Ring {
  const n = ring.length;
  return ring.filter((_, i) => {
    const at = i - (i % 2);
    const before = (at + n - 2) % n;
    return n <= 2 || ring[at] !== ring[before] || ring[at + 1] !== ring[before + 1];
  });
}

/** Distance of a point from a segment. */
export function segmentDistance(px: number, py: number, ax: number, ay: number, bx: number, by: number): number {
  const [dx, dy] = [bx - ax, by - ay];
  const squared = dx * dx + dy * dy;
  const t = squared > 0 ? Math.min(Math.max(((px - ax) * dx + (py - ay) * dy) / squared, 0), 1) : 0;
  return Math.hypot(px - ax - t * dx, py - ay - t * dy);
}

function distance([ax, ay]: [number, number], [bx, by]: [number, number]): number {
  return Math.hypot(bx - ax, by - ay);
}

/** By how many degrees the way from a over b to c turns. */
function bend([ax, ay]: [number, number], [bx, by]: [number, number], [cx, cy]: [number, number]): number {
  const [ux, uy, vx, vy] = [bx - ax, by - ay, cx - bx, cy - by];
  return (Math.abs(Math.atan2(ux * vy - uy * vx, ux * vx + uy * vy)) * 180) / Math.PI;
}
