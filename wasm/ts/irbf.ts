import { LAYOUT } from './abi.generated.ts';
import { checkMeshArrays } from './check-mesh.ts';
import { unshared } from './copied.ts';
import { HandlebodyError } from './errors.ts';
import { checkFractions } from './fractions.ts';
import { shiftRows, twistWarning, withNearest } from './handle-places.ts';
import { hashPositions } from './hash.ts';
import type { Heap, Scratch } from './heap.ts';
import { checkHeld, checkScales, TARGET_SIZE } from './held-targets.ts';
import { resolve, writeOptions } from './irbf-options.ts';
import type {
  BodyData,
  Handle,
  IrbfOptions,
  IrbfReport,
  IrbfWarning,
  SolveOptions,
  SolveReport,
  TypedArray,
  Vec3,
} from './types.ts';

/** For one solve from rest. A frame of a drag starts from the last solution and wants far fewer, see `solve`. */
export const SOLVE_DEFAULTS = { maxIterations: 100, tolerance: 1e-5, accelerate: true } as const;

/** Made once, so that a frame allocates nothing. */
const FROM_MODEL = { stride: TARGET_SIZE, sign: -1 } as const;

/**
 * The deformation of a baked body by handles (paper 001, §2 and appendix): set handles, write their `targets`, `solve`, `deform`.
 *
 * ```ts
 * const irbf = hb.irbf(body);
 * irbf.setHandles([{ vertex: 120 }, { at: [0, 0.5, 0] }]);
 * irbf.targets.set([0.1, 0.6, 0], 0);
 * irbf.solve();
 * irbf.deform(positions, normals);
 * ```
 */
export class Irbf {
  readonly #heap: Heap;
  readonly #body: BodyData;
  /** Numbers in its positions when this was made: the caller's array may have gone to another thread since. */
  readonly #length: number;
  readonly #positions: number;
  readonly #normals: number;
  readonly #restNormals: number;
  readonly #report: number;
  readonly #hostKernel: number;
  readonly #warn: (warning: IrbfWarning) => void;
  #irbf: number;
  #solved: SolveReport = { energy: 0, anchorError: 0, change: 0, iterations: 0, converged: false };
  #handles = 0;
  #targets = new Float64Array();
  /** 1 for a handle that turns and scales. */
  #kinds = new Uint32Array();
  #hasRestNormals = false;

  /** @internal Use `Handlebody.irbf`. Takes the solver's pointer, and the number of a caller's kernel (0 for none). */
  constructor(
    heap: Heap,
    body: BodyData,
    vertexCount: number,
    irbf: number,
    hostKernel: number,
    warn: (warning: IrbfWarning) => void,
  ) {
    this.#warn = warn;
    this.#heap = heap;
    this.#body = body;
    this.#irbf = irbf;
    this.#hostKernel = hostKernel;
    // Allocated once, so that a frame allocates nothing.
    this.#length = 3 * vertexCount;
    const bytes = this.#length * 4;
    this.#positions = heap.alloc(bytes);
    this.#normals = heap.alloc(bytes);
    this.#restNormals = heap.alloc(bytes);
    this.#report = heap.alloc(LAYOUT.hb_irbf_report.sizeof);
  }

  /** What was given. This deforms what that was then: arrays that change later do not change it. */
  get body(): BodyData {
    return this.#body;
  }

  /** Vertices of the mesh, as stored. */
  get vertexCount(): number {
    return this.#length / 3;
  }

  get handleCount(): number {
    return this.#handles;
  }

  /**
   * Where the handles are to go: 10 numbers per handle, position xyz in model units, quaternion xyzw, scale xyz. Write it in place, then
   * `solve()`. A position handle reads the first three only. The array is replaced by `setHandles`, never otherwise.
   */
  get targets(): Float64Array {
    return this.#targets;
  }

