import { asLong, type Frame } from './samples.ts';

/** The samples of a field: size × size, row by row from above, each in the middle of its cell. */
export class FieldGrid {
  size = 0;
  queries = new Float64Array();
  #frame: Frame | undefined;

  lay(frame: Frame, size: number): void {
    if (size === this.size && frame === this.#frame) return;
    [this.size, this.#frame] = [size, frame];
    const [left, right, bottom, top] = frame;
    if (this.queries.length !== 2 * size * size) this.queries = new Float64Array(2 * size * size);
    for (let row = 0, at = 0; row < size; row++) {
      for (let column = 0; column < size; column++) {
        this.queries[at++] = left + ((right - left) * (column + 0.5)) / size;
        this.queries[at++] = top - ((top - bottom) * (row + 0.5)) / size;
      }
    }
  }
}

/** Queries whose weights are asked for at a time: each has as many as there are points, of which one is kept. */
const BATCH = 2048;

/** A function over the plane; an interpolant has the weights of its points too. */
export interface FieldSource {
  evaluate(queries: Float64Array, out: Float64Array): unknown;
  weights?(queries: Float64Array, out: Float64Array): unknown;
}

/** Values at queries, or the weight of one of `points` there. */
export class FieldValues {
  values: Float64Array = new Float64Array();
  #all: Float64Array = new Float64Array();

  sample(source: FieldSource | undefined, queries: Float64Array, point = -1, points = 0): Float64Array {
    const count = queries.length / 2;
    this.values = asLong(this.values, count);
    if (point < 0) {
      source?.evaluate(queries, this.values);
      return this.values;
    }
    this.#all = asLong(this.#all, BATCH * points);
    for (let first = 0; first < count; first += BATCH) {
      const batch = Math.min(BATCH, count - first);
      const all = this.#all.subarray(0, batch * points);
      source?.weights?.(queries.subarray(2 * first, 2 * (first + batch)), all);
      for (let i = 0; i < batch; i++) this.values[first + i] = all[i * points + point] as number;
    }
    return this.values;
  }
}

/** Milliseconds that a frame may take for its fields, and the last picture, drawn at leisure. */
const BUDGET = { moving: 9, resting: 160 };
const SIZES = { least: 24, moving: 88, resting: 160 };

/** How many samples a field may have, from what the last ones took. */
export class Pace {
  /** Milliseconds a sample of each field, all fields together; from the last frames. */
  #cost = 0;

  size(resting: boolean): number {
    const [budget, most] = resting ? [BUDGET.resting, SIZES.resting] : [BUDGET.moving, SIZES.moving];
    if (this.#cost === 0) return 48;
    const fitting = Math.sqrt(budget / this.#cost);
    return Math.min(Math.max(Math.floor(fitting / 8) * 8, SIZES.least), most);
  }

  took(milliseconds: number, size: number): void {
    const cost = milliseconds / size ** 2;
    this.#cost = this.#cost === 0 ? cost : this.#cost * 0.7 + cost * 0.3;
  }
}
