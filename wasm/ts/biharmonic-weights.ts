import { type Exports, LAYOUT } from './abi.generated.ts';
import { callback, flag, named, number, optional, type Readers, options as readOptions, signal, whole } from './arguments.ts';
import { HandlebodyError, throwIfAborted } from './errors.ts';
import type { Heap } from './heap.ts';
import { MESH_READERS, type MeshOptions } from './mesh-warnings.ts';
import type { Owned } from './owned.ts';
import { putMesh, type SimplexMesh } from './simplex-mesh.ts';
import { MESH_DEFAULTS, SoundMesh } from './sound-mesh.ts';
import { runStepped, type SteppedOptions } from './stepped.ts';
import { putHeld, resolveHandles, type WeightHandle } from './weight-handles.ts';

export interface BiharmonicWeightsOptions extends MeshOptions {
  /**
   * 1: harmonic, minimizes ∫|∇w|², with spikes at points. 2: biharmonic, minimizes ∫(Δw)², smooth, a little below 0 and above 1 in places.
   * 3: triharmonic, minimizes ∫|∇Δw|², smoother, farther out of bounds.
   */
  readonly order?: 1 | 2 | 3;
  /**
   * Brings the weights into [0, 1], all handles together, so that rows still sum to 1 (Jacobson et al. 2011): of all such weights, those of
   * least energy. Some twenty times the work; `bound()` does the same without blocking the thread.
   */
  readonly bounded?: boolean;
  /** How much of the mesh belongs to each vertex: its Voronoi cell (mixed where a triangle is obtuse) or a third of each triangle. */
  readonly mass?: 'voronoi' | 'barycentric';
}

export const BIHARMONIC_WEIGHTS_DEFAULTS = { order: 2, bounded: false, mass: 'voronoi', ...MESH_DEFAULTS } as const;

const MASSES = ['voronoi', 'barycentric'] as const;
const READERS = {
  ...MESH_READERS,
  order: whole(1, 3),
  bounded: flag,
  mass: named(MASSES),
} satisfies Readers<BiharmonicWeightsOptions>;

/**
 * A connected part of the mesh that no handle touches: it follows the nearest handle, its `weights` are 1 for that one. A vertex that no
 * triangle uses is one by itself.
 */
export interface Island {
  /** Its first vertex. */
  readonly first: number;
  /** Its number of vertices; those at one place count once. */
  readonly count: number;
  /** The handle that it follows. */
  readonly handle: number;
}

/** The result of bounding the weights. */
export interface BoundedReport {
  /** ½ Σⱼ wⱼᵀ Q wⱼ. */
  readonly energy: number;
  /** The least energy of such weights is not below `energy − gap`. */
  readonly gap: number;
  /** Sweeps of the alternating direction method, which finds out roughly which bounds hold. */
  readonly sweeps: number;
  /** Steps of Newton's method, which finds the minimum. */
  readonly newtonSteps: number;
}

export interface BoundOptions extends SteppedOptions {
  /** How far above the least energy that of the weights may be, relative to it. */
  readonly tolerance?: number;
}

export const BOUND_DEFAULTS = { tolerance: 1e-6 } as const;

const BOUND_READERS = {
  tolerance: number('a number above 0 and below 1', (x) => x > 0 && x < 1),
  signal: optional(signal),
  onProgress: optional(callback),
} satisfies Readers<BoundOptions>;

/** A square matrix by rows: entries `starts[i]` to `starts[i + 1]` of row i, in ascending columns. */
export interface SparseRows {
  readonly starts: Uint32Array;
  readonly columns: Uint32Array;
  readonly values: Float64Array;
}

/**
 * Skinning weights (lecture, "Weight calculation"): for each handle the smoothest function on the mesh that is 1 at its own vertices and 0 at
 * those of the others. Its operators are libigl's: Q = C, C M⁻¹ C or C M⁻¹ C M⁻¹ C of the cotangent Laplacian C and the mass matrix M.
 *
 * Vertices at one place are one, as where three.js splits them at seams: they have equal weights. Triangles without area and doubled ones
 * are left out with a warning, and a vertex that only flat ones use has the weights of the nearest point of the others; a vertex that
 * nothing uses is an island. Nearly flat triangles stay. Where the products of their cotangents would drown the others in rounding (weights
 * do not sum to 1, or Q cannot be factored) they count as thicker than they are, up to a thousandth of their longest edge's square.
 *
 * ```ts
 * const bar = hb.biharmonicWeights(mesh, [{ vertex: 3 }, { bone: [[0, 0], [0, 1]] }]);
 * bar.weights;                        // n × 2, rows sum to 1
 * bar.setHandles([{ vertex: 4 }, { bone: [[0, 0], [0, 1]] }]);   // solves again without factoring
 * ```
 */
