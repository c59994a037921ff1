import type { Handlebody, WeightHandle, WeightMeasures } from '../../wasm/ts/index.ts';
import type { Mesh } from '../../wasm/ts/types.ts';

/** A closed surface, what fills it, and what holds it. */
export interface WeightsQuestion {
  readonly surface: Mesh;
  readonly handles: readonly WeightHandle[];
  /** Voxels along the longest side, from which the tetrahedra are made. */
  readonly resolution: number;
  /** Of the energy that is least: 1 harmonic, 2 biharmonic, 3 triharmonic. */
  readonly order: 1 | 2 | 3;
  /** Within 0 and 1; of biharmonic weights only. */
  readonly bounded: boolean;
}

/** Weights of a solid, and what was made for them. */
export interface SolidWeights {
  /** vertices of the surface × handles. */
  readonly weights: Float32Array;
  readonly tetrahedra: number;
  /** Of the tetrahedra. */
  readonly vertices: number;
  readonly measures: Pick<WeightMeasures, 'holds' | 'least' | 'largest' | 'sumError' | 'gradientJump' | 'farWeight'>;
}

/** Fills a solid with tetrahedra and computes its weights, at the surface's vertices. Throws what the solver throws. */
export async function weigh(
  hb: Handlebody,
  { surface, handles, resolution, order, bounded }: WeightsQuestion,
  listener: { onProgress?(part: number): void; readonly signal?: AbortSignal },
): Promise<SolidWeights> {
  const solid = hb.tetrahedralize(surface, { resolution });
  const weights = hb.biharmonicWeights(solid, handles, { order });
  try {
    if (bounded) await weights.bound(listener);
    const { holds, least, largest, sumError, gradientJump, farWeight } = hb.measureWeights(solid, handles, weights.weights);
    return {
      weights: Float32Array.from(solid.sample(weights.weights)),
      tetrahedra: solid.tetrahedra.length / 4,
      vertices: solid.positions.length / 3,
      measures: { holds, least, largest, sumError, gradientJump, farWeight },
    };
  } finally {
    weights.dispose();
  }
}

/** The same as a worker gives it: with what is handed over. */
export async function weighAnswer(...asked: Parameters<typeof weigh>) {
  const answer = await weigh(...asked);
  return { answer, transfer: [answer.weights] };
}
