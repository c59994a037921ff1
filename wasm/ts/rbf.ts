import type { RuntimeExports } from './abi.generated.ts';
import { options } from './arguments.ts';
import type { Heap } from './heap.ts';
import { Interpolant } from './interpolant.ts';
import type { KernelName } from './kernels.ts';
import { RBF_DEFAULTS, RBF_READERS, type RbfOptions, type ReadRbf, resolve, writeOptions } from './rbf-options.ts';
import { readReport } from './rbf-read-report.ts';
import { printWarning, type RbfReport } from './rbf-report.ts';

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
  readonly #options: ReadRbf;
  #report: RbfReport | undefined;

  /** @internal Use `Handlebody.rbf`. */
  constructor(heap: Heap, given: RbfOptions) {
    const read = options(given, RBF_READERS, RBF_DEFAULTS);
    const resolved = resolve(heap, read);
    try {
      super(
        heap,
        read,
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
    this.owned.kernel = resolved.hostKernel;
    this.#options = read;
    try {
      for (const warning of this.report().warnings) (read.onWarning ?? printWarning)(warning);
    } catch (error) {
      this.dispose();
      throw error;
    }
  }

  /** How good the fit is, and its warnings. */
  report(): RbfReport {
    this.#report ??= readReport(this.heap, this.handle, {
      kernel: this.#kernel,
      degree: this.#degree,
      options: this.#options,
      dimension: this.dimension,
      merged: this.merged,
    });
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

  #read(length: number, run: (exports: RuntimeExports, out: number) => number): Float64Array {
    return this.heap.scope((scratch) => {
      const out = scratch.reserve(8 * length);
      this.heap.check((e) => run(e, out));
      this.heap.kernels.throwFailure();
      return this.heap.f64(out, length).slice();
    });
  }
}
