// Computes weights off the main thread: a solid in, its weights at the surface's vertices out.
import { load } from '../../../wasm/ts/index.ts';
import { explain } from '../../ui/explain.ts';
import type { Answer, Question } from './messages.ts';

addEventListener('message', async ({ data }: MessageEvent<Question>) => {
  let answer: Answer;
  try {
    const hb = await load();
    const solid = hb.tetrahedralize(data, { resolution: data.resolution });
    const weights = hb.biharmonicWeights(solid, data.handles, { order: data.order });
    if (data.bounded) await weights.bound({ onProgress: (part) => postMessage({ part } satisfies Answer) });
    const { holds, least, largest, sumError, gradientJump, farWeight } = hb.measureWeights(solid, data.handles, weights.weights);
    answer = {
      weights: Float32Array.from(solid.sample(weights.weights)),
      tetrahedra: solid.tetrahedra.length / 4,
      vertices: solid.positions.length / 3,
      measures: { holds, least, largest, sumError, gradientJump, farWeight },
    };
  } catch (error) {
    answer = { told: explain(error) };
  }
  postMessage(answer);
});
