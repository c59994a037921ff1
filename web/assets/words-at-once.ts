import { Fault } from './fault.ts';
import { worded } from './fault-words.ts';

/** Does work that may find faults, for callers that cannot wait: throws them in words. */
export function inWordsAtOnce<T>(work: () => T): T {
  try {
    return work();
  } catch (error) {
    throw error instanceof Fault ? worded(error) : error;
  }
}
