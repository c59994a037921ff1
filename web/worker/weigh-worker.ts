/** The script of the worker that computes weights. It is started for one solid and thrown away, which gives its memory back. */
import { load } from '../../wasm/ts/index.ts';
import { answer, type WorkPort } from './answer.ts';
import { type SolidWeights, type WeightsQuestion, weighAnswer } from './weigh.ts';

answer<WeightsQuestion, SolidWeights>(globalThis as unknown as WorkPort, async (question, listener) =>
  weighAnswer(await load(), question, listener),
);
