import type { HandlebodyRuntime, Irbf, IrbfOptions, SolveReport } from '../../../wasm/ts/runtime.ts';
import type { BodyData } from '../../../wasm/ts/types.ts';
import { ballEnds } from '../../three/ball-images.ts';
import { rows } from './space-points.ts';

/** Iterations between two looks at the clock, and milliseconds of a frame for them. */
const ITERATIONS = 4;
const A_FRAME = 6;
/** From rest, for what is only looked at when it has settled. */
const TO_THE_END = { maxIterations: 300, tolerance: 1e-7 };

/** A baked body, its interior distances at work, held by handles at points inside. */
export class HeldBody {
  readonly irbf: Irbf;
  /** Of the mesh that was baked, as they are now. */
  readonly positions: Float32Array;
  /** Ends of three diameters of each sphere, as they are now: 18 numbers a sphere. */
  readonly ends: Float64Array;
  readonly #restEnds: Float64Array;
  readonly #radii: readonly number[];

  /** `handles`: three numbers each, model units. */
  constructor(hb: HandlebodyRuntime, body: BodyData, handles: readonly number[], options: IrbfOptions) {
    const { spheres, normalization } = body;
    this.irbf = hb.irbf(body, options);
    this.irbf.setHandles(rows(handles).map((at) => ({ at })));
    this.positions = new Float32Array(body.mesh.positions.length);
    const count = spheres.length / 4;
    this.#radii = Array.from({ length: count }, (_, b) => (spheres[4 * b + 3] ?? 0) * normalization.diagonal);
    this.#restEnds = ballEnds(body);
    this.ends = new Float64Array(this.#restEnds.length);
  }

  /** Where the handles are to go. */
  pull(places: readonly number[]): void {
    for (let i = 0; i < places.length / 3; i++)
      for (let axis = 0; axis < 3; axis++) this.irbf.targets[10 * i + axis] = places[3 * i + axis] as number;
  }

  /** A few iterations, and the shape after them. Whether it still moves. */
  follow(): boolean {
    const end = performance.now() + A_FRAME;
    let converged = false;
    while (!converged && performance.now() < end) converged = this.irbf.solve({ maxIterations: ITERATIONS }).converged;
    this.#take();
    return !converged;
  }

  /** Until nothing moves any more. */
  settle(): SolveReport {
    const report = this.irbf.solve(TO_THE_END);
    this.#take();
    return report;
  }

  /** How far the spheres are from rigid: the root mean square of ½ |FᵀF − I|, F a sphere's linear part. */
  get strain(): number {
    let sum = 0;
    this.#radii.forEach((radius, b) => {
      const column = (axis: number, k: number) =>
        ((this.ends[18 * b + 6 * axis + 3 + k] as number) - (this.ends[18 * b + 6 * axis + k] as number)) / (2 * radius);
      for (let i = 0; i < 3; i++) {
        for (let j = 0; j < 3; j++) {
          let product = i === j ? -1 : 0;
          for (let k = 0; k < 3; k++) product += column(i, k) * column(j, k);
          sum += (product / 2) ** 2;
        }
      }
    });
    return Math.sqrt(sum / this.#radii.length);
  }

  /** The largest stretch along a line of points in space (n×3, model units), from each to the next. */
  stretch(line: Float64Array): number {
    const image = this.irbf.evaluate(line);
    const step = (p: Float64Array, i: number) =>
      Math.hypot(...[0, 1, 2].map((k) => (p[i + k] as number) - (p[i - 3 + k] as number)));
    let most = 0;
    for (let i = 3; i < line.length; i += 3) most = Math.max(most, step(image, i) / step(line, i));
    return most;
  }

  dispose(): void {
    this.irbf.dispose();
  }

  #take(): void {
    this.irbf.deform(this.positions);
    this.irbf.evaluate(this.#restEnds, this.ends);
  }
}