export class BiharmonicWeights {
  readonly vertexCount: number;
  /** For each vertex the first one at its place, with which it shares its weights: itself, unless the mesh splits it. */
  readonly vertexOf: Uint32Array;
  readonly #heap: Heap<Exports>;
  readonly #mesh: SoundMesh;
  readonly #owned: Owned;
  #vertices: readonly (readonly number[])[] = [];
  readonly #bounded: boolean;
  #weights: Float64Array = new Float64Array();
  #report: BoundedReport | undefined;
  /** The report of bounding that is under way. */
  #pending: BoundedReport | undefined;
  /** Counts what begins and what ends bounding, so that bounding notices when another call came in between. */
  #run = 0;

  /** @internal Use `Handlebody.biharmonicWeights`. */
  constructor(heap: Heap<Exports>, mesh: SimplexMesh, handles: readonly WeightHandle[], options: BiharmonicWeightsOptions = {}) {
    const read = readOptions(options, READERS, BIHARMONIC_WEIGHTS_DEFAULTS);
    const { order, mass, bounded } = read;
    const made = new SoundMesh(heap, mesh, read);
    this.vertexCount = made.vertexCount;
    this.vertexOf = made.vertexOf;
    this.#heap = heap;
    this.#mesh = made;
    this.#bounded = bounded;
    const object = heap.scope((scratch) => {
      const shape = putMesh(heap, scratch, made.sound);
      const out = scratch.reserve(4);
      heap.check((e) => e.hb_skinning_weights_create(shape, order, MASSES.indexOf(mass), out));
      return heap.u32(out, 1)[0] ?? 0;
    });
    this.#owned = heap.own(this, 'hb_skinning_weights_free', object);
    try {
      this.setHandles(handles);
    } catch (error) {
      this.dispose();
      throw error;
    }
  }

  /** n × handles, row-major; rows sum to 1. */
  get weights(): Float64Array {
    return this.#weights;
  }

  /** The vertices that each handle holds. */
  get vertices(): readonly (readonly number[])[] {
    return this.#vertices;
  }

  get handleCount(): number {
    return this.#vertices.length;
  }

  /** Whether the last `setHandles` had to factor anew; else it was an update, which costs about one solve per changed vertex. */
  get factored(): boolean {
    return this.#heap.call((e) => e.hb_skinning_weights_factored(this.#handle)) !== 0;
  }

