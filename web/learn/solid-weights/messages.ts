import type { WeightHandle, WeightMeasures } from '../../../wasm/ts/index.ts';
import type { Told } from '../../ui/explain.ts';

/** What the page and its worker say to each other. */
export interface Question {
  readonly positions: Float32Array;
  readonly triangles: Uint32Array;
  readonly resolution: number;
  readonly handles: readonly WeightHandle[];
  readonly order: 1 | 2 | 3;
  readonly bounded: boolean;
}

export interface Weights {
  /** vertices of the surface × handles. */
  readonly weights: Float32Array;
  readonly tetrahedra: number;
  readonly vertices: number;
  readonly measures: Pick<WeightMeasures, 'holds' | 'least' | 'largest' | 'sumError' | 'gradientJump' | 'farWeight'>;
}

/** What the worker says: how far it is, what went wrong, or the weights. */
export type Answer = Weights | { readonly part: number } | { readonly told: Told };
