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

/** Asks a worker of its own, which the signal ends. */
export function computeWeights(
  solid: Solid,
  method: Method,
  signal: AbortSignal,
  onProgress: (part: number) => void,
): Promise<Weights> {
  return new Promise((resolve, reject) => {
    const worker = new Worker(new URL('./weights-worker.ts', import.meta.url), { type: 'module' });
    const end = (settle: () => void) => {
      worker.terminate();
      signal.removeEventListener('abort', cancel);
      settle();
    };
    const cancel = () => end(() => reject(signal.reason));
    signal.addEventListener('abort', cancel);
    worker.addEventListener('message', ({ data }: MessageEvent<Answer>) => {
      if ('part' in data) onProgress(data.part);
      else if ('told' in data)
        end(() => reject(new PageError(data.told.detail ?? 'internal', data.told.message, data.told.remedy)));
      else end(() => resolve(data));
    });
    worker.addEventListener('error', () =>
      end(() => reject(new PageError('worker-failed', 'The weights could not be computed.', 'Reload the page and try again.'))),
    );
    const { positions, triangles, resolution, handles } = solid;
    const question: Question = {
      positions,
      triangles,
      resolution,
      handles: handles.map(({ holds }) => holds),
      order: ORDERS[method],
      bounded: method === 'bounded',
    };
    worker.postMessage(question);
  });
}
