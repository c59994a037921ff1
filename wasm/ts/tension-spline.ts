import { LAYOUT } from './abi.generated.ts';
import { named, notNegative, options, type Readers } from './arguments.ts';
import type { Heap } from './heap.ts';
import { checkShapes, Interpolant, type ReadData, SCATTERED, type ScatteredData } from './interpolant.ts';
import { readReport } from './rbf-read-report.ts';
import { printWarning, type RbfReport } from './rbf-report.ts';

export interface TensionSplineOptions extends ScatteredData {
  /** Weight of curvature, α ≥ 0; 0 only in 1 dimension. */
  readonly alpha?: number;
  /** Weight of slope, β ≥ 0: the tension. It takes out overshoot over lengths beyond √(α/β). */
  readonly beta?: number;
  /** Weight of the value itself, γ ≥ 0: makes the function decay to 0 over lengths beyond ⁴√(α/γ). */
  readonly gamma?: number;
  /** σ ≥ 0, what divides the misfit: 0 interpolates, 1 is the functional as the course prints it. */
  readonly smoothing?: number;
  /**
   * `'natural'`: the functional is that over all of space. `'zero-slope'`, in 1 dimension without gamma and smoothing: over the points'
   * interval only, flat at both ends and constant beyond (Fig. 11).
   */
  readonly ends?: 'natural' | 'zero-slope';
}

export const TENSION_SPLINE_DEFAULTS = { alpha: 1, beta: 0, gamma: 0, smoothing: 0, ends: 'natural' } as const;

const ENDS = ['natural', 'zero-slope'] as const;

const READERS = {
  ...SCATTERED,
  alpha: notNegative,
  beta: notNegative,
  gamma: notNegative,
  smoothing: notNegative,
  ends: named(ENDS),
} satisfies Readers<TensionSplineOptions>;

/**
 * The spline with tension in 1, 2 or 3 dimensions (2014 course, §4.2 and eq. (2)): the function with the least
 * Σ (f(xᵢ) − yᵢ)²/σ + α ∫(∇²f)² + β ∫|∇f|² + γ ∫f². `beta` trades smoothness for less overshoot, `gamma` makes it fall back to zero
 * where there are no points.
 *
 * ```ts
 * const f = hb.tensionSpline({ dimension: 1, points: [0, 1, 2, 3], values: [0, 0, 1, 1], beta: 10, ends: 'zero-slope' });
 * f.evaluate([0.5, 1.5]);
 * ```
 */
export class TensionSpline extends Interpolant {
  readonly #options: ReadData;
  readonly #degree: number;
  readonly #ends: 'natural' | 'zero-slope';
  #report: RbfReport | undefined;

  /** @internal Use `Handlebody.tensionSpline`. */
  constructor(heap: Heap, given: TensionSplineOptions) {
    const read = options(given, READERS, TENSION_SPLINE_DEFAULTS);
    const { alpha, beta, gamma, smoothing, ends, onWarning = printWarning } = read;
    const kind = ENDS.indexOf(ends);
    const degree = gamma > 0 ? -1 : beta > 0 ? 0 : 1;
    const { count } = checkShapes(read);
    if (kind === 0) heap.check((e) => e.hb_rbf_check_size(count, read.dimension, 0, degree));
    super(
      heap,
      read,
      (e, { points, values, dimension, outputs, out }, how) =>
        e.hb_tension_spline_create(points, values, count, dimension, outputs, how, out),
      (scratch) => {
        const layout = LAYOUT.hb_tension_spline_options;
        const at = scratch.reserve(layout.sizeof);
        const doubles = heap.f64(at, layout.sizeof / 8);
        doubles[layout.alpha / 8] = alpha;
        doubles[layout.beta / 8] = beta;
        doubles[layout.gamma / 8] = gamma;
        doubles[layout.smoothing / 8] = smoothing;
        heap.u32(at, layout.sizeof / 4)[layout.ends / 4] = kind;
        return at;
      },
    );
    this.#options = read;
    this.#degree = degree;
    this.#ends = ends;
    try {
      for (const warning of this.report()?.warnings ?? []) onWarning(warning);
    } catch (error) {
      this.dispose();
      throw error;
    }
  }

  /** How good the fit is, and its warnings; `undefined` for zero-slope ends, whose equations are always well behaved. */
  report(): RbfReport | undefined {
    if (this.#ends === 'zero-slope') return undefined;
    this.#report ??= readReport(this.heap, this.handle, {
      kernel: 'tension',
      degree: this.#degree,
      options: this.#options,
      dimension: this.dimension,
      merged: this.merged,
    });
    return this.#report;
  }
}
