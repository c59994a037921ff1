import type { Exports } from './abi.generated.ts';
import { bake } from './bake.ts';
import { BiharmonicWeights, type BiharmonicWeightsOptions } from './biharmonic-weights.ts';
import { DiscreteGreen, type DiscreteGreenOptions } from './discrete-green.ts';
import { DualQuaternion } from './dual-quaternion.ts';
import { HandlebodyError, throwIfAborted } from './errors.ts';
import { Heap } from './heap.ts';
import { HostKernels } from './host-kernels.ts';
import { Irbf } from './irbf.ts';
import { LinearBlend, type LinearBlendOptions } from './linear-blend.ts';
import { measureWeights, type WeightMeasures } from './measure-weights.ts';
import { EnergyMinimizer, type MinimizeEnergyOptions } from './minimize-energy.ts';
import { MovingLeastSquares, type MovingLeastSquaresOptions } from './moving-least-squares.ts';
import { NaturalNeighbor, type NaturalNeighborOptions } from './natural-neighbor.ts';
import { findOutliers, type OutlierOptions, type OutlierReport } from './outliers.ts';
import { PoseSpace, type PoseSpaceOptions } from './pose-space.ts';
import { Rbf } from './rbf.ts';
import type { RbfOptions } from './rbf-options.ts';
import { Shepard, type ShepardOptions } from './shepard.ts';
import { SimplexLinear, type SimplexLinearOptions } from './simplex-linear.ts';
import type { SimplexMesh } from './simplex-mesh.ts';
import type { SkinOptions } from './skin.ts';
import { TensionSpline, type TensionSplineOptions } from './tension-spline.ts';
import { type Tetrahedra, type TetrahedralizeOptions, tetrahedralize } from './tetrahedralize.ts';
import type { BakeOptions, BakeShape, BodyData, IrbfOptions, Mesh } from './types.ts';
import type { WeightHandle } from './weight-handles.ts';

const ABI_VERSION = 3;

export interface LoadOptions {
  /** The wasm to use instead of the one inside: compiled, as bytes, or where to fetch it. */
  readonly wasm?: WebAssembly.Module | BufferSource | URL;
  readonly signal?: AbortSignal;
}

/** A solver instance: one wasm module with its memory. Every object that it makes lives in that memory. */
export class Handlebody {
  readonly #heap: Heap;

  /** @internal */
  constructor(heap: Heap) {
    this.#heap = heap;
  }

  /** Bytes of memory that the instance holds. */
  get memory(): number {
    return this.#heap.byteLength;
  }

