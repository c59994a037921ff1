/** Long work off the main thread: "handlebody/worker". */
export { type BakeInWorkerOptions, bakeInWorker } from './bake-in-worker.ts';
export type { InWorkerOptions } from './in-worker.ts';
export type { SolidWeights, WeightsQuestion } from './weigh.ts';
export { weighInWorker } from './weigh-in-worker.ts';
