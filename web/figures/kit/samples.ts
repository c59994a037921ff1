/** Left, right, bottom, top: what part of the data's world is in a picture. */
export type Frame = readonly [number, number, number, number];

/** Samples across a frame, besides the points. */
const EVEN = 400;

/** Places on a line at which curves are evaluated: evenly across the frame, and at every point, so that curves pass through them. */
export class Samples {
  #xs = new Float64Array(EVEN + 1);

  /** Sorted; they stay valid until the next call. */
  spread([left, right]: Frame, points: readonly number[]): Float64Array {
    const count = EVEN + 1 + points.length;
    if (this.#xs.length !== count) this.#xs = new Float64Array(count);
    const xs = this.#xs;
    for (let i = 0; i <= EVEN; i++) xs[i] = left + ((right - left) * i) / EVEN;
    for (let i = 0; i < points.length; i++) xs[EVEN + 1 + i] = Math.min(Math.max(points[i] as number, left), right);
    return xs.sort();
  }
}

/** A row of numbers as long as another, reused from frame to frame. */
export function asLong(kept: Float64Array | undefined, length: number): Float64Array {
  return kept?.length === length ? kept : new Float64Array(length);
}
