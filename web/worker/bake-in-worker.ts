import { callback, optional, options as readOptions } from '../../wasm/ts/arguments.ts';
import { BAKE_DEFAULTS, BAKE_READERS } from '../../wasm/ts/bake-options.ts';
import { meshLike } from '../../wasm/ts/mesh-arrays.ts';
import type { BakeOptions, BakeShape, BodyData } from '../../wasm/ts/types.ts';
import type { BakeQuestion, PostedBakeOptions } from './answer.ts';
import { type InWorkerOptions, inWorker } from './in-worker.ts';
import { arraysOf, ownCopy } from './own-copy.ts';
import { scriptText } from './script-text.ts';

const READERS = { ...BAKE_READERS, worker: optional(callback), onFallback: optional(callback) };

/** `worker`: its script must import "handlebody/bake-worker" or be that file. */
export interface BakeInWorkerOptions extends BakeOptions, Pick<InWorkerOptions, 'worker' | 'onFallback'> {}

/**
 * Bakes on another thread, so that the page stays smooth. The shape's arrays are copied when this is called and stay the caller's; the
 * body's `mesh` has arrays of its own. An aborted signal ends the worker at once.
 *
 * Bundlers that make no worker of a file, and pages of another origin, get one from a script that the library carries as text. Without workers
 * (Node, old browsers, a policy that blocks them) it steps on this thread, in slices of some milliseconds.
 *
 * Throws what `Handlebody.bake` throws, 'aborted' included, as `HandlebodyError`.
 *
 * ```ts
 * const body = await bakeInWorker(mesh, { centers: 200, onProgress: (part) => { bar.value = part; }, signal });
 * ```
 */
export async function bakeInWorker(shape: BakeShape, options: BakeInWorkerOptions = {}): Promise<BodyData> {
  readOptions(options, READERS, BAKE_DEFAULTS);
  meshLike(shape, 'shape');
  const { worker = defaultWorker, onFallback, ...bakeOptions } = options;
  const { signal, onProgress, onWarning, ...posted } = bakeOptions;
  const question: BakeQuestion = ownCopy({ shape, options: posted satisfies PostedBakeOptions });
  return inWorker<BodyData>({
    ...options,
    worker,
    // Who gives a worker wants that one.
    text: options.worker ? undefined : scriptText,
    // A worker that is asked answers or fails: nobody else wants the copy.
    ask: () => [question, arraysOf(question.shape).map(({ buffer }) => buffer as ArrayBuffer)],
    here: async () => {
      // Loaded only now: a page whose worker starts never needs the solver for this.
      const { load } = await import('../../wasm/ts/index.ts');
      return (await load(signal ? { signal } : {})).bake(question.shape, { ...bakeOptions, ...question.options });
    },
  });
}

/** Written as bundlers look for it. The name ends in .js for the published files; Vite finds the .ts beside it in the sources. */
function defaultWorker(): Worker {
  return new Worker(new URL('./bake-worker.js', import.meta.url), { type: 'module', name: 'handlebody-bake' });
}
