/**
 * The baking worker as a script that needs no file beside it: it is in the library as text (`blob-worker.generated.ts`), for bundlers that make
 * no worker of a file's address, and for pages of another origin. The page sends the compiled solver along.
 */
import { Handlebody } from '../../wasm/ts/handlebody.ts';
import { instantiate } from '../../wasm/ts/load.ts';
import { answerBake, type WorkPort } from './answer.ts';

answerBake(globalThis as unknown as WorkPort, async (shape, options, wasm) => {
  if (!wasm) throw new Error('the solver did not come along');
  return new Handlebody(await instantiate('handlebody.wasm', wasm)).bake(shape, options);
});
