import { throwIfAborted } from './errors.ts';
import type { Heap } from './heap.ts';

/** What long work takes besides its input. */
export interface SteppedOptions {
  readonly signal?: AbortSignal;
  /** Called with the part done, 0 to 1. */
  readonly onProgress?: (part: number) => void;
}

/** How long one stretch of steps may keep the thread before events are let in, in milliseconds. */
const SLICE = 12;

/** Calls `step`, which writes the part done to an address, until that is 1, and lets events in between. */
export async function runStepped(
  heap: Heap,
  step: (progress: number) => void,
  { signal, onProgress }: SteppedOptions,
): Promise<void> {
  const progress = heap.alloc(8);
  try {
    let part = 0;
    while (part < 1) {
      const sliceEnd = performance.now() + SLICE;
      do {
        step(progress);
        part = heap.f64(progress, 1)[0] ?? 1;
      } while (part < 1 && performance.now() < sliceEnd);
      onProgress?.(part);
      await letEventsIn();
      throwIfAborted(signal);
    }
  } finally {
    heap.free(progress);
  }
}

/** A macrotask: timers are clamped to 4 ms in pages, a message is not. */
function letEventsIn(): Promise<void> {
  return new Promise((resolve) => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => {
      port1.close();
      resolve();
    };
    port2.postMessage(null);
  });
}
