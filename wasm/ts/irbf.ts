import { LAYOUT } from './abi.generated.ts';
import { checkNames, checkRoom, flag, indices, type Numbers, number, numbers, object, row, whole } from './arguments.ts';
import { bound } from './bound.ts';
import { HandlebodyError } from './errors.ts';
import { readHandles, shiftRows, twistWarning, withNearest } from './handle-places.ts';
import type { Heap } from './heap.ts';
import { checkHeld, checkScales, TARGET_SIZE } from './held-targets.ts';
import { readBody, writeBody } from './irbf-body.ts';
import { resolve, writeOptions } from './irbf-options.ts';
import type { Owned } from './owned.ts';
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
  readonly #owned: Owned;
  readonly #warn: (warning: IrbfWarning) => void;
  #solved: SolveReport = { energy: 0, anchorError: 0, change: 0, iterations: 0, converged: false };
  #handles = 0;
  #targets = new Float64Array();
  readonly #shapes: Float64Array;
  /** 1 for a handle that turns and scales. */
  #kinds = new Uint32Array();
  #hasRestNormals = false;

  /** @internal Use `Handlebody.irbf`. Takes the solver's pointer, and the number of a caller's kernel (0 for none). */
  constructor(
    heap: Heap,
    body: BodyData,
    { vertices, spheres }: { vertices: number; spheres: number },
    irbf: number,
    hostKernel: number,
    warn: (warning: IrbfWarning) => void,
  ) {
    this.#warn = warn;
    this.#heap = heap;
    this.#body = body;
    // Allocated once, so that a frame allocates nothing.
    this.#length = 3 * vertices;
    const bytes = this.#length * 4;
    const blocks = [bytes, bytes, bytes, LAYOUT.hb_irbf_report.sizeof];
    this.#owned = heap.own(this, 'hb_irbf_free', irbf, { blocks, kernel: hostKernel });
    [this.#positions = 0, this.#normals = 0, this.#restNormals = 0, this.#report = 0] = this.#owned.blocks;
    this.#shapes = new Float64Array(9 * spheres);
    this.#shapes.set(this.#shapesInSolver());
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

  /**
   * What shape the spheres are to take (§2.4, eq. (11)): 9 numbers a sphere, the rows of a linear map of the sphere at rest, which may turn
   * as it likes; the identity, as it is at first, keeps the sphere. A larger one inflates, a diagonal scales along axes. Write it in place,
   * then `solve()`.
   *
   * ```ts
   * irbf.shapes.set([1.5, 0, 0, 0, 1, 0, 0, 0, 1], 9 * sphere); // longer along x by a half
   * ```
   */
  get shapes(): Float64Array {
    return this.#shapes;
  }

  /** Sets which points are held. Builds and factors the system; every target starts at rest. The former handles stay on failure. */
  setHandles(handles: readonly Handle[]): void {
    const heap = this.#heap;
    const irbf = this.#alive();
    const origin = this.#origin;
    const stored = heap.call((e) => e.hb_irbf_positions(irbf));
    const held = readHandles(handles, this.vertexCount);
    const points = new Float64Array(held.length * 3);
    const kinds = new Uint32Array(held.length);
    held.forEach(({ vertex, at, kind }, i) => {
      kinds[i] = kind === 'rotation' ? 1 : 0;
      points.set(at ?? heap.f64(stored + 24 * (vertex as number), 3), i * 3);
      if (at && origin) for (let axis = 0; axis < 3; axis++) points[i * 3 + axis] = (at[axis] as number) - (origin[axis] as number);
    });
    heap.scope((scratch) => {
      const [at, kind] = [scratch.putF64(points), scratch.putU32(kinds)];
      try {
        runKernel(heap, () => heap.check((e) => e.hb_irbf_set_handles(irbf, at, kind, held.length)));
      } catch (error) {
        throw withNearest(error, this.#body, points);
      }
    });
    this.#handles = held.length;
    this.#kinds = kinds;
    this.#targets = heap
      .f64(
        heap.call((e) => e.hb_irbf_targets(irbf)),
        held.length * TARGET_SIZE,
      )
      .slice();
    if (origin) shiftRows(this.#targets, origin, { stride: TARGET_SIZE, sign: 1 });
    const warning = twistWarning(points, kinds);
    if (warning) this.#warn(warning);
  }

  /**
   * Local/global iterations from where the last call stopped: a few in every frame keep a drag smooth, and go on converging when it
   * rests. On bad targets or shapes it throws and the last solution stays: 'target-not-finite' also where the model, grown by a scale, is
   * beyond what floats can hold, 'shape-inverted' for a shape that turns its sphere inside out.
   */
  solve(options: SolveOptions = {}): SolveReport {
    const heap = this.#heap;
    const irbf = this.#alive();
    // Not by `options`, which makes an object: a frame allocates nothing.
    checkNames(object(options, 'options', 'Give an object of options.'), SOLVE, 'options');
    const { maxIterations = SOLVE_DEFAULTS.maxIterations, tolerance = SOLVE_DEFAULTS.tolerance } = options;
    const { accelerate = SOLVE_DEFAULTS.accelerate } = options;
    SOLVE.maxIterations(maxIterations, 'maxIterations');
    SOLVE.tolerance(tolerance, 'tolerance');
    SOLVE.accelerate(accelerate, 'accelerate');
    checkScales(this.#targets, this.#kinds, this.#body.normalization.diagonal);
    const targets = heap.call((e) => e.hb_irbf_targets(irbf));
    const given = heap.f64(targets, this.#targets.length);
    given.set(this.#targets);
    if (this.#origin) shiftRows(given, this.#origin, FROM_MODEL);
    this.#shapesInSolver().set(this.#shapes);
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
  report(tetrahedra: Numbers = []): IrbfReport {
    const given = indices(tetrahedra, 'tetrahedra', CORNERS, this.vertexCount);
    const heap = this.#heap;
    const irbf = this.#alive();
    if (given.length % 4 !== 0) {
      throw new HandlebodyError('invalid-shape', {
        message: `The tetrahedra have ${given.length} numbers, which is not a multiple of 4.`,
        remedy: 'Give four vertex numbers for every tetrahedron.',
      });
    }
    return heap.scope((scratch) => {
      const layout = LAYOUT.hb_irbf_quality;
      const corners = scratch.putU32(given);
      const out = scratch.reserve(layout.sizeof);
      runKernel(heap, () => heap.check((e) => e.hb_irbf_measure(irbf, corners, given.length / 4, out)));
      const number = (offset: number) => heap.f64(out + offset, 1)[0] ?? 0;
      const word = (offset: number) => heap.u32(out + offset, 1)[0] ?? 0;
      return {
        ...this.#solved,
        smoothness: number(layout.smoothness),
        relativeWidth: number(layout.relative_width),
        centers: this.#body.centers.length,
        spheres: this.#shapes.length / 9,
        voxels: this.#body.voxels.length,
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
  setRestNormals(normals: Numbers): void {
    this.#alive();
    this.#heap.f32(this.#restNormals, this.#length).set(row(normals, 'normals', this.#length));
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
    checkRoom(positions, 'positions', this.#length);
    if (normals !== undefined) checkRoom(normals, 'normals', this.#length);
    const rest = normals && this.#hasRestNormals ? this.#restNormals : 0;
    heap.check((e) => e.hb_irbf_deform(irbf, this.#positions, rest, normals ? this.#normals : 0));
    const [moved, turned] = [heap.f32(this.#positions, positions.length), normals && heap.f32(this.#normals, normals.length)];
    checkHeld(moved);
    if (turned) checkHeld(turned);
    positions.set(moved);
    if (turned) normals?.set(turned);
  }

  /** The deformation at any points of space (k×3, model units), in double precision. */
  evaluate<T extends TypedArray = Float64Array>(points: Numbers, out?: T): T {
    const heap = this.#heap;
    const irbf = this.#alive();
    const asked = numbers(points, 'points', ASKED);
    if (asked.length % 3 !== 0) {
      throw new HandlebodyError('invalid-shape', {
        message: `The "points" have ${asked.length} numbers, which is not a multiple of 3.`,
        remedy: 'Give x, y and z for every point.',
      });
    }
    if (out !== undefined) checkRoom(out, 'out', asked.length);
    const result: TypedArray = out ?? new Float64Array(asked.length);
    heap.scope((scratch) => {
      const [from, to] = [scratch.putF64(asked), scratch.reserve(asked.length * 8)];
      if (this.#origin) shiftRows(heap.f64(from, asked.length), this.#origin, { stride: 3, sign: -1 });
      runKernel(heap, () => heap.check((e) => e.hb_irbf_evaluate(irbf, from, asked.length / 3, to)));
      const found = heap.f64(to, asked.length);
      if (this.#origin) shiftRows(found, this.#origin, { stride: 3, sign: 1 });
      result.set(found);
    });
    return result as T;
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
    const { kernel } = this.#owned;
    heap.kernels.share(kernel);
    return bound(
      new Irbf(heap, this.#body, { vertices: this.vertexCount, spheres: this.#shapes.length / 9 }, shared, kernel, this.#warn),
    );
  }

  /** Gives the memory back. Calling it again does nothing; calling anything else afterwards throws 'disposed'. */
  dispose(): void {
    this.#owned.release();
  }

  [Symbol.dispose](): void {
    this.dispose();
  }

  /** What the body is relative to: all that the solver sees. */
  get #origin(): Vec3 | undefined {
    return this.#body.mesh.origin;
  }

  /** A view, until memory grows. */
  #shapesInSolver(): Float64Array {
    const { pointer } = this.#owned;
    return this.#heap.f64(
      this.#heap.call((e) => e.hb_irbf_shapes(pointer)),
      this.#shapes.length,
    );
  }

  #alive(): number {
    const { pointer } = this.#owned;
    if (pointer !== 0) return pointer;
    throw new HandlebodyError('disposed', {
      message: 'This deformation was disposed of and cannot be used any more.',
      remedy: 'Make a new one with irbf(body).',
    });
  }
}

/** @internal See `Handlebody.irbf`. */
export function createIrbf(heap: Heap, given: BodyData, how: IrbfOptions): Irbf {
  const options = resolve(how);
  // What the hash is of is what is taken.
  const body = readBody(given);
  const hostKernel = typeof options.kernel === 'string' ? 0 : heap.kernels.add(options.kernel);
  let irbf: number;
  try {
    irbf = runKernel(heap, () =>
      heap.scope((scratch) => {
        const at = writeBody(heap, scratch, body);
        const optionsAt = writeOptions(heap, scratch, options, hostKernel);
        const out = scratch.reserve(4);
        heap.check((e) => e.hb_irbf_create(at, optionsAt, out));
        return heap.u32(out, 1)[0] ?? 0;
      }),
    );
  } catch (error) {
    heap.kernels.remove(hostKernel);
    throw error;
  }
  const counts = { vertices: body.mesh.positions.length / 3, spheres: body.spheres.length / 4 };
  return new Irbf(heap, given, counts, irbf, hostKernel, options.onWarning);
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

const CORNERS = { kind: 'tetrahedron', width: 4 } as const;
const ASKED = { code: 'query-not-finite', kind: 'query', width: 3 } as const;

const SOLVE = {
  maxIterations: whole(0, 0xffff_ffff),
  tolerance: number('a number from 0 on', (x) => x >= 0),
  accelerate: flag,
};
