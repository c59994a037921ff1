import { LAYOUT } from './abi.generated.ts';
import { indices, list, optional, options, refused, row, type Vector } from './arguments.ts';
import { HandlebodyError } from './errors.ts';
import type { Heap, Scratch } from './heap.ts';
import type { CheckedMesh } from './simplex-mesh.ts';
import type { SoundMesh } from './sound-mesh.ts';

/**
 * What holds a part of a mesh: a vertex or several, the vertex nearest to a place, or the vertices along a bone, which is a segment between two
 * places. Places must be inside the mesh (on a surface in space they may be anywhere). A vertex that the mesh splits is held by any of its
 * copies.
 */
export type WeightHandle =
  | { readonly vertex: number }
  | { readonly vertices: ArrayLike<number> }
  | { readonly at: ArrayLike<number> | Vector }
  | { readonly bone: readonly [ArrayLike<number> | Vector, ArrayLike<number> | Vector] };

/** The vertices of every handle: of the sound mesh, and of the mesh as it came. @internal */
interface ResolvedHandles {
  readonly held: readonly (readonly number[])[];
  readonly vertices: readonly (readonly number[])[];
}

/**
 * @internal The vertices of every handle. A bone leaves out those that an earlier handle holds, as where two bones meet; that two others hold
 * one vertex is refused unless it may be `shared`.
 */
export function resolveHandles(mesh: SoundMesh, given: readonly WeightHandle[], shared: boolean): ResolvedHandles {
  const handles = readHandles(given, mesh.sound.dimension);
  const { sound, soundOf, first } = mesh;
  const inUse = new Uint8Array(sound.vertexCount);
  for (let i = 0; i < sound.simplices.length; i++) inUse[sound.simplices[i] as number] = 1;
  const taken = new Map<number, { readonly index: number; readonly vertex: number }>();
  const vertices = handles.map((handle, index) => {
    const { vertices, at, bone } = handle;
    const found = at
      ? [nearestVertex(sound, inUse, checkPlace(sound, at, index))]
      : bone && boneVertices(sound, inUse, bone, index, taken);
    const held = found ? found.map((vertex) => first[vertex] as number) : (vertices as number[]);
    for (const vertex of held) {
      if (!(Number.isInteger(vertex) && vertex >= 0 && vertex < mesh.vertexCount)) {
        throw new HandlebodyError('handle-out-of-range', {
          message: `Handle ${index} holds vertex ${vertex}; the mesh has ${mesh.vertexCount}, counted from 0.`,
          remedy: 'Give the number of a vertex.',
          culprit: { kind: 'handle', index },
        });
      }
      const place = soundOf[vertex] as number;
      const before = taken.get(place);
      if (before && before.index !== index && !shared) throw conflict(before, { index, vertex });
      if (!before) taken.set(place, { index, vertex });
    }
    return held;
  });
  return { vertices, held: vertices.map((list) => [...new Set(list.map((vertex) => soundOf[vertex] as number))]) };
}

/** What handles hold, one of the four each, before it is known whether the mesh has it. */
function readHandles(given: unknown, dimension: number) {
  return list(given, 'handles', 'handles, such as { vertex: 0 }', (handle, name, index) => {
    const culprit = { kind: 'handle', index } as const;
    const place = (value: unknown, key: string) =>
      row(value, `${name}.${key}`, dimension, { ...culprit, code: 'handle-not-finite' });
    const vertices = (value: unknown, key: string) =>
      Array.from(indices(value, `${name}.${key}`, { ...culprit, code: 'handle-out-of-range' }));
    const readers = {
      vertex: optional((value, key) => vertices([value], key)),
      vertices: optional(vertices),
      at: optional(place),
      bone: optional((value, key) => {
        const ends = list(value, `${name}.${key}`, 'two places', (end, at) => place(end, at.slice(name.length + 1)));
        if (ends.length === 2) return ends as [ArrayLike<number>, ArrayLike<number>];
        throw refused(`${name}.${key}`, value, 'Give the two ends of a segment.', { ...culprit, code: 'invalid-shape' });
      }),
    };
    const read = options(handle, readers, {}, name);
    const { vertex, at, bone } = read;
    const kinds = Object.values(read).filter((value) => value !== undefined).length;
    if (kinds === 1) return { vertices: vertex ?? read.vertices, at, bone };
    throw new HandlebodyError('invalid-option', {
      message: `The "${name}" says ${kinds === 0 ? 'nothing of' : `in ${kinds} ways`} what it holds.`,
      remedy: 'Give each handle one of { vertex }, { vertices }, { at } and { bone: [from, to] }.',
      culprit,
    });
  });
}

function conflict(
  before: { readonly index: number; readonly vertex: number },
  { index, vertex }: { readonly index: number; readonly vertex: number },
): HandlebodyError {
  return new HandlebodyError('handle-conflict', {
    message:
      before.vertex === vertex
        ? `Handles ${before.index} and ${index} both hold vertex ${vertex}.`
        : `Handles ${before.index} and ${index} hold vertices ${before.vertex} and ${vertex}, which are one on the shape.`,
    remedy: 'Move one of them to another vertex, or refine the mesh there.',
    culprit: { kind: 'handle', index },
  });
}

