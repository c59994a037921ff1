import type { DualQuaternion, EnergyMinimizer, Handlebody, LinearBlend } from '../../../../wasm/ts/index.ts';
import type { PlaneMesh } from '../../../models/mesh-shape.ts';
import { type Handle, writeTransforms } from '../../kit/plane-handles.ts';
import { solveWeights, type Weights, type WeightsKind, weightHandle } from '../../kit/plane-weights.ts';
import type { DistanceKind, EnergyKind, Method, MethodId } from './methods.ts';

/** The most rounds of the rigid energy in a frame; the next frame goes on from there. */
const ROUNDS = 8;

/** What interior radial basis functions need: made on demand, on another thread. */
export interface SlabDeformation {
  setHandles(handles: readonly Handle[]): void;
  /** Whether another round would improve it. */
  deform(handles: readonly Handle[], out: Float32Array): boolean;
  dispose(): void;
}

/** One mesh under one set of handles, deformed by any method. Everything is made when it is first asked for. */
export class Deformer {
  readonly mesh: PlaneMesh;
  readonly hb: Handlebody;
  #handles: readonly Handle[] = [];
  readonly #weights = new Map<WeightsKind, Weights>();
  /** Weights that have seen the handles as they are. */
  readonly #fresh = new Set<WeightsKind>();
  readonly #deformations = new Map<MethodId, LinearBlend | DualQuaternion | EnergyMinimizer>();
  readonly #slabs = new Map<DistanceKind, SlabDeformation>();
  readonly #freshSlabs = new Set<DistanceKind>();
  #finishing: AbortController | undefined;
  /** Why weights could not be finished for these handles. */
  #refusal: { readonly error: unknown } | undefined;

  constructor(hb: Handlebody, mesh: PlaneMesh) {
    this.hb = hb;
    this.mesh = mesh;
  }

  /** Other handles, or the same ones elsewhere at rest. Poses need no call. */
  setHandles(handles: readonly Handle[]): void {
    this.#handles = handles;
    this.#refusal = undefined;
    this.#finishing?.abort();
    this.#fresh.clear();
    this.#freshSlabs.clear();
    for (const deformation of this.#deformations.values()) deformation.dispose();
    this.#deformations.clear();
  }

  /** Whether the method can answer within a frame. */
  isReady({ id, kind, family }: Method): boolean {
    if (family === 'irbf') return this.#slabs.has(kind as DistanceKind);
    if (family === 'energy') return this.#deformations.has(id);
    return this.#fresh.has(kind as WeightsKind) && this.#weights.get(kind as WeightsKind)?.isFinished === true;
  }

  /** Whether a method's answer is worth showing beside others: all but what takes long and has not been asked for. */
  isOffered(method: Method): boolean {
    return method.family !== 'irbf' && method.kind !== 'bounded' ? true : this.isReady(method);
  }

  hasSlab(kind: DistanceKind): boolean {
    return this.#slabs.has(kind);
  }

  setSlab(kind: DistanceKind, slab: SlabDeformation): void {
    this.#slabs.get(kind)?.dispose();
    this.#slabs.set(kind, slab);
    this.#freshSlabs.delete(kind);
  }

  /**
   * Finishes bounded weights in small steps; until then they are biharmonic. What the solver throws `weights` throws from then on, until
   * there are other handles.
   */
  async finishBounded(onProgress: (part: number) => void): Promise<void> {
    const finishing = new AbortController();
    this.#finishing = finishing;
    try {
      const bounded = this.weights('bounded');
      await bounded.finish({ signal: finishing.signal, onProgress });
    } catch (error) {
      // Unless other handles came.
      if (!finishing.signal.aborted) this.#refusal = { error };
      return;
    } finally {
      this.#finishing = undefined;
    }
    for (const id of ['linear-bounded', 'rigid-bounded'] as const) {
      this.#deformations.get(id)?.dispose();
      this.#deformations.delete(id);
    }
  }

  /** Whether bounded weights can be finished: they are neither on their way nor refused. Throws what the solver throws. */
  get isUnbounded(): boolean {
    return !this.#finishing && !this.#refusal && this.#handles.length > 0 && !this.weights('bounded').isFinished;
  }

  weights(kind: WeightsKind): Weights {
    if (kind === 'bounded' && this.#refusal) throw this.#refusal.error;
    const known = this.#weights.get(kind);
    if (known && this.#fresh.has(kind)) return known;
    // A failed solve leaves nothing half done.
    if (known) known.setHandles(this.#handles);
    const weights = known ?? solveWeights(this.hb, this.mesh, this.#handles, kind);
    this.#weights.set(kind, weights);
    this.#fresh.add(kind);
    return weights;
  }

  /**
   * Places of the vertices under a method, n×2. Returns whether the next frame would come closer still, as iterations do. What is not
   * prepared leaves the places as they are. Throws what the solver throws.
   */
  deform(method: Method, handles: readonly Handle[], out: Float32Array): boolean {
    if (handles.length === 0) {
      out.set(this.mesh.positions);
      return false;
    }
    if (method.family === 'irbf') {
      const kind = method.kind as DistanceKind;
      const slab = this.#slabs.get(kind);
      if (!slab) return false;
      if (!this.#freshSlabs.has(kind)) slab.setHandles(handles);
      this.#freshSlabs.add(kind);
      return slab.deform(handles, out);
    }
    const deformation = this.#deformations.get(method.id) ?? this.#make(method);
    this.#deformations.set(method.id, deformation);
    writeTransforms(handles, deformation.transforms);
    const report = deformation.deform(out);
    // Rounds that were not all needed have converged; blending is done in one go.
    return 'iterations' in report && report.iterations === ROUNDS;
  }

  dispose(): void {
    this.#finishing?.abort();
    for (const owned of [...this.#weights.values(), ...this.#deformations.values(), ...this.#slabs.values()]) owned.dispose();
    this.#weights.clear();
    this.#deformations.clear();
    this.#slabs.clear();
  }

  #make({ family, kind }: Method): LinearBlend | DualQuaternion | EnergyMinimizer {
    const { hb, mesh } = this;
    if (family === 'energy') {
      const options = { energy: kind as EnergyKind, iterations: ROUNDS };
      return hb.minimizeEnergy({ ...mesh, dimension: 2 }, this.#handles.map(weightHandle), options);
    }
    const skin = { dimension: 2, positions: mesh.positions, weights: this.weights(kind as WeightsKind).weights } as const;
    return family === 'rigid' ? hb.dualQuaternion(skin) : hb.linearBlend(skin);
  }
}
