import { bisectRight } from 'd3-array';

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

/** A function known at places in their order, straight between them and level beyond. */
export function through(places: readonly number[], values: ArrayLike<number>) {
  return {
    evaluate: (xs: Float64Array, out: Float64Array) => {
      for (let i = 0; i < xs.length; i++) {
        const x = xs[i] as number;
        const k = Math.min(Math.max(bisectRight(places, x) - 1, 0), places.length - 2);
        const [left = 0, right = 1] = [places[k], places[k + 1]];
        const part = Math.min(Math.max((x - left) / (right - left), 0), 1);
        out[i] = (values[k] ?? 0) + part * ((values[k + 1] ?? 0) - (values[k] ?? 0));
      }
    },
  };
}
