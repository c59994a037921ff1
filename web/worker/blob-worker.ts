/**
 * Both workers as one script that needs no file beside it: it is in the library as text (`blob-worker.generated.ts`), for bundlers that make
 * no worker of a file's address, and for pages of another origin. The page sends the compiled solver along.
 */
import { Handlebody } from '../../wasm/ts/handlebody.ts';
import { instantiate } from '../../wasm/ts/load.ts';
import { answer, type BakeAnswer, type BakeQuestion, baked, type WorkPort } from './answer.ts';
import { type SolidWeights, type WeightsQuestion, weighed } from './weigh.ts';

answer<BakeQuestion | WeightsQuestion, BakeAnswer | SolidWeights>(
  globalThis as unknown as WorkPort,
  async (question, listener, wasm) => {
    if (!wasm) throw new Error('the solver did not come along');
    const hb = new Handlebody(await instantiate('handlebody.wasm', wasm));
    return 'shape' in question
      ? baked(question, listener, (shape, options) => hb.bake(shape, options))
      : weighed(question, listener, hb);
  },
);
