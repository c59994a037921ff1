import { line } from 'd3-shape';

/** How far outside the picture a curve is followed, in pixels: beyond it only its direction matters. */
const FAR = 4000;

/** An SVG path through places given in pixels by two affine maps: [x·ax + bx, y·ay + by]. Not-a-number leaves a gap. */
export function curvePath(
  xs: Float64Array,
  ys: ArrayLike<number>,
  [ax, bx, ay, by]: readonly [number, number, number, number],
  stride = 1,
  first = 0,
): string {
  const value = (i: number) => (ys[first + i * stride] as number) * ay + by;
  const pen = line<number>(
    (x) => x * ax + bx,
    (_, i) => Math.min(Math.max(value(i), -FAR), FAR),
  ).digits(1);
  return pen.defined((_, i) => !Number.isNaN(value(i)))(xs as unknown as number[]) ?? '';
}

/** Places for labels beside each other, from where they would like to be: at least `gap` apart, between two ends, in the same order. */
export function spreadLabels(wanted: readonly number[], gaps: readonly number[], low: number, high: number): number[] {
  const order = wanted.map((_, i) => i).sort((a, b) => (wanted[a] as number) - (wanted[b] as number));
  const at = [...wanted];
  const half = (i: number) => (gaps[i] as number) / 2;
  let edge = low;
  for (const i of order) {
    at[i] = Math.max(at[i] as number, edge + half(i));
    edge = (at[i] as number) + half(i);
  }
  edge = high;
  for (const i of order.reverse()) {
    at[i] = Math.min(at[i] as number, edge - half(i));
    edge = (at[i] as number) - half(i);
  }
  return at;
}
