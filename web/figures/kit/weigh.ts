import { load, type WeightHandle, type WeightMeasures } from '../../../wasm/ts/index.ts';

/** A closed surface, what is to be filled in as fine as said, and what holds it. */
export interface WeightsQuestion {
  readonly positions: Float32Array;
  readonly triangles: Uint32Array;
  /** Voxels along the longest side. */
  readonly resolution: number;
  readonly handles: readonly WeightHandle[];
  readonly order: 1 | 2 | 3;
  readonly bounded: boolean;
}

export interface SolidWeights {
  /** vertices of the surface × handles. */
  readonly weights: Float32Array;
  readonly tetrahedra: number;
  readonly vertices: number;
  readonly measures: Pick<WeightMeasures, 'holds' | 'least' | 'largest' | 'sumError' | 'gradientJump' | 'farWeight'>;
}

/** Fills a solid with tetrahedra and computes its weights, at the surface's vertices. */
export async function weigh(
  question: WeightsQuestion,
  onProgress: (part: number) => void,
  signal?: AbortSignal,
): Promise<SolidWeights> {
  const { handles, resolution, order, bounded } = question;
  const hb = await load();
  const solid = hb.tetrahedralize(question, { resolution });
  const weights = hb.biharmonicWeights(solid, handles, { order });
  try {
    if (bounded) await weights.bound({ onProgress, ...(signal && { signal }) });
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
