import { type Culprit, HandlebodyError } from './errors.ts';

/** Something about a skin's weights that was mended. `message` and `remedy` are to be shown to people, `code` is stable. */
export interface SkinWarning {
  readonly code: 'weights-not-one';
  readonly message: string;
  readonly remedy: string;
  /** The vertex whose weights are farthest from a sum of 1. */
  readonly culprit: Culprit;
  /** That sum. */
  readonly sum: number;
}

/** Rows nearer to a sum of 1 than this stay as they are, bit by bit: the solver takes them as exact (core/skinning/linear_blend.hpp). */
const EXACT = 1e-9;

/**
 * Weights are stored in bytes at the coarsest, each to half a step of 1/255, and glTF has eight a vertex at most: so far a sum may be off
 * that was 1 when the weights were rounded, and no warning is worth while.
 */
const HALF_STEP = 0.5 / 255;
const MOST_ROUNDED = 8;

const REMEDY = 'Give every vertex weights that sum to 1, or say normalize: false to have weights as they are.';

/** What is left of a row's weights by their signs canceling: below this part of their size a sum says nothing, and no row can be mended. */
const LEAST_SUM = 1e-3;

/**
 * The weights (n × handles) with rows that sum to 1: the array itself where they do. Throws 'weights-missing' for a row whose sum is not
 * positive. Rows with a number that single precision cannot hold are left for the solver, which names it.
 */
export function withSumsOfOne(
  weights: ArrayLike<number>,
  handles: number,
  onWarning: (warning: SkinWarning) => void,
): ArrayLike<number> {
  let mended: Float64Array | undefined;
  let rows = 0;
  let [worst, worstSum] = [0, 1];
  for (let first = 0; first < weights.length; first += handles) {
    let [sum, size, held, largest] = [0, 0, 0, 0];
    for (let j = first; j < first + handles; j++) {
      const weight = weights[j] as number;
      sum += weight;
      size += Math.abs(weight);
      largest = Math.max(largest, Math.abs(weight));
      if (weight !== 0) held++;
    }
    const off = Math.abs(sum - 1);
    if (off <= EXACT || !Number.isFinite(Math.fround(largest))) continue;
    const vertex = first / handles;
    if (!(sum > LEAST_SUM * size)) throw noSum(vertex, sum);
    mended ??= Float64Array.from(weights);
    for (let j = first; j < first + handles; j++) mended[j] = (mended[j] as number) / sum;
    if (off <= HALF_STEP * Math.min(held, MOST_ROUNDED)) continue;
    rows++;
    if (off > Math.abs(worstSum - 1)) [worst, worstSum] = [vertex, sum];
  }
  if (rows > 0) {
    onWarning({
      code: 'weights-not-one',
      message: `The weights of ${rows} ${rows === 1 ? 'vertex' : 'vertices'} do not sum to 1, and were divided by their sum. It is farthest from 1 at vertex ${worst}: ${worstSum}.`,
      remedy: REMEDY,
      culprit: { kind: 'vertex', index: worst },
      sum: worstSum,
    });
  }
  return mended ?? weights;
}

function noSum(vertex: number, sum: number): HandlebodyError {
  return new HandlebodyError('weights-missing', {
    message: `The weights of vertex ${vertex} sum to ${sum}, which no division makes 1.`,
    remedy: REMEDY,
    culprit: { kind: 'vertex', index: vertex },
  });
}
