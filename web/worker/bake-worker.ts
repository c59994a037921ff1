/** The script of the baking worker. It is started for one bake and thrown away, which gives its memory back. */
import { load } from '../../wasm/ts/index.ts';
import { answerBake, type WorkPort } from './answer.ts';

answerBake(globalThis as unknown as WorkPort, async (shape, options) => (await load()).bake(shape, options));
