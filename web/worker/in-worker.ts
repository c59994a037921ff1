import { HandlebodyError, throwIfAborted } from '../../wasm/ts/errors.ts';
import type { BakeWarning } from '../../wasm/ts/types.ts';
import { unpackError, type WorkReply } from './messages.ts';

/** Where work is done, and who hears of it. */
export interface InWorkerOptions {
  /**
   * Makes the worker, which is ended when the work is done: for sites whose bundler or security policy wants it elsewhere. Its script must
   * import the package's own or be that file.
   */
  readonly worker?: () => Worker;
  /** Told why when no worker could be started; the work is then done on this thread. What it throws ends the work. */
  readonly onFallback?: (reason: unknown) => void;
  /** Ends the worker at once. */
  readonly signal?: AbortSignal;
  /** The part done, 0 to 1. */
  readonly onProgress?: (part: number) => void;
  readonly onWarning?: (warning: BakeWarning) => void;
}

/** A worker whose script is text, and the compiled solver that it is sent. */
export interface ScriptText {
  readonly script: string;
  readonly wasm: WebAssembly.Module;
}

interface Work<Answer> extends InWorkerOptions {
  readonly worker: () => Worker;
  /** Instead, where that does not start: bundlers know no file for it, or it is of another origin. */
  readonly text?: (() => Promise<ScriptText>) | undefined;
  /** What is asked, and what of it is handed over instead of copied. */
  readonly ask: () => readonly [question: unknown, transfer: Transferable[]];
  /** The same work on this thread. */
  readonly here: () => Promise<Answer>;
}

/** Has work done by a worker that `answer` listens in, or on this thread where none can be started. */
export async function inWorker<Answer>(work: Work<Answer>): Promise<Answer> {
  throwIfAborted(work.signal);
  const first = await attempt(work, work.worker);
  if ('answer' in first) return first.answer;
  // Node has no workers of this kind.
  const second = typeof Worker === 'function' && work.text ? await attemptText(work, work.text) : first;
  if ('answer' in second) return second.answer;
  throwIfAborted(work.signal);
  work.onFallback?.(first.notStarted);
  return work.here();
}

type Outcome<Answer> = { readonly answer: Answer } | { readonly notStarted: unknown };

async function attempt<Answer>(work: Work<Answer>, make: () => Worker, wasm?: WebAssembly.Module): Promise<Outcome<Answer>> {
  let worker: Worker;
  try {
    worker = make();
  } catch (reason) {
    return { notStarted: reason };
  }
  return converse(worker, work, wasm);
}

async function attemptText<Answer>(work: Work<Answer>, text: () => Promise<ScriptText>): Promise<Outcome<Answer>> {
  let given: ScriptText;
  try {
    given = await text();
  } catch (reason) {
    // The part of the library that has it did not come either.
    return { notStarted: reason };
  }
  const { script, wasm } = given;
  // Where the page has no origin (a file of the disk, a sandboxed frame) no module comes from a blob, but one comes from an address that holds it.
  const whole = globalThis.origin === 'null';
  const address = whole
    ? `data:text/javascript;charset=utf-8,${encodeURIComponent(script)}`
    : URL.createObjectURL(new Blob([script], { type: 'text/javascript' }));
  try {
    return await attempt(work, () => new Worker(address, { type: 'module', name: 'handlebody' }), wasm);
  } finally {
    if (!whole) URL.revokeObjectURL(address);
  }
}

async function converse<Answer>(
  worker: Worker,
  { ask, signal, onProgress, onWarning }: Work<Answer>,
  wasm: WebAssembly.Module | undefined,
): Promise<Outcome<Answer>> {
  const listening = new AbortController();
  try {
    return await new Promise((resolve, reject) => {
      const listen = (type: string, listener: (event: Event) => void) => {
        // A listener that throws (the caller's progress callback, say) fails the work instead of leaving it to wait for ever.
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
        const reply = (event as MessageEvent<WorkReply<Answer>>).data;
        if (reply.type === 'ready') {
          ready = true;
          if (reply.life) {
            const gone = () => reject(crashed('it was ended from outside'));
            navigator.locks.request(reply.life, { signal: listening.signal }, gone).catch(() => {});
          }
          const [question, transfer] = ask();
          worker.postMessage({ type: 'work', question, wasm }, transfer);
        } else if (reply.type === 'progress') onProgress?.(reply.part);
        else if (reply.type === 'warning') onWarning?.(reply.warning);
        else if (reply.type === 'done') resolve({ answer: reply.answer });
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
    message: `The worker stopped: ${what || 'no reason was given'}.`,
    remedy: 'Try again; if it happens again, please report it, with the model if you can.',
  });
}
