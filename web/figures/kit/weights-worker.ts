// Computes weights off the main thread: a solid in, its weights at the surface's vertices out.
import { explain, type Told } from '../../ui/explain.ts';
import { type SolidWeights, type WeightsQuestion, weigh } from './weigh.ts';

/** How far it is, what went wrong, or the weights. */
export type WeightsAnswer = SolidWeights | { readonly part: number } | { readonly told: Told };

const say = (answer: WeightsAnswer) => postMessage(answer);

addEventListener('message', async ({ data }: MessageEvent<WeightsQuestion>) => {
  // Who asked knows from now on that this script has come.
  say({ part: 0 });
  try {
    say(await weigh(data, (part) => say({ part })));
  } catch (error) {
    say({ told: explain(error) });
  }
});
