import type { Experiment, Frame } from './experiment.ts';
import type { Fit } from './fit.ts';
import { asLong } from './samples.ts';

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

/** A fit's values at queries, or the chosen point's weight there. */
export class FieldValues {
  values: Float64Array = new Float64Array();
  #all: Float64Array = new Float64Array();

  sample(fit: Fit, queries: Float64Array, cardinalOf: number, { values }: Experiment): Float64Array {
    const count = queries.length / 2;
    this.values = asLong(this.values, count);
    if (cardinalOf < 0 || fit.problem !== undefined) {
      fit.interpolant?.evaluate(queries, this.values);
      return this.values;
    }
    const n = values.length;
    this.#all = asLong(this.#all, count * n);
    fit.interpolant?.weights(queries, this.#all);
    for (let i = 0; i < count; i++) this.values[i] = this.#all[i * n + cardinalOf] as number;
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