  /** Sets which points are held. Builds and factors the system; every target starts at rest. The former handles stay on failure. */
  setHandles(handles: readonly Handle[]): void {
    const heap = this.#heap;
    const irbf = this.#alive();
    const origin = this.#origin;
    const stored = heap.call((e) => e.hb_irbf_positions(irbf));
    const points = new Float64Array(handles.length * 3);
    const kinds = new Uint32Array(handles.length);
    handles.forEach((handle, i) => {
      kinds[i] = handle.kind === 'rotation' ? 1 : 0;
      if ('at' in handle) {
        points.set(handle.at, i * 3);
        for (let axis = 0; axis < 3; axis++) points[i * 3 + axis] = (points[i * 3 + axis] ?? 0) - (origin?.[axis] ?? 0);
        return;
      }
      if (!Number.isInteger(handle.vertex) || handle.vertex < 0 || handle.vertex >= this.vertexCount) {
        throw new HandlebodyError('handle-out-of-range', {
          message: `Handle ${i} sits on vertex ${handle.vertex}, but the mesh has ${this.vertexCount} vertices.`,
          remedy: `Use a vertex number from 0 to ${this.vertexCount - 1}.`,
          culprit: { kind: 'handle', index: i },
        });
      }
      points.set(heap.f64(stored + 24 * handle.vertex, 3), i * 3);
    });
    heap.scope((scratch) => {
      const [at, kind] = [scratch.putF64(points), scratch.putU32(kinds)];
      try {
        runKernel(heap, () => heap.check((e) => e.hb_irbf_set_handles(irbf, at, kind, handles.length)));
      } catch (error) {
        throw withNearest(error, this.#body, points);
      }
    });
    this.#handles = handles.length;
    this.#kinds = kinds;
    this.#targets = heap
      .f64(
        heap.call((e) => e.hb_irbf_targets(irbf)),
        handles.length * TARGET_SIZE,
      )
      .slice();
    if (origin) shiftRows(this.#targets, origin, { stride: TARGET_SIZE, sign: 1 });
    const warning = twistWarning(points, kinds);
    if (warning) this.#warn(warning);
  }

  /**
   * Local/global iterations from where the last call stopped: a few in every frame keep a drag smooth, and go on converging when it
   * rests. On bad targets it throws and the last solution stays: 'target-not-finite' also where the model, grown by a scale, is
   * beyond what floats can hold.
   */
  solve(options: SolveOptions = {}): SolveReport {
    const heap = this.#heap;
    const irbf = this.#alive();
    const maxIterations = options.maxIterations ?? SOLVE_DEFAULTS.maxIterations;
    const tolerance = options.tolerance ?? SOLVE_DEFAULTS.tolerance;
    const accelerate = options.accelerate ?? SOLVE_DEFAULTS.accelerate;
    checkScales(this.#targets, this.#kinds, this.#body.normalization.diagonal);
    const targets = heap.call((e) => e.hb_irbf_targets(irbf));
    const given = heap.f64(targets, this.#targets.length);
    given.set(this.#targets);
    if (this.#origin) shiftRows(given, this.#origin, FROM_MODEL);
    heap.check((e) => e.hb_irbf_solve(irbf, maxIterations, tolerance, accelerate ? 1 : 0, this.#report));
    const layout = LAYOUT.hb_irbf_report;
    const numbers = heap.f64(this.#report, 3);
    const words = heap.u32(this.#report + layout.iterations, 2);
    this.#solved = {
      energy: numbers[0] ?? 0,
      anchorError: numbers[1] ?? 0,
      change: numbers[2] ?? 0,
      iterations: words[0] ?? 0,
      converged: words[1] === 1,
    };
    return this.#solved;
  }

  /**
   * The last `solve`, and how the present deformation treats volume and shape: on `tetrahedra` of the mesh's own vertices (m×4) or, without
   * them, on the voxels, six tetrahedra each. Takes some frames' time; the first call on voxels prepares them.
   */
  report(tetrahedra: ArrayLike<number> = []): IrbfReport {
    const heap = this.#heap;
    const irbf = this.#alive();
    if (tetrahedra.length % 4 !== 0) {
      throw new HandlebodyError('invalid-shape', {
        message: `The tetrahedra have ${tetrahedra.length} numbers, which is not a multiple of 4.`,
        remedy: 'Give four vertex numbers for every tetrahedron.',
      });
    }
    return heap.scope((scratch) => {
      const layout = LAYOUT.hb_irbf_quality;
      const corners = scratch.putU32(tetrahedra);
      const out = scratch.reserve(layout.sizeof);
      runKernel(heap, () => heap.check((e) => e.hb_irbf_measure(irbf, corners, tetrahedra.length / 4, out)));
      const number = (offset: number) => heap.f64(out + offset, 1)[0] ?? 0;
      const word = (offset: number) => heap.u32(out + offset, 1)[0] ?? 0;
      return {
        ...this.#solved,
        smoothness: number(layout.smoothness),
        condition: number(layout.condition),
        maximumPrinciple: number(layout.maximum_principle),
        volumeRatio: number(layout.volume_ratio),
        distortion: { total: number(layout.total_distortion), max: number(layout.max_distortion) },
        flips: word(layout.flips),
        tetrahedra: word(layout.tetrahedra),
      };
    });
  }

  /**
   * Normals to start from in `deform`, n×3: authored ones keep their creases. Without them normals are area-weighted averages of the
   * triangles around each welded vertex.
   */
  setRestNormals(normals: TypedArray): void {
    this.#alive();
    this.#checkLength('rest normals', normals.length);
    this.#heap.f32(this.#restNormals, normals.length).set(normals);
    this.#hasRestNormals = true;
  }

  /**
   * Writes the deformed positions, and normals if asked, of all vertices as stored (n×3), relative to `body.mesh.origin` where there is
   * one. Allocates nothing. Throws 'target-not-finite' naming a vertex that the targets send beyond what floats can hold; nothing is
   * written then.
   */
  deform(positions: TypedArray, normals?: TypedArray): void {
    const heap = this.#heap;
    const irbf = this.#alive();
    this.#checkLength('positions', positions.length);
    checkFractions(positions);
    if (normals) {
      this.#checkLength('normals', normals.length);
      checkFractions(normals);
    }
    const rest = normals && this.#hasRestNormals ? this.#restNormals : 0;
    heap.check((e) => e.hb_irbf_deform(irbf, this.#positions, rest, normals ? this.#normals : 0));
    const [moved, turned] = [heap.f32(this.#positions, positions.length), normals && heap.f32(this.#normals, normals.length)];
    checkHeld(moved);
    if (turned) checkHeld(turned);
    positions.set(moved);
    if (turned) normals?.set(turned);
  }

  /** The deformation at any points of space (k×3, model units), in double precision. */
  evaluate<T extends TypedArray = Float64Array>(points: ArrayLike<number>, given?: T): T {
    const out: TypedArray = given ?? new Float64Array(points.length);
    checkFractions(out);
    const heap = this.#heap;
    const irbf = this.#alive();
    if (points.length % 3 !== 0 || out.length !== points.length) {
      throw new HandlebodyError('invalid-shape', {
        message: `evaluate() got ${points.length} numbers in and room for ${out.length} out.`,
        remedy: 'Give x, y and z for every point, and as much room for the result.',
      });
    }
    heap.scope((scratch) => {
      const [from, to] = [scratch.putF64(points), scratch.reserve(points.length * 8)];
      if (this.#origin) shiftRows(heap.f64(from, points.length), this.#origin, { stride: 3, sign: -1 });
      runKernel(heap, () => heap.check((e) => e.hb_irbf_evaluate(irbf, from, points.length / 3, to)));
      const found = heap.f64(to, out.length);
      if (this.#origin) shiftRows(found, this.#origin, { stride: 3, sign: 1 });
      out.set(found);
    });
    return out as T;
  }

  /**
   * Another deformation of the same body with the same options, at rest and without handles, for a second copy of it on the page. What does
   * not depend on handles is shared: for the dog, some nine tenths of the memory. Each is disposed of by itself.
   *
   * ```ts
   * const second = irbf.share();
   * second.setHandles([{ vertex: 7 }]);
   * ```
   */
  share(): Irbf {
    const heap = this.#heap;
    const irbf = this.#alive();
    const shared = heap.scope((scratch) => {
      const out = scratch.reserve(4);
      heap.check((e) => e.hb_irbf_share(irbf, out));
      return heap.u32(out, 1)[0] ?? 0;
    });
    heap.kernels.share(this.#hostKernel);
    return new Irbf(heap, this.#body, this.vertexCount, shared, this.#hostKernel, this.#warn);
  }

  /** Gives the memory back. Calling it again does nothing; calling anything else afterwards throws 'disposed'. */
  dispose(): void {
    if (this.#irbf === 0) return;
    const irbf = this.#irbf;
    this.#irbf = 0;
    this.#heap.release((e) => e.hb_irbf_free(irbf));
    for (const pointer of [this.#positions, this.#normals, this.#restNormals, this.#report]) this.#heap.free(pointer);
    this.#heap.kernels.remove(this.#hostKernel);
  }

  [Symbol.dispose](): void {
    this.dispose();
  }

  /** What the body is relative to: all that the solver sees. */
  get #origin(): Vec3 | undefined {
    return this.#body.mesh.origin;
  }

  #alive(): number {
    if (this.#irbf !== 0) return this.#irbf;
    throw new HandlebodyError('disposed', {
      message: 'This deformation was disposed of and cannot be used any more.',
      remedy: 'Make a new one with irbf(body).',
    });
  }

  #checkLength(name: string, length: number): void {
    const expected = this.#length;
    if (length === expected) return;
    throw new HandlebodyError('invalid-shape', {
      message: `The ${name} have ${length} numbers, the mesh has ${expected}.`,
      remedy: 'Give x, y and z for every vertex of the baked mesh, in its order.',
    });
  }
}

/** @internal See `Handlebody.irbf`. */
export function createIrbf(heap: Heap, given: BodyData, how: IrbfOptions): Irbf {
  const options = resolve(how);
  // What the hash is of is what is taken.
  const body = { ...given, mesh: { ...given.mesh, positions: unshared(given.mesh.positions) } };
  checkBody(body);
  const hostKernel = typeof options.kernel === 'string' ? 0 : heap.kernels.add(options.kernel);
  try {
    const irbf = runKernel(heap, () =>
      heap.scope((scratch) => {
        const at = writeBody(heap, scratch, body);
        const optionsAt = writeOptions(heap, scratch, options, hostKernel);
        const out = scratch.reserve(4);
        heap.check((e) => e.hb_irbf_create(at, optionsAt, out));
        return heap.u32(out, 1)[0] ?? 0;
      }),
    );
    return new Irbf(heap, given, body.mesh.positions.length / 3, irbf, hostKernel, options.onWarning);
  } catch (error) {
    heap.kernels.remove(hostKernel);
    throw error;
  }
}

/** A body as the ABI's hb_body. */
function writeBody(heap: Heap, scratch: Scratch, body: BodyData): number {
  const layout = LAYOUT.hb_body;
  const at = scratch.reserve(layout.sizeof);
  const arrays = {
    positions: scratch.putF64(body.mesh.positions),
    triangles: scratch.putU32(body.mesh.triangles),
    voxels: scratch.putU32(body.voxels),
    centers: scratch.putU32(body.centers),
    distances: scratch.putU16(body.distances),
    spheres: scratch.putF64(body.spheres),
  };
  heap.f64(at + layout.center, 3).set(body.normalization.center);
  heap.f64(at + layout.diagonal, 1)[0] = body.normalization.diagonal;
  heap.f64(at + layout.origin, 3).set(body.grid.origin);
  heap.f64(at + layout.spacing, 1)[0] = body.grid.spacing;
  heap.f64(at + layout.distance_scale, 1)[0] = body.distanceScale;
  heap.u32(at + layout.dims, 3).set(body.grid.dimensions);
  const words = {
    vertex_count: body.mesh.positions.length / 3,
    triangle_count: body.mesh.triangles.length / 3,
    voxel_count: body.voxels.length,
    center_count: body.centers.length,
    sphere_count: body.spheres.length / 4,
    ...arrays,
  };
  for (const [name, value] of Object.entries(words)) heap.u32(at + layout[name as keyof typeof words], 1)[0] = value;
  return at;
}

/** Runs what calls the kernel. Where that is the caller's and failed, its own error is thrown, which says more. */
function runKernel<T>(heap: Heap, call: () => T): T {
  try {
    const result = call();
    heap.kernels.throwFailure();
    return result;
  } catch (error) {
    heap.kernels.throwFailure(error);
    throw error;
  }
}

/** Contradictions that must be found before the arrays are copied: lengths, and a mesh changed since baking. */
function checkBody(body: BodyData): void {
  checkMeshArrays(body.mesh);
  const expected = body.centers.length * body.voxels.length;
  if (body.distances.length !== expected || body.spheres.length % 4 !== 0) {
    throw new HandlebodyError('body-invalid', {
      message: `The baked body has ${body.distances.length} distances, but ${body.centers.length} centers × ${body.voxels.length} voxels need ${expected}.`,
      remedy: 'Bake the model again.',
    });
  }
  if (hashPositions(body.mesh.positions) !== body.positionsHash) {
    throw new HandlebodyError('body-mismatch', {
      message: 'The interior distances were baked for other vertex positions than this mesh has.',
      remedy: 'Bake the model again after its last change: bake last.',
    });
  }
}