  /** Parts that no handle touches, and the handles that they follow. */
  get islands(): readonly Island[] {
    const object = this.#handle;
    return this.#heap.scope((scratch) => {
      const out = scratch.reserve(4);
      const size = this.#heap.call((e) => e.hb_skinning_weights_islands(object, out)) >>> 0;
      const numbers = this.#heap.u32(this.#heap.u32(out, 1)[0] ?? 0, 3 * size);
      return Array.from({ length: size }, (_, k) => {
        const [first = 0, count = 0, handle = 0] = numbers.subarray(3 * k, 3 * k + 3);
        return { first: this.#mesh.first[first] as number, count, handle };
      });
    });
  }

  /**
   * The diagonal mass matrix, M: area or volume of the vertices. That of a place is at its first vertex, and 0 at the others there, so that
   * the sum is that of the shape.
   */
  get mass(): Float64Array {
    const { first, vertexCount } = this.#mesh;
    const at = this.#heap.call((e) => e.hb_skinning_weights_mass(this.#handle));
    const mass = new Float64Array(vertexCount);
    this.#heap.f64(at, first.length).forEach((own, place) => {
      mass[first[place] as number] = own;
    });
    return mass;
  }

  /**
   * Q of the energy wᵀQw: for order 1 the cotangent Laplacian (positive: libigl's `cotmatrix`, negated), for order 2 the bi-Laplacian. The
   * row and column of a place are those of its first vertex; the others there have none.
   */
  get energy(): SparseRows {
    const object = this.#handle;
    const heap = this.#heap;
    return heap.scope((scratch) => {
      const out = scratch.reserve(LAYOUT.hb_sparse_matrix.sizeof);
      const entries = heap.call((e) => e.hb_skinning_weights_energy(object, out)) >>> 0;
      const [starts = 0, columns = 0, values = 0] = heap.u32(out, 3);
      const { first, vertexCount } = this.#mesh;
      const ends = heap.u32(starts, first.length + 1);
      const all = new Uint32Array(vertexCount + 1);
      for (let v = 0, place = 0; v < vertexCount; v++) {
        if (first[place] === v) place++;
        all[v + 1] = ends[place] as number;
      }
      return {
        starts: all,
        columns: heap.u32(columns, entries).map((place) => first[place] as number),
        values: heap.f64(values, entries).slice(),
      };
    });
  }

  /** Sets other handles on the same mesh. The former weights stay when it throws. */
  setHandles(handles: readonly WeightHandle[]): void {
    const object = this.#handle;
    const { held: places, vertices } = resolveHandles(this.#mesh, handles, false);
    this.#heap.scope((scratch) => {
      const held = putHeld(this.#heap, scratch, places);
      this.#heap.check((e) => e.hb_skinning_weights_set_handles(object, held));
    });
    this.#vertices = vertices;
    this.#pending = undefined;
    this.#run++;
    this.#read();
    if (!this.#bounded) return;
    const run = this.#beginBounding(BOUND_DEFAULTS.tolerance);
    this.#heap.scope((scratch) => {
      const progress = scratch.reserve(8);
      do this.#step(progress, run);
      while ((this.#heap.f64(progress, 1)[0] ?? 1) < 1);
    });
    this.#read();
  }

  /**
   * Brings the weights into [0, 1], in small steps so that the thread stays responsive; until it is done, and when it is cancelled,
   * `weights` are what they were. `setHandles` in between ends it.
   */
  async bound(options: BoundOptions = {}): Promise<BoundedReport> {
    const { tolerance, signal, onProgress } = readOptions(options, BOUND_READERS, BOUND_DEFAULTS);
    throwIfAborted(signal);
    const run = this.#beginBounding(tolerance);
    await runStepped(this.#heap, (progress) => this.#step(progress, run), {
      ...(signal && { signal }),
      ...(onProgress && { onProgress }),
    });
    if (run !== this.#run) {
      throw new HandlebodyError('aborted', {
        message: 'Other handles were set while the weights of the former ones were bounded.',
        remedy: 'Bound the weights again.',
      });
    }
    return this.#read() as BoundedReport;
  }

  /** The result of bounding; `undefined` where the weights are not bounded. */
  get boundedReport(): BoundedReport | undefined {
    return this.#report;
  }

  /** Gives the memory back. Calling it again does nothing; calling anything else but `weights` afterwards throws 'disposed'. */
  dispose(): void {
    this.#owned.release();
  }

  [Symbol.dispose](): void {
    this.dispose();
  }

  #beginBounding(tolerance: number): number {
    this.#pending = undefined;
    this.#heap.check((e) => e.hb_skinning_weights_bound_begin(this.#handle, tolerance));
    return ++this.#run;
  }

  #step(progress: number, run: number): void {
    const heap = this.#heap;
    // Another call has ended this bounding.
    if (run !== this.#run) {
      heap.f64(progress, 1)[0] = 1;
      return;
    }
    heap.scope((scratch) => {
      const layout = LAYOUT.hb_bounded_report;
      const report = scratch.reserve(layout.sizeof);
      heap.check((e) => e.hb_skinning_weights_bound_step(this.#handle, progress, report));
      const double = (offset: number) => heap.f64(report + offset, 1)[0] ?? 0;
      const word = (offset: number) => heap.u32(report + offset, 1)[0] ?? 0;
      this.#pending = {
        energy: double(layout.energy),
        gap: double(layout.gap),
        sweeps: word(layout.sweeps),
        newtonSteps: word(layout.newton_steps),
      };
    });
  }

  #read(): BoundedReport | undefined {
    const values = this.#heap.call((e) => e.hb_skinning_weights_values(this.#handle));
    const { first } = this.#mesh;
    this.#weights = this.#mesh.rows(this.#heap.f64(values, first.length * this.handleCount).slice(), this.handleCount);
    this.#report = this.#pending;
    return this.#report;
  }

  get #handle(): number {
    const { pointer } = this.#owned;
    if (pointer !== 0) return pointer;
    throw new HandlebodyError('disposed', {
      message: 'These weights were disposed of and cannot be computed any more.',
      remedy: 'Make new ones with biharmonicWeights(mesh, handles).',
    });
  }
}
