import { type Exports, LAYOUT } from './abi.generated.ts';
import type { Heap } from './heap.ts';
import { Interpolant } from './interpolant.ts';
import type { KernelName } from './kernels.ts';
import { type RbfOptions, resolve, writeOptions } from './rbf-options.ts';
import type { RbfReport, RbfWarning } from './rbf-report.ts';
import { warningsOf } from './rbf-warnings.ts';

/**
 * Radial basis interpolation (2014 course, §4.4 and §5): f(x) = Σ wᵢ φ(‖x − xᵢ‖/width) + polynomial. Factored once; evaluated, with
 * gradients and weights, as often as you like.
 *
 * ```ts
 * const f = hb.rbf({ dimension: 2, points: [0, 0, 1, 0, 0, 1, 1, 1], values: [0, 1, 1, 0], kernel: 'multiquadric' });
 * f.evaluate([0.5, 0.5]);
 * f.report().condition;
 * ```
 */
export class Rbf extends Interpolant {
  readonly #kernel: KernelName | 'custom';
  readonly #degree: number;
  readonly #hostKernel: number;
  readonly #options: RbfOptions;
  #report: RbfReport | undefined;

  /** @internal Use `Handlebody.rbf`. */
  constructor(heap: Heap, options: RbfOptions) {
    const resolved = resolve(heap, options);
    try {
      super(
        heap,
        options,
        (e, { points, values, count, dimension, outputs, out }, at) =>
          e.hb_rbf_create(points, values, count, dimension, outputs, at, out),
        (scratch) => writeOptions(heap, scratch, resolved),
      );
    } catch (error) {
      heap.kernels.remove(resolved.hostKernel);
      heap.kernels.throwFailure(error);
      throw error;
    }
    this.#kernel = resolved.name;
    this.#degree = resolved.degree;
    this.#hostKernel = resolved.hostKernel;
    this.#options = options;
    const tell = options.onWarning ?? ((warning: RbfWarning) => console.warn(`${warning.message} ${warning.remedy}`));
    for (const warning of this.report().warnings) tell(warning);
  }

  /** What the fit is worth, and what to mind. */
  report(): RbfReport {
    this.#report ??= this.#readReport();
    return this.#report;
  }

  /** The kernels' coefficients w, centers × outputs. */
  coefficients(): Float64Array {
    return this.#read(this.report().centers * this.outputs, (e, out) => e.hb_rbf_coefficients(this.handle, out));
  }

  /**
   * For each point and output the value less what the fit without that point predicts (size × outputs): exact, without refitting. Not for
   * normalized kernels and robust fits.
   */
  leaveOneOut(): Float64Array {
    return this.#read(this.size * this.outputs, (e, out) => e.hb_rbf_leave_one_out(this.handle, out));
  }

  /** How much each point counts: 1, or less where a robust fit mistrusts it. */
  rowWeights(): Float64Array {
    return this.#read(this.size, (e, out) => e.hb_rbf_row_weights(this.handle, out));
  }

  override dispose(): void {
    super.dispose();
    this.heap.kernels.remove(this.#hostKernel);
  }

  #read(length: number, run: (exports: Exports, out: number) => number): Float64Array {
    return this.heap.scope((scratch) => {
      const out = scratch.reserve(8 * length);
      this.heap.check((e) => run(e, out));
      this.heap.kernels.throwFailure();
      return this.heap.f64(out, length).slice();
    });
  }

  #readReport(): RbfReport {
    const layout = LAYOUT.hb_rbf_report;
    const [numbers, counts] = this.heap.scope((scratch) => {
      const out = scratch.reserve(layout.sizeof);
      this.heap.check((e) => e.hb_rbf_get_report(this.handle, out));
      return [
        this.heap.f64(out, layout.center_count / 8).slice(),
        this.heap.u32(out + layout.center_count, (layout.sizeof - layout.center_count) / 4).slice(),
      ] as const;
    });
    const number = (name: 'condition' | 'residual' | 'spacing' | 'least_width' | 'largest_width') =>
      numbers[layout[name] / 8] as number;
    const suggestion = (name: 'suggested_width' | 'suggested_smoothing') => numbers[layout[name] / 8] || undefined;
    const nearCount = counts[1] as number;
    const pairs = Array.from(
      { length: Math.min(nearCount, 8) },
      (_, k) => [counts[2 + 2 * k], counts[3 + 2 * k]] as [number, number],
    );
    const base = {
      kernel: this.#kernel,
      width: (number('least_width') + number('largest_width')) / 2,
      degree: this.#degree,
      centers: counts[0] as number,
      condition: number('condition'),
      residual: number('residual'),
      spacing: number('spacing'),
    };
    const warnings = warningsOf(base, {
      options: this.#options,
      dimension: this.dimension,
      merged: this.merged,
      nearCount,
      pairs,
      suggestedWidth: suggestion('suggested_width'),
      suggestedSmoothing: suggestion('suggested_smoothing'),
    });
    return { ...base, warnings };
  }
}
