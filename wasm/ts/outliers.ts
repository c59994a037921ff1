import { LAYOUT } from './abi.generated.ts';
import { named, notNegative, options, positive, type Readers, whole } from './arguments.ts';
import type { Heap } from './heap.ts';
import { checkShapes } from './interpolant.ts';
import { RBF_DEFAULTS, RBF_READERS, type RbfOptions, resolve, writeOptions } from './rbf-options.ts';

export type OutlierMethod = 'row-sum' | 'leave-one-out' | 'residual';

export interface OutlierOptions extends Omit<RbfOptions, 'weightDecay' | 'normalized' | 'centers' | 'robust' | 'smoothing'> {
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

const { weightDecay, normalized, centers, robust, ...FIT } = RBF_READERS;
const READERS = {
  ...FIT,
  method: named(METHODS),
  smoothing: named(['auto'], notNegative, 'a number from 0 on'),
  threshold: positive,
  most: whole(0, 0xffff_ffff),
} satisfies Readers<OutlierOptions>;

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
export function findOutliers(heap: Heap, given: OutlierOptions): OutlierReport {
  const read = options(given, READERS, { ...RBF_DEFAULTS, ...OUTLIER_DEFAULTS });
  const { method, smoothing, threshold, points, values, dimension } = read;
  const { count, outputs } = checkShapes(read);
  // No more can be found than there are.
  const most = Math.min(read.most, count);
  const resolved = resolve(heap, { ...RBF_DEFAULTS, ...read, smoothing: 0, centers: undefined, robust: undefined });
  try {
    return heap.scope((scratch) => {
      const at = writeOptions(heap, scratch, { ...resolved, smoothing: smoothing === 'auto' ? -1 : smoothing });
      const pointsAt = scratch.putF64(points);
      const valuesAt = scratch.putF64(values);
      const scores = scratch.reserve(8 * count);
      const outliers = scratch.reserve(4 * most);
      const heights = scratch.reserve(8 * most);
      const layout = LAYOUT.hb_outlier_search;
      const search = scratch.reserve(layout.sizeof);
      heap.f64(search + layout.threshold, 1)[0] = threshold;
      const words = heap.u32(search, layout.sizeof / 4);
      words[layout.method / 4] = METHODS.indexOf(method);
      words[layout.most / 4] = most;
      words[layout.scores / 4] = scores;
      words[layout.outliers / 4] = outliers;
      words[layout.heights / 4] = heights;
      heap.check((e) => e.hb_find_outliers(pointsAt, valuesAt, count, dimension, outputs, at, search));
      // A smoothing that is tried, and fails by a kernel, is passed over by the solver.
      heap.kernels.throwFailure();
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
