import type { Ring } from './shape.ts';

/** A signed distance or something like it: negative inside. */
type Field = (x: number, y: number) => number;

/**
 * The closed line on which a smooth field is zero, from a place near it, in steps of `step`: along the line, then back onto it by Newton's
 * method. Counter-clockwise around negative values. Stops after `most` points.
 */
export function traceLevelSet(field: Field, [x, y]: readonly [number, number], step: number, most = 4000): Ring {
  const out: number[] = [];
  [x, y] = ontoLevel(field, x, y, step);
  const [startX, startY] = [x, y];
  for (let i = 0; i < most; i++) {
    out.push(x, y);
    const [gx, gy] = gradient(field, x, y, step / 100);
    const length = Math.hypot(gx, gy) || 1;
    [x, y] = ontoLevel(field, x - (gy / length) * step, y + (gx / length) * step, step);
    if (i > 2 && Math.hypot(x - startX, y - startY) < step * 0.75) break;
  }
  return Float64Array.from(out);
}

function ontoLevel(field: Field, x: number, y: number, step: number): [number, number] {
  for (let k = 0; k < 4; k++) {
    const value = field(x, y);
    const [gx, gy] = gradient(field, x, y, step / 100);
    const squared = gx * gx + gy * gy;
    if (squared < 1e-12) break;
    x -= (value * gx) / squared;
    y -= (value * gy) / squared;
  }
  return [x, y];
}

function gradient(field: Field, x: number, y: number, d: number): [number, number] {
  return [(field(x + d, y) - field(x - d, y)) / (2 * d), (field(x, y + d) - field(x, y - d)) / (2 * d)];
}

/** Distance from a capsule: all within a radius of a segment; the radius changes evenly from one end to the other. */
export function capsule(ax: number, ay: number, bx: number, by: number, radius: number, radiusAtB = radius): Field {
  const [dx, dy] = [bx - ax, by - ay];
  const squared = dx * dx + dy * dy || 1;
  return (x, y) => {
    const t = Math.min(Math.max(((x - ax) * dx + (y - ay) * dy) / squared, 0), 1);
    return Math.hypot(x - ax - t * dx, y - ay - t * dy) - radius - (radiusAtB - radius) * t;
  };
}

/** Several shapes as one, with fillets of about `fillet` where they meet. */
export function smoothUnion(fields: readonly Field[], fillet: number): Field {
  return (x, y) => {
    let sum = 0;
    let least = Infinity;
    const values = fields.map((field) => {
      const value = field(x, y);
      if (value < least) least = value;
      return value;
    });
    for (const value of values) sum += Math.exp((least - value) / fillet);
    return least - fillet * Math.log(sum);
  };
}
