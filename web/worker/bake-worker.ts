/** The script of the baking worker. It is started for one bake and thrown away, which gives its memory back. */
import { load } from '../../wasm/ts/index.ts';
import { answerBake, type BakePort } from './answer-bake.ts';

answerBake(globalThis as unknown as BakePort, async (shape, options) => (await load()).bake(shape, options));
