import { load } from '../../../wasm/ts/index.ts';
import type { Question, Weights } from './messages.ts';

/** Fills a solid with tetrahedra and computes its weights, at the surface's vertices. */
export async function weigh(question: Question, onProgress: (part: number) => void, signal?: AbortSignal): Promise<Weights> {
  const { handles, resolution, order, bounded } = question;
  const hb = await load();
  const solid = hb.tetrahedralize(question, { resolution });
  const weights = hb.biharmonicWeights(solid, handles, { order });
  if (bounded) await weights.bound({ onProgress, ...(signal && { signal }) });
  const { holds, least, largest, sumError, gradientJump, farWeight } = hb.measureWeights(solid, handles, weights.weights);
  return {
    weights: Float32Array.from(solid.sample(weights.weights)),
    tetrahedra: solid.tetrahedra.length / 4,
    vertices: solid.positions.length / 3,
    measures: { holds, least, largest, sumError, gradientJump, farWeight },
  };
}
