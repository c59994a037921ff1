import { LAYOUT } from './abi.generated.ts';
import { HandlebodyError } from './errors.ts';
import type { Heap } from './heap.ts';
import { checkShapes } from './interpolant.ts';
import { type RbfOptions, resolve, writeOptions } from './rbf-options.ts';

export type OutlierMethod = 'row-sum' | 'leave-one-out' | 'residual';

export interface OutlierOptions
  extends Omit<RbfOptions, 'weightDecay' | 'normalized' | 'centers' | 'robust' | 'smoothing' | 'onWarning'> {
  /**
   * `'residual'`: the distance of the value from the smoothed interpolant. `'leave-one-out'`: what the function norm wᵀRw loses without the
   * point, exactly. `'row-sum'`: the point's row of that norm, which only approximates it (2014 course, §5.3) and may name a neighbor.
   */
  readonly method?: OutlierMethod;
  /** λ of R + λI. `'auto'`: ½ for kernels with a width; for r, r³ and the like, the points' spacing to the same power. */
  readonly smoothing?: number | 'auto';
  /** Robust standard deviations above the median score. */
  readonly threshold?: number;
  /** How many to look for at the most. */
  readonly most?: number;
}

export const OUTLIER_DEFAULTS = { method: 'residual', smoothing: 'auto', threshold: 8, most: 10 } as const;

const METHODS: readonly OutlierMethod[] = ['row-sum', 'leave-one-out', 'residual'];

/** The same report whatever the method. */
export interface OutlierReport {
  readonly method: OutlierMethod;
  /** Points, in the order in which they were found and taken out. */
  readonly outliers: readonly number[];
  /** The score of each when it was found, in robust standard deviations above the median. */
  readonly heights: readonly number[];
  readonly threshold: number;
  /** Scores of all points before any is taken out, in units of the values (residual) or of the function norm; row sums may be negative. */
  readonly scores: Float64Array;
  /** The λ that was used. */
  readonly smoothing: number;
}

/** Looks for points that an interpolant has to bend for, one after another: after each the fit is made again without it. */
export function findOutliers(heap: Heap, options: OutlierOptions): OutlierReport {
  const { method, smoothing, threshold, most } = { ...OUTLIER_DEFAULTS, ...options };
  const number = METHODS.indexOf(method);
  if (number === -1) {
    throw new HandlebodyError('invalid-option', {
      message: `There is no outlier method called "${method}".`,
      remedy: `Use one of: ${METHODS.join(', ')}.`,
      culprit: { kind: 'option', index: -1 },
    });
  }
  if (!Number.isInteger(most) || most < 0) {
    throw new HandlebodyError('invalid-option', {
      message: `The most outliers to look for are ${most}.`,
      remedy: 'Give a whole number.',
      culprit: { kind: 'option', index: -1 },
    });
  }
  const { count, outputs } = checkShapes(options);
  // There are no more to find, whatever is asked for.
  const room = Math.min(most, count);
  const { smoothing: _, ...rest } = options;
  const resolved = resolve(heap, rest);
  try {
    return heap.scope((scratch) => {
      const at = writeOptions(heap, scratch, { ...resolved, smoothing: smoothing === 'auto' ? -1 : smoothing });
      const points = scratch.putF64(options.points);
      const values = scratch.putF64(options.values);
      const scores = scratch.reserve(8 * count);
      const outliers = scratch.reserve(4 * room);
      const heights = scratch.reserve(8 * room);
      const layout = LAYOUT.hb_outlier_search;
      const search = scratch.reserve(layout.sizeof);
      heap.f64(search + layout.threshold, 1)[0] = threshold;
      const words = heap.u32(search, layout.sizeof / 4);
      words[layout.method / 4] = number;
      words[layout.most / 4] = room;
      words[layout.scores / 4] = scores;
      words[layout.outliers / 4] = outliers;
      words[layout.heights / 4] = heights;
      heap.check((e) => e.hb_find_outliers(points, values, count, options.dimension, outputs, at, search));
      const length = heap.u32(search + layout.outlier_count, 1)[0] as number;
      return {
        method,
        outliers: [...heap.u32(outliers, length)],
        heights: [...heap.f64(heights, length)],
        threshold,
        scores: heap.f64(scores, count).slice(),
        smoothing: heap.f64(search + layout.smoothing, 1)[0] as number,
      };
    });
  } catch (error) {
    heap.kernels.throwFailure(error);
    throw error;
  } finally {
    heap.kernels.remove(resolved.hostKernel);
  }
}
