import { lazy, notFetched } from '../../ui/lazy.ts';
import { PageError } from '../../ui/page-error.ts';
import type { Answer, Question, Weights } from './messages.ts';
import type { Solid } from './solids.ts';

export type Method = 'harmonic' | 'biharmonic' | 'bounded' | 'triharmonic';

export const METHODS: readonly { readonly id: Method; readonly label: string; readonly about: string }[] = [
  { id: 'harmonic', label: 'Harmonic', about: 'Least ∫|∇w|²: within 0 and 1, with spikes at points.' },
  { id: 'biharmonic', label: 'Biharmonic', about: 'Least ∫(Δw)²: smooth, out of bounds in places.' },
  { id: 'bounded', label: 'Bounded', about: 'Least ∫(Δw)² among weights from 0 to 1, of all handles together.' },
  { id: 'triharmonic', label: 'Triharmonic', about: 'Least ∫|∇Δw|²: smoother, farther out of bounds.' },
];

const ORDERS = { harmonic: 1, biharmonic: 2, bounded: 2, triharmonic: 3 } as const;

const ANSWERS = 'The part of this page that computes weights';
const weighPart = lazy(() => import('./weigh.ts'), ANSWERS);

interface Listener {
  readonly signal: AbortSignal;
  onProgress(part: number): void;
  /** No worker can be started here: the weights are computed on the page's thread. */
  onFallback(): void;
}

/** Asks a worker of its own, which the signal ends. `state` is the page's, as addresses write it. */
export async function computeWeights(solid: Solid, method: Method, listener: Listener, state: string): Promise<Weights> {
  const { positions, triangles, resolution, handles } = solid;
  const question: Question = {
    positions,
    triangles,
    resolution,
    handles: handles.map(({ holds }) => holds),
    order: ORDERS[method],
    bounded: method === 'bounded',
  };
  let worker: Worker;
  try {
    worker = new Worker(new URL('./weights-worker.ts', import.meta.url), { type: 'module' });
  } catch {
    // As in a frame that may not have the site's origin.
    listener.onFallback();
    const { weigh } = await weighPart(state);
    return weigh(question, listener.onProgress, listener.signal);
  }
  return converse(worker, question, listener);
}

function converse(worker: Worker, question: Question, { signal, onProgress }: Listener): Promise<Weights> {
  return new Promise((resolve, reject) => {
    let isThere = false;
    const end = (settle: () => void) => {
      worker.terminate();
      signal.removeEventListener('abort', cancel);
      settle();
    };
    const cancel = () => end(() => reject(signal.reason));
    signal.addEventListener('abort', cancel);
    worker.addEventListener('message', ({ data }: MessageEvent<Answer>) => {
      isThere = true;
      if ('part' in data) onProgress(data.part);
      else if ('told' in data)
        end(() => reject(new PageError(data.told.detail ?? 'internal', data.told.message, data.told.remedy)));
      else end(() => resolve(data));
    });
    worker.addEventListener('error', async (event) => {
      event.preventDefault();
      const stopped = () => new PageError('worker-failed', 'The weights could not be computed.', 'Reload the page and try again.');
      const error = isThere ? stopped() : await notFetched(ANSWERS);
      end(() => reject(error));
    });
    worker.postMessage(question);
  });
}
