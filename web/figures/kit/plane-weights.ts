import type { Handlebody, WeightHandle } from '../../../wasm/ts/index.ts';
import type { PlaneMesh } from '../../models/mesh-shape.ts';
import type { Handle } from './plane-handles.ts';

/** Kinds of weights, by the order of the energy that is least. */
export const WEIGHTS_ORDERS = { harmonic: 1, biharmonic: 2, bounded: 2, triharmonic: 3 } as const;

export type WeightsKind = keyof typeof WEIGHTS_ORDERS;

interface Island {
  readonly count: number;
  /** Its first vertex. */
  readonly first: number;
  /** The handle that it follows. */
  readonly handle: number;
}

export interface Weights {
  /** n×h, row by row. */
  readonly weights: Float64Array;
  readonly islands: readonly Island[];
  /** Whether the weights are what was asked for: bounded ones are biharmonic before `finish`. */
  readonly isFinished: boolean;
  /** Solves again, without factoring again where the solver can. */
  setHandles(handles: readonly Handle[]): void;
  /** In small steps, so that the page stays awake; given up, with 'aborted', when other handles are set or it is cancelled. */
  finish(options: { signal: AbortSignal; onProgress(part: number): void }): Promise<void>;
  dispose(): void;
}

export function solveWeights(hb: Handlebody, mesh: PlaneMesh, handles: readonly Handle[], kind: WeightsKind): Weights {
  const solved = hb.biharmonicWeights({ ...mesh, dimension: 2 }, handles.map(weightHandle), { order: WEIGHTS_ORDERS[kind] });
  let finished = kind !== 'bounded';
  return {
    get weights() {
      return solved.weights;
    },
    get islands() {
      return solved.islands;
    },
    get isFinished() {
      return finished;
    },
    setHandles(next) {
      finished = kind !== 'bounded';
      solved.setHandles(next.map(weightHandle));
    },
    async finish(options) {
      await solved.bound(options);
      finished = true;
    },
    dispose: () => solved.dispose(),
  };
}

export function weightHandle({ rest, end }: Handle): WeightHandle {
  return end ? { bone: [rest, end] } : { at: rest };
}
