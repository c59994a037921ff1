import { HandlebodyError } from './errors.ts';
import type { KernelFunction, UserKernel } from './kernels.ts';

/** Distance, relative to s, between the two points of a difference quotient: the cube root of the double's precision. */
const STEP = 6e-6;

/**
 * The callers' kernels of one instance. The solver calls them by number in the middle of its work, so nothing may be thrown through it: a
 * failure is kept, NaN is returned, and `throwFailure()` throws it when the solver has returned.
 */
export class HostKernels {
  readonly #kernels = new Map<number, { value: KernelFunction; derivative: KernelFunction; users: number }>();
  #next = 1;
  #failure: { readonly s: number; readonly got: unknown; readonly thrown: boolean } | undefined;

  add(kernel: KernelFunction | UserKernel): number {
    const value = typeof kernel === 'function' ? kernel : kernel.value;
    const given = typeof kernel === 'function' ? undefined : kernel.derivative;
    const derivative =
      given ??
      ((s: number) => {
        const h = STEP * Math.max(s, 1e-3);
        const low = Math.max(0, s - h);
        return (value(s + h) - value(low)) / (s + h - low);
      });
    this.#kernels.set(this.#next, { value, derivative, users: 1 });
    return this.#next++;
  }

  /** One user more of a kernel that was added; nothing where the number is of none. */
  share(id: number): void {
    const kernel = this.#kernels.get(id);
    if (kernel) kernel.users++;
  }

  /** One user less; the last one's going takes the kernel away. */
  remove(id: number): void {
    const kernel = this.#kernels.get(id);
    if (kernel && --kernel.users === 0) this.#kernels.delete(id);
  }

  clear(): void {
    this.#kernels.clear();
  }

  /** What the solver calls: never throws. */
  readonly call = (id: number, derivative: number, s: number): number => {
    const kernel = this.#kernels.get(id);
    if (!kernel) return Number.NaN;
    try {
      // So far away that the distance overflows, kernels need not know what infinity is.
      const got = (derivative ? kernel.derivative : kernel.value)(Math.min(s, 1e300));
      if (Number.isFinite(got)) return got;
      this.#failure ??= { s, got, thrown: false };
    } catch (error) {
      this.#failure ??= { s, got: error, thrown: true };
    }
    return Number.NaN;
  };

  /** Throws what a kernel did wrong since the last call, as 'kernel-failed'; `error` is the error that the solver made of it. */
  throwFailure(error?: unknown): void {
    const failure = this.#failure;
    if (!failure) return;
    this.#failure = undefined;
    const { s, got, thrown } = failure;
    const what = thrown ? `threw "${got instanceof Error ? got.message : String(got)}"` : `returned ${String(got)}`;
    const solver = error instanceof HandlebodyError && error.code === 'kernel-failed' ? error : undefined;
    throw new HandlebodyError('kernel-failed', {
      message: `Your kernel ${what} at s = ${s}.${solver ? ` ${solver.message}` : ''}`,
      remedy: 'Return a finite number for every s from 0 on (s is the distance over the width).',
      culprit: solver?.culprit,
      cause: thrown ? got : error,
    });
  }
}
