import type { BakeOptions, BakeShape, BodyData, Mesh } from '../../wasm/ts/types.ts';
import type { BakeAnswer, BakeQuestion, PostedBakeOptions } from './answer.ts';
import { type InWorkerOptions, inWorker } from './in-worker.ts';
import { scriptText } from './script-text.ts';

/** `worker`: its script must import "handlebody/bake-worker" or be that file. */
export interface BakeInWorkerOptions extends BakeOptions, Pick<InWorkerOptions, 'worker' | 'onFallback'> {}

/**
 * Bakes on another thread, so that the page stays smooth. The shape's arrays are copied and stay the caller's; where it is a mesh, the
 * body's `mesh` is the one given. An aborted signal ends the worker at once.
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
  const { worker = defaultWorker, onFallback, ...bakeOptions } = options;
  const { signal, onProgress, onWarning, ...posted } = bakeOptions;
  const body = await inWorker<BakeAnswer>({
    ...options,
    worker,
    // Who gives a worker wants that one.
    text: options.worker ? undefined : scriptText,
    ask: () => copied(shape, posted),
    here: async () => {
      // Loaded only now: a page whose worker starts never needs the solver for this.
      const { load } = await import('../../wasm/ts/index.ts');
      return (await load(signal ? { signal } : {})).bake(shape, bakeOptions);
    },
  });
  return { ...body, mesh: body.mesh ?? (shape as Mesh) };
}

/** Written as bundlers look for it. The name ends in .js for the published files; Vite finds the .ts beside it in the sources. */
function defaultWorker(): Worker {
  return new Worker(new URL('./bake-worker.js', import.meta.url), { type: 'module', name: 'handlebody-bake' });
}

/** Copies that travel without being copied again. */
function copied(shape: BakeShape, options: PostedBakeOptions): [BakeQuestion, Transferable[]] {
  const entries = Object.entries(shape).map(([name, value]) => [
    name,
    ArrayBuffer.isView(value) ? (value as Uint8Array).slice() : value,
  ]);
  const copy = Object.fromEntries(entries) as unknown as BakeShape;
  const buffers = Object.values(copy).flatMap((value) => (ArrayBuffer.isView(value) ? [value.buffer as ArrayBuffer] : []));
  const density = options.density && Float64Array.from(options.density);
  return [{ shape: copy, options: density ? { ...options, density } : options }, buffers];
}
