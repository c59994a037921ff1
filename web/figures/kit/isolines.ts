import { ticks } from 'd3-array';
import { contours } from 'd3-contour';

/** More lines than these say nothing more. */
const MOST = 40;

/** Levels for lines of equal value: about eight in a range, and on at the same step to where the field goes beyond it. */
export function levels(low: number, high: number, field: ArrayLike<number>): number[] {
  const inside = ticks(low, high, 8);
  const step = inside.length > 1 ? (inside[1] as number) - (inside[0] as number) : high - low;
  let [least, most] = [low, high];
  for (let i = 0; i < field.length; i++) {
    const value = field[i] as number;
    if (value < least) least = value;
    if (value > most) most = value;
  }
  const reach = ((MOST - inside.length) / 2) * step;
  const [from, to] = [Math.max(least, low - reach), Math.min(most, high + reach)];
  const first = Math.ceil(from / step - 1e-9);
  const last = Math.floor(to / step + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => (first + i) * step);
}

/** Draws lines of equal value of a field of size × size samples, row by row from above, over a square of `pixels`. */
export function drawIsolines(
  context: CanvasRenderingContext2D,
  field: Float64Array,
  size: number,
  pixels: number,
  at: readonly number[],
  color: (level: number) => string,
): void {
  const generator = contours().size([size, size]).smooth(true);
  const scale = pixels / size;
  for (const level of at) {
    context.beginPath();
    // Rings close along the field's border, half a sample outside of it: beyond the canvas, so unseen.
    for (const polygon of generator.contour(field as unknown as number[], level).coordinates)
      for (const ring of polygon) trace(context, ring, scale);
    context.strokeStyle = color(level);
    context.stroke();
  }
}

function trace(context: CanvasRenderingContext2D, ring: readonly (readonly number[])[], scale: number): void {
  ring.forEach(([x = 0, y = 0], i) => {
    if (i === 0) context.moveTo(x * scale, y * scale);
    else context.lineTo(x * scale, y * scale);
  });
}