  /**
   * Computes the interior distances and spheres of a surface, a solid or a cloud of points, in small steps so that the thread stays
   * responsive.
   */
  bake(shape: BakeShape, options: BakeOptions = {}): Promise<BodyData> {
    return bake(this.#heap, shape, options);
  }

  /** Prepares a baked body for deformation by handles. */
  irbf(body: BodyData, options: IrbfOptions = {}): Irbf {
    return new Irbf(this.#heap, body, options);
  }

  /** Prepares examples in a pose space for interpolation. */
  poseSpace(options: PoseSpaceOptions): PoseSpace {
    return new PoseSpace(this.#heap, options);
  }

  /** Radial basis interpolation of scattered data, or a smooth fit. */
  rbf(options: RbfOptions): Rbf {
    return new Rbf(this.#heap, options);
  }

  /** Points that a radial basis interpolant has to bend for. */
  findOutliers(options: OutlierOptions): OutlierReport {
    return findOutliers(this.#heap, options);
  }

  /** Linear interpolation of scattered data on its Delaunay simplices, in any dimension. */
  simplexLinear(options: SimplexLinearOptions): SimplexLinear {
    return new SimplexLinear(this.#heap, options);
  }

  /** Sibson's natural neighbor interpolation of scattered data in the plane. */
  naturalNeighbor(options: NaturalNeighborOptions): NaturalNeighbor {
    return new NaturalNeighbor(this.#heap, options);
  }

  /** Shepard's inverse-distance weighting of scattered data. */
  shepard(options: ShepardOptions): Shepard {
    return new Shepard(this.#heap, options);
  }

  /** Moving least squares of scattered data: at every place a polynomial of its own. */
  movingLeastSquares(options: MovingLeastSquaresOptions): MovingLeastSquares {
    return new MovingLeastSquares(this.#heap, options);
  }

  /** The smoothest curve through samples of a grid, by its equations and by the kernel that they imply. */
  discreteGreen(options: DiscreteGreenOptions): DiscreteGreen {
    return new DiscreteGreen(this.#heap, options);
  }

  /** Splines with tension: smooth, with less overshoot, or falling back to zero, as three weights say. */
  tensionSpline(options: TensionSplineOptions): TensionSpline {
    return new TensionSpline(this.#heap, options);
  }

  /** Fills a surface with tetrahedra, on which weights are those of a solid. */
  tetrahedralize(surface: Mesh, options: TetrahedralizeOptions = {}): Tetrahedra {
    return tetrahedralize(this.#heap, surface, options);
  }

  /** Harmonic, biharmonic or triharmonic skinning weights of handles on a mesh. */
  biharmonicWeights(
    mesh: SimplexMesh,
    handles: readonly WeightHandle[],
    options: BiharmonicWeightsOptions = {},
  ): BiharmonicWeights {
    return new BiharmonicWeights(this.#heap, mesh, handles, options);
  }

  /** How smooth, local, shape-aware and bounded weights are, and whether they sum to 1. */
  measureWeights(mesh: SimplexMesh, handles: readonly WeightHandle[], weights: ArrayLike<number>): WeightMeasures {
    return measureWeights(this.#heap, mesh, handles, weights);
  }

  /** Linear blend skinning in the plane or in space. */
  linearBlend(options: LinearBlendOptions): LinearBlend {
    return new LinearBlend(this.#heap, options);
  }

  /** Skinning by dual quaternions: a rigid motion at every vertex. */
  dualQuaternion(options: SkinOptions): DualQuaternion {
    return new DualQuaternion(this.#heap, options);
  }

  /** The deformation of triangles in the plane that minimizes an energy under handles. */
  minimizeEnergy(mesh: SimplexMesh, handles: readonly WeightHandle[], options: MinimizeEnergyOptions): EnergyMinimizer {
    return new EnergyMinimizer(this.#heap, mesh, handles, options);
  }
}

/** Instantiates the solver from a module, bytes or a URL. The default entry and `handlebody/external` both end here. */
export async function instantiate(source: WebAssembly.Module | BufferSource | URL, signal?: AbortSignal): Promise<Handlebody> {
  throwIfAborted(signal);
  if (typeof WebAssembly !== 'object') {
    throw new HandlebodyError('wasm-unavailable', {
      message: 'This browser does not offer WebAssembly, which the solver needs.',
      remedy: 'Use a current browser, and allow WebAssembly if a setting or a security policy blocks it.',
    });
  }
  let exports: Exports;
  const kernels = new HostKernels();
  try {
    const bytes = source instanceof URL ? await fetchBytes(source, signal) : source;
    const module = bytes instanceof WebAssembly.Module ? bytes : await WebAssembly.compile(bytes);
    const instance = await WebAssembly.instantiate(module, imports(module, kernels));
    exports = instance.exports as unknown as Exports;
    (instance.exports._initialize as (() => void) | undefined)?.();
  } catch (cause) {
    if (cause instanceof HandlebodyError) throw cause;
    throwIfAborted(signal);
    throw new HandlebodyError('wasm-unavailable', {
      message: `The solver's WebAssembly could not be started: ${cause instanceof Error ? cause.message : String(cause)}`,
      remedy:
        "Use a current browser; a content security policy needs 'wasm-unsafe-eval'. Check that the file is this version's own.",
      cause,
    });
  }
  throwIfAborted(signal);
  const version = exports.hb_abi_version();
  if (version !== ABI_VERSION) {
    throw new HandlebodyError('wasm-unavailable', {
      message: `The wasm file speaks interface version ${version}, this library ${ABI_VERSION}.`,
      remedy: 'Serve the handlebody.wasm of the same release as the library.',
    });
  }
  return new Handlebody(new Heap(exports, kernels));
}

/** The module asks its host for kernels; whatever else it names is answered with "not supported" (errno 52). */
function imports(module: WebAssembly.Module, kernels: HostKernels): WebAssembly.Imports {
  const answers: Record<string, Record<string, (...args: number[]) => number>> = {};
  for (const { module: space, name } of WebAssembly.Module.imports(module)) {
    answers[space] ??= {};
    answers[space][name] = name === 'emscripten_notify_memory_growth' ? () => 0 : () => 52;
  }
  answers.env = { ...answers.env, hb_host_kernel: kernels.call as (...args: number[]) => number };
  return answers;
}

async function fetchBytes(url: URL, signal: AbortSignal | undefined): Promise<BufferSource> {
  if (url.protocol === 'file:') {
    const { readFile } = await import(/* @vite-ignore */ 'node:fs/promises');
    return new Uint8Array(await readFile(url));
  }
  const response = await fetch(url, signal ? { signal } : {});
  if (!response.ok) throw new Error(`${url.href} answered ${response.status}`);
  return response.arrayBuffer();
}
