import { bound } from './bound.ts';
import { DualQuaternion } from './dual-quaternion.ts';
import type { Heap } from './heap.ts';
import { createIrbf, type Irbf } from './irbf.ts';
import { LinearBlend, type LinearBlendOptions } from './linear-blend.ts';
import { MovingLeastSquares, type MovingLeastSquaresOptions } from './moving-least-squares.ts';
import { NaturalNeighbor, type NaturalNeighborOptions } from './natural-neighbor.ts';
import { findOutliers, type OutlierOptions, type OutlierReport } from './outliers.ts';
import { PoseSpace, type PoseSpaceOptions } from './pose-space.ts';
import { Rbf } from './rbf.ts';
import type { RbfOptions } from './rbf-options.ts';
import { Shepard, type ShepardOptions } from './shepard.ts';
import { SimplexLinear, type SimplexLinearOptions } from './simplex-linear.ts';
import type { SkinOptions } from './skin.ts';
import { TensionSpline, type TensionSplineOptions } from './tension-spline.ts';
import type { BodyData, IrbfOptions } from './types.ts';

/**
 * A solver instance: one wasm module with its memory. Every object that it makes lives in that memory.
 *
 * It deforms and interpolates, with bodies and weights that were made elsewhere. `Handlebody`, of the import "handlebody", makes bodies and
 * weights.
 *
 * ```ts
 * const f = hb.shepard({ dimension: 1, points: [0, 1], values: [2, 3] });
 * f.evaluate([0.5]);
 * hb.memory; // bytes
 * ```
 */
export class HandlebodyRuntime {
  readonly #heap: Heap;

  /** @internal */
  constructor(heap: Heap) {
    this.#heap = heap;
  }

  /** Bytes of memory that the instance holds; 0 after `dispose()`. */
  get memory(): number {
    return this.#heap.byteLength;
  }

  /** Whether it can still be called: not after `dispose()`, nor after a call that ended with 'wasm-trapped'. */
  get usable(): boolean {
    return this.#heap.usable;
  }

  /** Prepares a baked body for deformation by handles. */
  irbf(body: BodyData, options: IrbfOptions = {}): Irbf {
    return bound(createIrbf(this.#heap, body, options));
  }

  /** Prepares examples in a pose space for interpolation. */
  poseSpace(options: PoseSpaceOptions): PoseSpace {
    return bound(new PoseSpace(this.#heap, options));
  }

  /** Radial basis interpolation of scattered data, or a smooth fit. */
  rbf(options: RbfOptions): Rbf {
    return bound(new Rbf(this.#heap, options));
  }

  /** Finds outliers: points that a radial basis interpolant has to bend for. */
  findOutliers(options: OutlierOptions): OutlierReport {
    return findOutliers(this.#heap, options);
  }

  /** Linear interpolation of scattered data on its Delaunay simplices, in any dimension. */
  simplexLinear(options: SimplexLinearOptions): SimplexLinear {
    return bound(new SimplexLinear(this.#heap, options));
  }

  /** Sibson's natural neighbor interpolation of scattered data in the plane. */
  naturalNeighbor(options: NaturalNeighborOptions): NaturalNeighbor {
    return bound(new NaturalNeighbor(this.#heap, options));
  }

  /** Shepard's inverse-distance weighting of scattered data. */
  shepard(options: ShepardOptions): Shepard {
    return bound(new Shepard(this.#heap, options));
  }

  /** Moving least squares of scattered data: at every place a polynomial of its own. */
  movingLeastSquares(options: MovingLeastSquaresOptions): MovingLeastSquares {
    return bound(new MovingLeastSquares(this.#heap, options));
  }

  /** Splines with tension: smooth, with less overshoot, or falling back to zero, according to three weights. */
  tensionSpline(options: TensionSplineOptions): TensionSpline {
    return bound(new TensionSpline(this.#heap, options));
  }

  /** Linear blend skinning in the plane or in space. */
  linearBlend(options: LinearBlendOptions): LinearBlend {
    return bound(new LinearBlend(this.#heap, options));
  }

  /** Skinning by dual quaternions: a rigid motion at every vertex. */
  dualQuaternion(options: SkinOptions): DualQuaternion {
    return bound(new DualQuaternion(this.#heap, options));
  }

  /**
   * Ends the instance: its memory and all that it made are given up, and may be collected. Whatever is done with them afterwards throws
   * 'disposed', their own `dispose()` apart; long work that is under way, such as a bake, rejects with it. Calling it again does nothing.
   *
   * ```ts
   * {
   *   using hb = await load();
   *   hb.irbf(body).setHandles([{ vertex: 0 }]);
   * } // nothing of it is left
   * ```
   */
  dispose(): void {
    this.#heap.dispose();
  }

  [Symbol.dispose](): void {
    this.dispose();
  }
}
