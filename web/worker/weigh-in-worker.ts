import { type InWorkerOptions, inWorker } from './in-worker.ts';
import { ownCopy } from './own-copy.ts';
import { scriptText } from './script-text.ts';
import type { SolidWeights, WeightsQuestion } from './weigh.ts';

/**
 * Skinning weights of a solid, computed on another thread, so that the page stays smooth: its surface is filled with tetrahedra, and the
 * weights are those of Jacobson and others' "Bounded biharmonic weights" (2011) and its relatives, at the surface's vertices. An aborted
 * signal ends the worker at once. Where no worker starts from a file, one starts from a text that the library carries; without workers the
 * page's own thread does it.
 *
 * Throws what `tetrahedralize`, `biharmonicWeights` and `bound` throw, 'aborted' included, as `HandlebodyError`.
 */
export function weighInWorker(question: WeightsQuestion, options: Omit<InWorkerOptions, 'onWarning'> = {}): Promise<SolidWeights> {
  const asked = ownCopy(question);
  return inWorker<SolidWeights>({
    ...options,
    worker: options.worker ?? defaultWorker,
    text: options.worker ? undefined : scriptText,
    ask: () => [asked, []],
    here: async () => {
      const [{ load }, { weigh }] = await Promise.all([import('../../wasm/ts/index.ts'), import('./weigh.ts')]);
      return weigh(await load(), asked, options);
    },
  });
}

function defaultWorker(): Worker {
  return new Worker(new URL('./weigh-worker.js', import.meta.url), { type: 'module', name: 'handlebody-weigh' });
}
