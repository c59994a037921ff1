import { type Exports, LAYOUT } from './abi.generated.ts';
import { checkRoom, type Numbers, numbers, options, type Readers, whole } from './arguments.ts';
import { HandlebodyError } from './errors.ts';
import type { Heap } from './heap.ts';
import { MESH_READERS, type MeshOptions } from './mesh-warnings.ts';
import type { SimplexMesh } from './simplex-mesh.ts';
import { MESH_DEFAULTS, SoundMesh } from './sound-mesh.ts';
import type { Mesh, TypedArray } from './types.ts';

export interface TetrahedralizeOptions extends MeshOptions {
  /** Voxels along the longest side of the surface's box, 4 to 256. Limbs closer than a voxel merge. */
  readonly resolution?: number;
}

export const TETRAHEDRALIZE_DEFAULTS = { resolution: 32, ...MESH_DEFAULTS } as const;

const READERS = { ...MESH_READERS, resolution: whole(4, 256) } satisfies Readers<TetrahedralizeOptions>;

/**
 * Tetrahedra that fill a surface, with the place of each of its vertices in them: a mesh for `biharmonicWeights` and the like.
 *
 * ```ts
 * const solid = hb.tetrahedralize(mesh);
 * const { weights } = hb.biharmonicWeights(solid, [{ vertex: 3 }, { vertex: 40 }]);
 * solid.sample(weights); // two numbers for each vertex of the surface
 * ```
 */
export class Tetrahedra implements SimplexMesh {
  readonly dimension = 3;
  /** n×3: the corners of voxels. */
  readonly positions: Float64Array;
  /** m×4, positively oriented. */
  readonly tetrahedra: Uint32Array;
  /** The 4 corners of the tetrahedron that each vertex of the surface is in. */
  readonly corners: Uint32Array;
  /** And its 4 barycentric coordinates there. */
  readonly coordinates: Float64Array;

  /** @internal */
  constructor(positions: Float64Array, tetrahedra: Uint32Array, corners: Uint32Array, coordinates: Float64Array) {
    this.positions = positions;
    this.tetrahedra = tetrahedra;
    this.corners = corners;
    this.coordinates = coordinates;
  }

  /** Interpolates values at the tetrahedra's vertices (n×k) to the surface's vertices (k numbers each), linearly in each tetrahedron. */
  sample<T extends TypedArray = Float64Array>(values: Numbers, out?: T): T {
    const given = numbers(values, 'values', { finite: false });
    const count = this.positions.length / 3;
    const width = given.length / count;
    if (!Number.isInteger(width) || width === 0) {
      throw new HandlebodyError('invalid-shape', {
        message: `${given.length} values are not as many for each of ${count} vertices.`,
        remedy: "Give the tetrahedra's values, row-major.",
      });
    }
    const rows = this.corners.length / 4;
    if (out !== undefined) checkRoom(out, 'out', rows * width);
    const result: TypedArray = out ?? new Float64Array(rows * width);
    result.fill(0);
    for (let k = 0; k < this.corners.length; k++) {
      const from = (this.corners[k] as number) * width;
      const to = (k >> 2) * width;
      const part = this.coordinates[k] as number;
      for (let j = 0; j < width; j++) result[to + j] = (result[to + j] as number) + part * (given[from + j] as number);
    }
    return result as T;
  }
}

/**
 * Fills a surface with tetrahedra: the voxels that it touches or encloses, six each (Kuhn's division). Weights of a solid depend on its
 * inside, and not on seams, thin parts or how finely the surface is meshed. Triangles without area are left out with a
 * warning, and doubled ones count once. Vertices that no other triangle uses set no size; each is where the solid is nearest.
 *
 * ```ts
 * const solid = hb.tetrahedralize(dog, { resolution: 40 });
 * const weights = hb.biharmonicWeights(solid, [{ at: paw }, { at: head }]).weights;
 * const atVertices = solid.sample(weights);   // rows of the dog's own vertices
 * ```
 */
export function tetrahedralize(heap: Heap<Exports>, surface: Mesh, given: TetrahedralizeOptions = {}): Tetrahedra {
  const read = options(given, READERS, TETRAHEDRALIZE_DEFAULTS);
  const { resolution } = read;
  const mesh = new SoundMesh(heap, surface, read, 'surface');
  if (mesh.sound.corners !== 3 || mesh.sound.dimension !== 3) {
    throw new HandlebodyError('invalid-shape', {
      message: `Simplices of ${mesh.sound.corners} corners in ${mesh.sound.dimension} dimensions are no surface to fill.`,
      remedy: 'Give triangles in space.',
    });
  }
  const { sound, first, doubled, vertexCount } = mesh;
  const positions = insideBox(sound.simplices, first, mesh.given.positions);
  // Which of two faces in one place faces outward, the voxels decide.
  const simplices = Array.from(sound.simplices)
    .concat(doubled)
    .map((vertex) => first[vertex] as number);
  const simplexCount = simplices.length / 3;
  return heap.scope((scratch) => {
    const from = scratch.putF64(positions);
    const indices = scratch.putU32(simplices);
    const out = scratch.reserve(LAYOUT.hb_tetrahedra_view.sizeof);
    heap.check((e) => e.hb_tetrahedra_create(from, vertexCount, indices, simplexCount, resolution, out));
    const made = heap.u32(out, 1)[0] ?? 0;
    try {
      heap.call((e) => e.hb_tetrahedra_arrays(made, out));
      const [n = 0, m = 0, at = 0, tetrahedra = 0, corners = 0, coordinates = 0] = heap.u32(out, 6);
      return new Tetrahedra(
        heap.f64(at, 3 * n).slice(),
        heap.u32(tetrahedra, 4 * m).slice(),
        heap.u32(corners, 4 * vertexCount).slice(),
        heap.f64(coordinates, 4 * vertexCount).slice(),
      );
    } finally {
      heap.release((e) => e.hb_tetrahedra_free(made));
    }
  });
}

/** Positions, of which those outside the box of the triangles' corners are moved to its border. */
function insideBox(corners: ArrayLike<number>, first: Uint32Array, positions: ArrayLike<number>): Float64Array {
  const low = [0, 1, 2].map(() => Number.POSITIVE_INFINITY);
  const high = [0, 1, 2].map(() => Number.NEGATIVE_INFINITY);
  for (let i = 0; i < corners.length; i++) {
    for (let axis = 0; axis < 3; axis++) {
      const x = positions[3 * (first[corners[i] as number] as number) + axis] as number;
      low[axis] = Math.min(low[axis] as number, x);
      high[axis] = Math.max(high[axis] as number, x);
    }
  }
  return Float64Array.from(positions, (x, i) => {
    const [least, most] = [low[i % 3] as number, high[i % 3] as number];
    return x > least ? Math.min(x, most) : least;
  });
}
