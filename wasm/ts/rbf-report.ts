import type { KernelName } from './kernels.ts';

/** How good a fit is. Lengths in units of the points. */
export interface RbfReport {
  readonly kernel: KernelName | 'custom' | 'tension';
  /** The width that was used, or the mean of several. */
  readonly width: number;
  readonly degree: number;
  readonly centers: number;
  /** Estimated 1-norm condition number: of sixteen digits, as many may be lost as it has. */
  readonly condition: number;
  /** Largest misfit at a point. */
  readonly residual: number;
  /** Mean distance of a point to its nearest neighbor; 0 for a single point. */
  readonly spacing: number;
  readonly warnings: readonly RbfWarning[];
}

export type RbfWarningCode =
  | 'ill-conditioned'
  | 'narrow-width'
  | 'near-duplicates'
  | 'merged-duplicates'
  | 'misses-points'
  | 'not-definite'
  | 'unequal-widths'
  | 'uneven-axes';

/** Something that a fit survives and its user should know: a stable code for programs, sentences for people. */
export interface RbfWarning {
  readonly code: RbfWarningCode;
  readonly message: string;
  readonly remedy: string;
  /** The points concerned, where there are any. */
  readonly points?: readonly number[];
  /** Options that would do better. */
  readonly suggestion?: {
    readonly width?: number;
    readonly smoothing?: number;
    readonly weightDecay?: number;
    readonly normalized?: true;
    readonly metric?: readonly number[];
  };
}

/** Prints a warning where no `onWarning` was given. */
export function printWarning({ message, remedy }: Pick<RbfWarning, 'message' | 'remedy'>): void {
  console.warn(`${message} ${remedy}`);
}
