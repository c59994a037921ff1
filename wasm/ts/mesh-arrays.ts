import { indices, numbers, object, row } from './arguments.ts';
import { HandlebodyError } from './errors.ts';
import type { Mesh, TypedArray, Vec3 } from './types.ts';

const REMEDY = 'Give { positions, triangles }; of an object of three.js, meshFromObject(object) of "handlebody/three" makes them.';

/** A mesh as its caller has it, or another thing with positions: an object, at least. */
export function meshLike(given: unknown, name: string): Readonly<Record<string, unknown>> {
  const mesh = object(given, name, REMEDY);
  if (mesh.positions !== undefined || 'dimensions' in mesh) return mesh;
  throw new HandlebodyError('invalid-shape', { message: `The "${name}" has no positions.`, remedy: REMEDY });
}

/**
 * Positions of vertices, n × dimension. They may hold NaN where nothing uses the vertex: the solver names those that count.
 */
export function readPositions(mesh: Readonly<Record<string, unknown>>, dimension: number): ArrayLike<number> {
  const positions = numbers(mesh.positions, 'positions', {
    code: 'mesh-not-finite',
    kind: 'vertex',
    width: dimension,
    finite: false,
  });
  if (positions.length % dimension === 0) return positions;
  throw notRows('positions', positions.length, dimension, 'vertex');
}

/** Corners of triangles or tetrahedra: so many numbers of vertices each. Which of them there are the solver knows. */
export function readCorners(value: unknown, name: 'triangles' | 'tetrahedra'): ArrayLike<number> {
  const [kind, width] = name === 'triangles' ? (['triangle', 3] as const) : (['tetrahedron', 4] as const);
  const corners = indices(value, name, { code: 'mesh-index-out-of-range', kind, width });
  if (corners.length % width === 0) return corners;
  throw notRows(name, corners.length, width, kind);
}

/** A mesh of triangles in space. Its arrays may still be the caller's own. */
export function readMesh(given: unknown, name: string): Mesh {
  const mesh = meshLike(given, name);
  const positions = readPositions(mesh, 3) as TypedArray;
  const triangles = readCorners(mesh.triangles, 'triangles') as TypedArray;
  return { ...(mesh as unknown as Mesh), positions, triangles, ...readOrigin(mesh) };
}

/** What a mesh's positions are relative to, where it says so. */
export function readOrigin({ origin }: Readonly<Record<string, unknown>>): Pick<Mesh, 'origin'> {
  return origin === undefined ? {} : { origin: Array.from(row(origin, 'origin', 3)) as unknown as Vec3 };
}

function notRows(name: string, length: number, width: number, each: string): HandlebodyError {
  return new HandlebodyError('invalid-shape', {
    message: `The mesh's ${name} have ${length} numbers, which is not a multiple of ${width}.`,
    remedy: `Give ${width} numbers for every ${each}.`,
  });
}
