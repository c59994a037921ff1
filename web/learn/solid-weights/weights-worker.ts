// Computes weights off the main thread: a solid in, its weights at the surface's vertices out.
import { explain } from '../../ui/explain.ts';
import type { Answer, Question } from './messages.ts';
import { weigh } from './weigh.ts';

const say = (answer: Answer) => postMessage(answer);

addEventListener('message', async ({ data }: MessageEvent<Question>) => {
  // Who asked knows from now on that this script has come.
  say({ part: 0 });
  try {
    say(await weigh(data, (part) => say({ part })));
  } catch (error) {
    say({ told: explain(error) });
  }
});
