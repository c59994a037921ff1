import type { Handlebody, WeightMeasures } from '../../../wasm/ts/index.ts';
import { meshShape, type PlaneMesh } from '../../models/mesh-shape.ts';
import type { Shape } from '../../models/shape.ts';
import type { Work } from './figure.ts';
import { spread } from './placing.ts';
import type { Handle, Handles } from './plane-handles.ts';
import { solveWeights, type Weights, type WeightsKind, weightHandle } from './plane-weights.ts';

/** What weights are asked for: compared by identity, so that only what is new is computed again. */
interface WeighedQuestion {
  readonly outline: Shape;
  readonly vertices: number;
  readonly handles: Handles;
  readonly kind: WeightsKind;
}

/** A shape of the plane with handles, and their weights. */
export class WeighedShape {
  readonly mesh: PlaneMesh;
  handles: readonly Handle[] = [];
  readonly #hb: Handlebody;
  readonly #of: WeighedQuestion;
  #weights: Weights | undefined;

  /** Throws on an outline that is none. */
  private constructor(hb: Handlebody, question: WeighedQuestion) {
    [this.#hb, this.#of] = [hb, question];
    this.mesh = meshShape(question.outline, { vertices: question.vertices });
  }

  /** Other handles on the shape of `last` cost a solve. Bounded weights, which can be cancelled, are made anew. Throws what the solver throws. */
  static make(hb: Handlebody, asked: WeighedQuestion, work: Work<WeighedShape>, last?: WeighedShape) {
    const { kind } = asked;
    if (kind !== 'bounded' && last?.isOf(asked)) {
      last.#place(asked);
      return last;
    }
    const made = new WeighedShape(hb, asked);
    const weights = made.#place(asked);
    return weights && kind === 'bounded' ? made.#bound(weights, work) : made;
  }

  get outline(): Shape {
    return this.#of.outline;
  }

  /** vertices × handles; nothing where there is no handle. */
  get weights(): Float64Array | undefined {
    return this.handles.length > 0 ? this.#weights?.weights : undefined;
  }

  get measures(): WeightMeasures | undefined {
    const mesh = { ...this.mesh, dimension: 2 as const };
    return this.weights && this.#hb.measureWeights(mesh, this.handles.map(weightHandle), this.weights);
  }

  dispose(): void {
    this.#weights?.dispose();
  }

  isOf({ outline, vertices, kind }: WeighedQuestion): boolean {
    return outline === this.#of.outline && vertices === this.#of.vertices && kind === this.#of.kind;
  }

  /** Where it throws, all is as it was. */
  #place({ handles: asked, kind }: WeighedQuestion): Weights | undefined {
    const handles = asked === 'auto' ? spread(this.mesh, 4) : asked;
    if (handles.length > 0) {
      this.#weights?.setHandles(handles);
      this.#weights ??= solveWeights(this.#hb, this.mesh, handles, kind);
    }
    this.handles = handles;
    return this.#weights;
  }

  async #bound(weights: Weights, work: Work<WeighedShape>): Promise<WeighedShape> {
    work.progress(0, 'Bounding the weights…');
    try {
      await weights.finish({ signal: work.signal, onProgress: work.progress });
      return this;
    } catch (error) {
      this.dispose();
      throw error;
    }
  }
}
