/** Whether two edges of a polygon of the plane cross between their ends, or are one. */

/** Of pairs that touch, for each edge: neighbors are one, and of four holes with a way to each the ways are a few more. */
const MOST_TOUCHING = 8;

/**
 * Edges in the order of their least x, each compared with those behind it that begin before it ends. Quadratic at worst (a comb on its side), at
 * about a nanosecond a pair; earcut takes some hundred for polygons that cross themselves, of whose corners it tries all pairs.
 *
 * `xy`: n×2. Edges that only touch, or lie on each other, as those to a hole and back do, do not cross; unless they touch all over, or go from
 * one place to another twice.
 */
export function crossesItself(xy: Float64Array): boolean {
  const count = xy.length / 2;
  // The first corner once more: an edge goes from each to the next.
  const at = new Float64Array(xy.length + 2);
  at.set(xy);
  at.set(xy.subarray(0, 2), xy.length);
  const low = (edge: number, axis: number) => Math.min(at[2 * edge + axis] as number, at[2 * edge + 2 + axis] as number);
  const high = (edge: number, axis: number) => Math.max(at[2 * edge + axis] as number, at[2 * edge + 2 + axis] as number);
  const order = new Uint32Array(count).map((_, i) => i).sort((i, j) => low(i, 0) - low(j, 0));
  const starts = Float64Array.from(order, (edge) => low(edge, 0));
  const bottoms = Float64Array.from(order, (edge) => low(edge, 1));
  const tops = Float64Array.from(order, (edge) => high(edge, 1));
  let touching = 0;
  for (let k = 0; k < count; k++) {
    const edge = order[k] as number;
    const [end, bottom, top] = [high(edge, 0), bottoms[k] as number, tops[k] as number];
    const x = at[2 * edge] as number;
    const y = at[2 * edge + 1] as number;
    const dx = (at[2 * edge + 2] as number) - x;
    const dy = (at[2 * edge + 3] as number) - y;
    for (let l = k + 1; l < count && (starts[l] as number) <= end; l++) {
      if ((bottoms[l] as number) > top || (tops[l] as number) < bottom) continue;
      const other = 2 * (order[l] as number);
      const fx = (at[other] as number) - x;
      const fy = (at[other + 1] as number) - y;
      const tx = (at[other + 2] as number) - x;
      const ty = (at[other + 3] as number) - y;
      // One edge twice, in one direction: what lies beside it would be there twice.
      if (fx === 0 && fy === 0 && tx === dx && ty === dy && (dx !== 0 || dy !== 0)) return true;
      // Where the other edge's ends lie on two sides of this one, and this one's on two sides of the other, they cross.
      const across = (dx * fy - dy * fx) * (dx * ty - dy * tx);
      if (across > 0) continue;
      const [ox, oy] = [tx - fx, ty - fy];
      const along = (fx * oy - fy * ox) * ((fx - dx) * oy - (fy - dy) * ox);
      if (along < 0 && across < 0) return true;
      if (along <= 0 && ++touching > MOST_TOUCHING * count) return true;
    }
  }
  return false;
}
