import { HandlebodyError, throwIfAborted } from '../../wasm/ts/errors.ts';
import type { BakeOptions, BakeShape, BakeWarning, BodyData, Mesh } from '../../wasm/ts/types.ts';
import { type BakeReply, type BakeRequest, copyShape, type PostedBakeOptions, unpackError } from './messages.ts';

export interface BakeInWorkerOptions extends BakeOptions {
  /**
   * Makes the worker, which is ended when the bake is done: for sites whose bundler or security policy wants it elsewhere. Its script
   * must import "handlebody/bake-worker" or be that file.
   */
  readonly worker?: () => Worker;
  /** Told why when no worker could be started; the bake then steps on this thread. */
  readonly onFallback?: (reason: unknown) => void;
}

/**
 * Bakes on another thread, so that the page stays smooth. The shape's arrays are copied and stay the caller's; where it is a mesh, the
 * body's `mesh` is the one given. An aborted signal ends the worker at once.
 *
 * Without workers (Node, old browsers, a policy that blocks them) it steps on this thread, in slices of some milliseconds.
 *
 * Throws what `Handlebody.bake` throws, 'aborted' included, as `HandlebodyError`.
 *
 * ```ts
 * const body = await bakeInWorker(mesh, { centers: 200, onProgress: (part) => { bar.value = part; }, signal });
 * ```
 */
export async function bakeInWorker(shape: BakeShape, options: BakeInWorkerOptions = {}): Promise<BodyData> {
  const { worker: makeWorker = defaultWorker, onFallback, signal, onProgress, onWarning, ...posted } = options;
  throwIfAborted(signal);
  let worker: Worker;
  try {
    worker = makeWorker();
  } catch (reason) {
    return bakeHere(shape, options, reason);
  }
  const outcome = await converse(worker, { shape, posted, signal, onProgress, onWarning });
  return 'body' in outcome ? outcome.body : bakeHere(shape, options, outcome.notStarted);
}

/** Written as bundlers look for it. The name ends in .js for the published files; Vite finds the .ts beside it in the sources. */
function defaultWorker(): Worker {
  return new Worker(new URL('./bake-worker.js', import.meta.url), { type: 'module', name: 'handlebody-bake' });
}

interface Conversation {
  readonly shape: BakeShape;
  readonly posted: PostedBakeOptions;
  readonly signal: AbortSignal | undefined;
  readonly onProgress: ((part: number) => void) | undefined;
  readonly onWarning: ((warning: BakeWarning) => void) | undefined;
}

async function converse(worker: Worker, bake: Conversation): Promise<{ body: BodyData } | { notStarted: unknown }> {
  const { shape, signal, onProgress, onWarning } = bake;
  const listening = new AbortController();
  try {
    return await new Promise((resolve, reject) => {
      const listen = (type: string, listener: (event: Event) => void) => {
        // A listener that throws (the caller's progress callback, say) fails the bake instead of leaving it to wait for ever.
        const guarded = (event: Event) => {
          try {
            listener(event);
          } catch (error) {
            reject(error);
          }
        };
        worker.addEventListener(type, guarded, { signal: listening.signal });
      };
      let ready = false;
      listen('message', (event) => {
        const reply = (event as MessageEvent<BakeReply>).data;
        if (reply.type === 'ready') {
          ready = true;
          postBake(worker, bake);
        } else if (reply.type === 'progress') onProgress?.(reply.part);
        else if (reply.type === 'warning') onWarning?.(reply.warning);
        else if (reply.type === 'body') resolve({ body: { ...reply.body, mesh: reply.body.mesh ?? (shape as Mesh) } });
        else if (reply.type === 'error') reject(unpackError(reply.error));
      });
      listen('error', (event) => {
        event.preventDefault();
        if (ready) reject(crashed((event as ErrorEvent).message));
        else resolve({ notStarted: event });
      });
      listen('messageerror', () => reject(crashed('a message could not be read')));
      signal?.addEventListener('abort', () => reject(abortError(signal)), { once: true, signal: listening.signal });
    });
  } finally {
    listening.abort();
    worker.terminate();
  }
}

/** The copies travel without being copied again. */
function postBake(worker: Worker, { shape, posted }: Conversation): void {
  const { copy, buffers } = copyShape(shape);
  const density = posted.density && Float64Array.from(posted.density);
  const request: BakeRequest = { type: 'bake', shape: copy, options: density ? { ...posted, density } : posted };
  worker.postMessage(request, buffers);
}

async function bakeHere(shape: BakeShape, options: BakeInWorkerOptions, reason: unknown): Promise<BodyData> {
  const { worker: _, onFallback, ...bakeOptions } = options;
  onFallback?.(reason);
  // Loaded only now: a page whose worker starts never needs the solver for this.
  const { load } = await import('../../wasm/ts/index.ts');
  const hb = await load(options.signal ? { signal: options.signal } : {});
  return hb.bake(shape, bakeOptions);
}

function abortError(signal: AbortSignal): unknown {
  try {
    throwIfAborted(signal);
  } catch (error) {
    return error;
  }
  return signal.reason;
}

function crashed(what: string | undefined): HandlebodyError {
  return new HandlebodyError('internal', {
    message: `The baking worker stopped: ${what || 'no reason was given'}.`,
    remedy: 'Try again; if it happens again, please report it, with the model if you can.',
  });
}
