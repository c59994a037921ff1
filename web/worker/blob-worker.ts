/**
 * Both workers as one script that needs no file beside it: it is in the library as text (`blob-worker.generated.ts`), for bundlers that make no
 * worker of a file's address, for pages of another origin, and for pages without one. The page sends the compiled solver along.
 */
import { Handlebody } from '../../wasm/ts/handlebody.ts';
import { instantiate } from '../../wasm/ts/load.ts';
import type { BodyData } from '../../wasm/ts/types.ts';
import { answer, type BakeQuestion, bakeAnswer, type WorkPort } from './answer.ts';
import { type SolidWeights, type WeightsQuestion, weighAnswer } from './weigh.ts';

answer<BakeQuestion | WeightsQuestion, BodyData | SolidWeights>(
  globalThis as unknown as WorkPort,
  async (question, listener, wasm) => {
    if (!wasm) throw new Error('the solver did not come along');
    const hb = new Handlebody(await instantiate('handlebody.wasm', wasm));
    if ('surface' in question) return weighAnswer(hb, question, listener);
    return bakeAnswer(question, listener, (shape, options) => hb.bake(shape, options));
  },
);