/** @internal Puts the vertices of every handle into scratch memory, as the solver takes them, and returns their address. */
export function putHeld(heap: Heap, scratch: Scratch, held: readonly (readonly number[])[]): number {
  const layout = LAYOUT.hb_held_vertices;
  const vertices = scratch.putU32(held.flat());
  const owners = scratch.putU32(held.flatMap((list, owner) => list.map(() => owner)));
  const at = scratch.reserve(layout.sizeof);
  const words = heap.u32(at, layout.sizeof / 4);
  words[layout.vertices / 4] = vertices;
  words[layout.owners / 4] = owners;
  words[layout.count / 4] = held.reduce((sum, list) => sum + list.length, 0);
  words[layout.handle_count / 4] = held.length;
  return at;
}

function boneVertices(
  mesh: CheckedMesh,
  inUse: Uint8Array,
  [from, to]: readonly [ArrayLike<number>, ArrayLike<number>],
  index: number,
  taken: ReadonlyMap<number, unknown>,
): number[] {
  checkPlace(mesh, from, index);
  checkPlace(mesh, to, index);
  const length = Math.hypot(...Array.from(from, (x, axis) => (to[axis] as number) - x));
  // Half an edge between samples, so that none of the vertices along it is missed.
  const steps = Math.min(Math.ceil((2 * length) / meanEdge(mesh)), 1000);
  const found = new Set<number>();
  for (let step = 0; step <= steps; step++) {
    const t = steps === 0 ? 0 : step / steps;
    found.add(
      nearestVertex(
        mesh,
        inUse,
        Array.from(from, (x, axis) => x + ((to[axis] as number) - x) * t),
      ),
    );
  }
  const free = [...found].filter((vertex) => !taken.has(vertex));
  return free.length > 0 ? free : [...found];
}

function checkPlace(mesh: CheckedMesh, at: ArrayLike<number>, index: number): ArrayLike<number> {
  if (mesh.corners === mesh.dimension + 1 && !isInside(mesh, at)) {
    throw new HandlebodyError('handle-outside', {
      message: `Handle ${index} at (${Array.from(at, (x) => Number(x.toPrecision(4))).join(', ')}) is outside the shape.`,
      remedy: 'Place it inside, or name a vertex.',
      culprit: { kind: 'handle', index },
    });
  }
  return at;
}

/** Whether a place is in one of the simplices, or on its border to rounding. */
function isInside({ positions, dimension, simplices, corners, simplexCount }: CheckedMesh, at: ArrayLike<number>): boolean {
  const offsets = new Float64Array(corners * dimension);
  for (let s = 0; s < simplexCount; s++) {
    let outside = false;
    for (let axis = 0; axis < dimension; axis++) {
      let low = Number.POSITIVE_INFINITY;
      let high = Number.NEGATIVE_INFINITY;
      for (let k = 0; k < corners; k++) {
        const offset = (positions[(simplices[s * corners + k] as number) * dimension + axis] as number) - (at[axis] as number);
        offsets[k * dimension + axis] = offset;
        low = Math.min(low, offset);
        high = Math.max(high, offset);
      }
      const slack = 1e-9 * (high - low);
      outside ||= low > slack || high < -slack;
    }
    if (!outside && isAroundOrigin(offsets, dimension)) return true;
  }
  return false;
}

/** Whether the simplex of these corners holds the origin: no barycentric coordinate is negative. */
function isAroundOrigin(p: Float64Array, dimension: 2 | 3): boolean {
  const n = (k: number) => p[k] as number;
  const cross = (a: number, b: number) => n(2 * a) * n(2 * b + 1) - n(2 * a + 1) * n(2 * b);
  const triple = (a: number, b: number, c: number) =>
    n(3 * a) * (n(3 * b + 1) * n(3 * c + 2) - n(3 * b + 2) * n(3 * c + 1)) -
    n(3 * a + 1) * (n(3 * b) * n(3 * c + 2) - n(3 * b + 2) * n(3 * c)) +
    n(3 * a + 2) * (n(3 * b) * n(3 * c + 1) - n(3 * b + 1) * n(3 * c));
  const parts =
    dimension === 2
      ? [cross(1, 2), cross(2, 0), cross(0, 1)]
      : [triple(1, 2, 3), -triple(0, 2, 3), triple(0, 1, 3), -triple(0, 1, 2)];
  const whole = parts.reduce((sum, part) => sum + part, 0);
  return parts.every((part) => part / whole >= -1e-9);
}

/** The nearest of the vertices that are in use. */
function nearestVertex({ positions, dimension, vertexCount }: CheckedMesh, inUse: Uint8Array, at: ArrayLike<number>): number {
  let nearest = 0;
  let least = Number.POSITIVE_INFINITY;
  for (let v = 0; v < vertexCount; v++) {
    let squared = 0;
    for (let axis = 0; axis < dimension; axis++)
      squared += ((positions[v * dimension + axis] as number) - (at[axis] as number)) ** 2;
    if (!inUse[v] || squared >= least) continue;
    least = squared;
    nearest = v;
  }
  return nearest;
}

function meanEdge({ positions, dimension, simplices, corners, simplexCount }: CheckedMesh): number {
  let sum = 0;
  for (let s = 0; s < simplexCount; s++) {
    for (let k = 0; k < corners; k++) {
      const a = simplices[s * corners + k] as number;
      const b = simplices[s * corners + ((k + 1) % corners)] as number;
      let squared = 0;
      for (let axis = 0; axis < dimension; axis++)
        squared += ((positions[a * dimension + axis] as number) - (positions[b * dimension + axis] as number)) ** 2;
      sum += Math.sqrt(squared);
    }
  }
  return sum / (simplexCount * corners) || Number.POSITIVE_INFINITY;
}
