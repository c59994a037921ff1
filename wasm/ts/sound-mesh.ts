import { type Exports, LAYOUT } from './abi.generated.ts';
import type { Read } from './arguments.ts';
import type { Heap } from './heap.ts';
import { type MESH_READERS, meshWarnings } from './mesh-warnings.ts';
import { type CheckedMesh, checkSimplexMesh, putMesh, type SimplexMesh } from './simplex-mesh.ts';

/** How meshes are read where nothing else is said. */
export const MESH_DEFAULTS = { weld: true, strict: false } as const;

/** A vertex that only flat triangles or tetrahedra use: Σ parts[k] · corners[k] of the sound mesh is the nearest point of the others. */
interface FlatVertex {
  readonly vertex: number;
  readonly corners: readonly number[];
  readonly parts: readonly number[];
}

/**
 * A mesh as the solver wants it, made from one as it comes: a vertex for each place, without flat and doubled triangles. All but `given` are
 * copies, so that the caller's arrays may change.
 */
export class SoundMesh {
  /** The mesh as it came: its arrays may be the caller's, and may change once this is made. */
  readonly given: CheckedMesh;
  /** What the solver computes on. */
  readonly sound: CheckedMesh;
  /** Of the mesh as it came. */
  readonly vertexCount: number;
  /** For each vertex of the mesh as it came the first one at its place. */
  readonly vertexOf: Uint32Array;
  /** For each vertex of `sound` the first one there of the mesh as it came. */
  readonly first: Uint32Array;
  /** For each vertex of the mesh as it came its vertex of `sound`. */
  readonly soundOf: Uint32Array;
  readonly flatVertices: readonly FlatVertex[];
  /** Corners, in `sound`, of the simplices that were left out because others have the same. */
  readonly doubled: readonly number[];

  constructor(heap: Heap<Exports>, mesh: SimplexMesh, { weld, strict, onWarning }: Read<typeof MESH_READERS>, name = 'mesh') {
    const given = checkSimplexMesh(mesh, name);
    this.given = given;
    const made = heap.scope((scratch) => {
      const shape = putMesh(heap, scratch, given);
      const out = scratch.reserve(LAYOUT.hb_sound_mesh_view.sizeof);
      heap.check((e) => e.hb_sound_mesh_create(shape, weld ? 1 : 0, strict ? 1 : 0, out));
      const object = heap.u32(out, 1)[0] ?? 0;
      try {
        heap.call((e) => e.hb_sound_mesh_get(object, out));
        return readView(heap, out, given);
      } finally {
        heap.release((e) => e.hb_sound_mesh_free(object));
      }
    });
    this.vertexCount = given.vertexCount;
    this.sound = made.sound;
    this.vertexOf = made.vertexOf;
    this.first = made.first;
    this.soundOf = made.soundOf;
    this.flatVertices = made.flatVertices;
    this.doubled = Array.from(made.doubled).flatMap((s) =>
      Array.from({ length: given.corners }, (_, k) => made.soundOf[given.simplices[s * given.corners + k] as number] as number),
    );
    const doubled = { count: made.doubled.length, first: made.doubled[0] ?? 0 };
    if (onWarning) for (const warning of meshWarnings(given.corners, made.flat, doubled, made.unused)) onWarning(warning);
  }

  /** Whether the vertices of `sound` are those of the mesh as it came. */
  get isGiven(): boolean {
    return this.first.length === this.vertexCount;
  }

  /** Rows of `width` numbers for the vertices of the mesh as it came, from those of `sound`. */
  rows(values: Float64Array, width: number): Float64Array {
    if (this.isGiven) return values;
    const rows = new Float64Array(this.vertexCount * width);
    for (let v = 0; v < this.vertexCount; v++) {
      const from = (this.soundOf[v] as number) * width;
      rows.set(values.subarray(from, from + width), v * width);
    }
    for (const { vertex, corners, parts } of this.flatVertices)
      for (let j = 0; j < width; j++)
        rows[vertex * width + j] = corners.reduce(
          (sum, corner, k) => sum + (parts[k] as number) * (values[corner * width + j] as number),
          0,
        );
    return rows;
  }
}

function readView(heap: Heap<Exports>, at: number, { dimension, corners, vertexCount }: CheckedMesh) {
  const layout = LAYOUT.hb_sound_mesh_view;
  const words = heap.u32(at, layout.sizeof / 4);
  const word = (offset: number) => words[offset / 4] as number;
  const count = word(layout.vertex_count);
  const simplexCount = word(layout.simplex_count);
  const sound: CheckedMesh = {
    positions: heap.f64(word(layout.positions), count * dimension).slice(),
    dimension,
    vertexCount: count,
    simplices: heap.u32(word(layout.simplices), simplexCount * corners).slice(),
    corners,
    simplexCount,
  };
  return {
    sound,
    first: heap.u32(word(layout.first), count).slice(),
    soundOf: heap.u32(word(layout.vertex_of), vertexCount).slice(),
    vertexOf: heap.u32(word(layout.place_of), vertexCount).slice(),
    flatVertices: readFlatVertices(heap, word(layout.flat_vertices), word(layout.flat_vertex_count)),
    flat: { count: word(layout.flat_count), first: word(layout.flat_first) },
    doubled: heap.u32(word(layout.doubled), word(layout.doubled_count)).slice(),
    unused: { count: word(layout.unused_count), first: word(layout.unused_first) },
  };
}

function readFlatVertices(heap: Heap<Exports>, at: number, count: number): FlatVertex[] {
  const { sizeof, corners, parts } = LAYOUT.hb_flat_vertex;
  return Array.from({ length: count }, (_, k) => {
    const from = at + k * sizeof;
    return {
      vertex: heap.u32(from, 1)[0] as number,
      corners: [...heap.u32(from + corners, 3)],
      parts: [...heap.f64(from + parts, 3)],
    };
  });
}
