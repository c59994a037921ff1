import { type Exports, LAYOUT } from './abi.generated.ts';
import { checkRoom, named, options, type Readers, told, whole } from './arguments.ts';
import { HandlebodyError } from './errors.ts';
import type { Heap } from './heap.ts';
import { meshLike } from './mesh-arrays.ts';
import { MESH_READERS, type MeshOptions } from './mesh-warnings.ts';
import { putMesh, type SimplexMesh } from './simplex-mesh.ts';
import { Skin } from './skin.ts';
import { MESH_DEFAULTS, SoundMesh } from './sound-mesh.ts';
import type { TypedArray } from './types.ts';
import { putHeld, resolveHandles, type WeightHandle } from './weight-handles.ts';

/**
 * Energy of the map f = v + u of the shape:
 * - `dirichlet` ½ ∫|∇u|²: kinks at the handles, not invariant under rotations;
 * - `laplacian` ½ ∫(Δu)²: smooth, not invariant under rotations either;
 * - `conformal` ½ ∫|∇f|² − area(f): as similar as possible, angles stay, sizes may not;
 * - `rigid` ½ ∫|∇f − R|², R the nearest rotation: as rigid as possible, minimized in rounds.
 */
export type DeformationEnergy = 'dirichlet' | 'laplacian' | 'conformal' | 'rigid';

export interface MinimizeEnergyOptions extends MeshOptions {
  readonly energy: DeformationEnergy;
  /** The most rounds of `rigid` that a frame takes; it starts where the last one stopped. */
  readonly iterations?: number;
}

export const MINIMIZE_ENERGY_DEFAULTS = { iterations: 10, ...MESH_DEFAULTS } as const;

/** The result of a frame. */
export interface MinimizeEnergyReport {
  /** The energy, in units of area (`laplacian`: none). */
  readonly energy: number;
  /** Rounds taken; 1 where a single solve suffices. */
  readonly iterations: number;
  /** Triangles that were turned over, or lost their area. */
  readonly flips: number;
}

const ENERGIES: readonly DeformationEnergy[] = ['dirichlet', 'laplacian', 'conformal', 'rigid'];

const READERS = { ...MESH_READERS, energy: named(ENERGIES), iterations: whole(1, 1e6) } satisfies Readers<MinimizeEnergyOptions>;

/**
 * The deformation of triangles in the plane that minimizes an energy while the handles hold their vertices where their transforms take
 * them; a handle of one vertex also holds the vertices next to it (lecture, "Energy-based Deformation"). Parts without a handle move as a
 * whole with the nearest one. Vertices at one place move as one, and those that only flat triangles use with the nearest point of the
 * others. Factors once; a frame is one solve, or one per round.
 *
 * ```ts
 * const map = hb.minimizeEnergy({ positions, dimension: 2, triangles }, [{ vertex: 3 }, { vertex: 40 }], { energy: 'rigid' });
 * map.transforms.set([0, -1, 2, 1, 0, 0], 6); // turns handle 1 by 90° and shifts it by 2
 * const { energy, flips } = map.deform(out);
 * ```
 */
export class EnergyMinimizer extends Skin {
  readonly energy: DeformationEnergy;
  /** The vertices that each handle was given; not those next to them. */
  readonly vertices: readonly (readonly number[])[];
  /** For each vertex the first one at its place, with which it moves: itself, unless the mesh splits it. */
  readonly vertexOf: Uint32Array;
  /** @internal */
  declare protected readonly heap: Heap<Exports>;
  readonly #mesh: SoundMesh;
  /** For each flat vertex where it is, seen from the point that it moves with. */
  readonly #offsets: Float64Array;
  readonly #iterations: number;
  readonly #report: number;

  /** @internal Use `Handlebody.minimizeEnergy`. */
  constructor(heap: Heap<Exports>, mesh: SimplexMesh, handles: readonly WeightHandle[], given: MinimizeEnergyOptions) {
    const read = options(given, READERS, MINIMIZE_ENERGY_DEFAULTS);
    const { energy, iterations } = read;
    const number = ENERGIES.indexOf(energy);
    const { dimension = 3 } = meshLike(mesh, 'mesh');
    if (dimension !== 2) {
      throw new HandlebodyError('invalid-shape', {
        message: `Energies are minimized in the plane; the mesh has ${told(dimension)} dimensions.`,
        remedy: 'Give two coordinates a vertex, and dimension: 2.',
      });
    }
    const made = new SoundMesh(heap, mesh, read);
    const { held: places, vertices } = resolveHandles(made, handles, false);
    super(
      heap,
      { dimension: 2, vertexCount: made.vertexCount, handleCount: places.length },
      (out, [shape = 0, held = 0]) => heap.check((e) => e.hb_minimizer_create(shape, held, number, out)),
      (scratch) => [putMesh(heap, scratch, made.sound), putHeld(heap, scratch, places)],
    );
    this.energy = energy;
    this.vertices = vertices;
    this.vertexOf = made.vertexOf;
    this.#mesh = made;
    const rest = made.rows(Float64Array.from(made.sound.positions), 2);
    this.#offsets = Float64Array.from({ length: 2 * made.flatVertices.length }, (_, i) => {
      const at = 2 * (made.flatVertices[i >> 1]?.vertex ?? 0) + (i % 2);
      return (made.given.positions[at] as number) - (rest[at] as number);
    });
    this.#iterations = iterations;
    this.#report = this.owned.alloc(LAYOUT.hb_minimizer_report.sizeof);
  }

  /** Writes the deformed positions, n×2. Allocates nothing but the report. */
  deform(out: TypedArray): MinimizeEnergyReport {
    const { heap } = this;
    checkRoom(out, 'out', 2 * this.vertexCount);
    this.move(out, (skin, to) => {
      heap.check((e) => e.hb_minimizer_deform(skin, this.#iterations, to, this.#report));
      if (!this.#mesh.isGiven) this.#spread(heap.f32(to, 2 * this.vertexCount));
    });
    const { energy, iterations } = LAYOUT.hb_minimizer_report;
    const [taken = 0, flips = 0] = heap.u32(this.#report + iterations, 2);
    return { energy: heap.f64(this.#report + energy, 1)[0] ?? 0, iterations: taken, flips };
  }

  /** Brings positions of the places, which stand first, to all vertices. */
  #spread(moved: Float32Array): void {
    const { soundOf, first, flatVertices } = this.#mesh;
    // From the last on: no place has a higher number than its vertices, so none is overwritten before it is read.
    for (let v = this.vertexCount - 1; v >= 0; v--) {
      const from = 2 * Math.min(soundOf[v] as number, v);
      moved[2 * v] = moved[from] as number;
      moved[2 * v + 1] = moved[from + 1] as number;
    }
    for (let i = 0; i < this.#offsets.length; i++) {
      const flat = flatVertices[i >> 1];
      if (!flat) continue;
      let sum = this.#offsets[i] as number;
      for (let k = 0; k < 3; k++)
        sum += (flat.parts[k] as number) * (moved[2 * (first[flat.corners[k] as number] as number) + (i % 2)] as number);
      moved[2 * flat.vertex + (i % 2)] = sum;
    }
  }
}
