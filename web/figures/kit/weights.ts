import { notFetched } from '../../ui/lazy.ts';
import { PageError } from '../../ui/page-error.ts';
import type { Work } from './figure.ts';
import type { SolidWeights, WeightsQuestion } from './weigh.ts';
import type { WeightsAnswer } from './weights-worker.ts';

const PART = 'The part of this page that computes weights';

/** Weights of a solid, from a worker of their own, which ends with the work. */
export async function weightsOf(question: WeightsQuestion, work: Work): Promise<SolidWeights> {
  work.progress(undefined, 'Computing weights…');
  let worker: Worker;
  try {
    worker = new Worker(new URL('./weights-worker.ts', import.meta.url), { type: 'module' });
  } catch {
    // As in a frame that may not have the site's origin.
    work.alone();
    const { weigh } = await import('./weigh.ts').catch(async () => Promise.reject(await notFetched(PART)));
    return weigh(question, work.progress, work.signal);
  }
  const listening = new AbortController();
  try {
    return await new Promise((resolve, reject) => {
      const { signal } = listening;
      let isThere = false;
      work.signal.addEventListener('abort', () => reject(work.signal.reason), { signal });
      const hear = ({ data }: MessageEvent<WeightsAnswer>) => {
        isThere = true;
        if ('part' in data) work.progress(data.part);
        else if ('told' in data) reject(new PageError(data.told.detail ?? 'internal', data.told.message, data.told.remedy));
        else resolve(data);
      };
      const fail = async (event: Event) => {
        event.preventDefault();
        reject(isThere ? stopped() : await notFetched(PART));
      };
      worker.addEventListener('message', hear, { signal });
      worker.addEventListener('error', fail, { signal });
      worker.postMessage(question);
    });
  } finally {
    listening.abort();
    worker.terminate();
  }
}

function stopped(): PageError {
  return new PageError('worker-failed', 'The weights could not be computed.', 'Reload the page and try again.');
}
