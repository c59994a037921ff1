/** Baking off the main thread: "handlebody/worker". */
export { type BakeInWorkerOptions, bakeInWorker } from './bake-in-worker.ts';
export type { InWorkerOptions } from './in-worker.ts';
