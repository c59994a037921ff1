import type { Exports } from './abi.generated.ts';
import { bake } from './bake.ts';
import { BiharmonicWeights, type BiharmonicWeightsOptions } from './biharmonic-weights.ts';
import { bound } from './bound.ts';
import { DiscreteGreen, type DiscreteGreenOptions } from './discrete-green.ts';
import { HandlebodyRuntime } from './handlebody-runtime.ts';
import type { Heap } from './heap.ts';
import { measureWeights, type WeightMeasures } from './measure-weights.ts';
import type { MeshOptions } from './mesh-warnings.ts';
import { EnergyMinimizer, type MinimizeEnergyOptions } from './minimize-energy.ts';
import type { SimplexMesh } from './simplex-mesh.ts';
import { type Tetrahedra, type TetrahedralizeOptions, tetrahedralize } from './tetrahedralize.ts';
import type { BakeOptions, BakeShape, BodyData, Mesh } from './types.ts';
import type { WeightHandle } from './weight-handles.ts';

/**
 * A solver instance that can do everything: bake bodies, compute weights and minimize energies, besides what `HandlebodyRuntime` does.
 *
 * ```ts
 * const body = await hb.bake(mesh, { centers: 60 });
 * const solid = hb.tetrahedralize(mesh, { resolution: 16 });
 * ```
 */
export class Handlebody extends HandlebodyRuntime {
  readonly #heap: Heap<Exports>;

  /** @internal */
  constructor(heap: Heap<Exports>) {
    super(heap);
    this.#heap = heap;
  }

  /**
   * Computes the interior distances and spheres of a surface, a solid or a cloud of points, in small steps so that the thread stays
   * responsive.
   */
  bake(shape: BakeShape, options: BakeOptions = {}): Promise<BodyData> {
    return bake(this.#heap, shape, options);
  }

  /** The smoothest curve through samples of a grid, by its equations and by the kernel that they imply. */
  discreteGreen(options: DiscreteGreenOptions): DiscreteGreen {
    return bound(new DiscreteGreen(this.#heap, options));
  }

  /** Fills a surface with tetrahedra, on which weights are those of a solid. */
  tetrahedralize(surface: Mesh, options: TetrahedralizeOptions = {}): Tetrahedra {
    return bound(tetrahedralize(this.#heap, surface, options));
  }

  /** Harmonic, biharmonic or triharmonic skinning weights of handles on a mesh. */
  biharmonicWeights(
    mesh: SimplexMesh,
    handles: readonly WeightHandle[],
    options: BiharmonicWeightsOptions = {},
  ): BiharmonicWeights {
    return bound(new BiharmonicWeights(this.#heap, mesh, handles, options));
  }

  /** How smooth, local, shape-aware and bounded weights are, and whether they sum to 1. */
  measureWeights(
    mesh: SimplexMesh,
    handles: readonly WeightHandle[],
    weights: ArrayLike<number>,
    options: MeshOptions = {},
  ): WeightMeasures {
    return measureWeights(this.#heap, mesh, handles, weights, options);
  }

  /** The deformation of triangles in the plane that minimizes an energy under handles. */
  minimizeEnergy(mesh: SimplexMesh, handles: readonly WeightHandle[], options: MinimizeEnergyOptions): EnergyMinimizer {
    return bound(new EnergyMinimizer(this.#heap, mesh, handles, options));
  }
}
