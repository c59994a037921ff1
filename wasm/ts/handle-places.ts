/** Handles' places: read, and what they leave to be said: the nearest place inside, and turns that no handle holds. */
import { list, named, optional, options, row, told } from './arguments.ts';
import { boxOf } from './box.ts';
import { HandlebodyError } from './errors.ts';
import type { BodyData, IrbfWarning, Vec3 } from './types.ts';

const AXES = [0, 1, 2] as const;
/** Handles closer to a line than this part of its length are on it. */
const ON_LINE = 1e-6;

/** To the error of a handle that lies outside: where the model is, and the nearest place inside. `places` are relative to the body's origin. */
export function withNearest(error: unknown, body: BodyData, places: Float64Array): unknown {
  if (!(error instanceof HandlebodyError) || error.code !== 'handle-outside' || !error.culprit) return error;
  const { index } = error.culprit;
  const { mesh, normalization, grid, voxels } = body;
  const { center, diagonal } = normalization;
  const step = 10 ** (Math.floor(Math.log10(grid.spacing * diagonal)) - 1);
  const words = (x: readonly number[]) =>
    `(${x.map((number, axis) => Number((Math.round((number + (mesh.origin?.[axis] ?? 0)) / step) * step).toPrecision(12))).join(', ')})`;
  const at = AXES.map((axis) => places[3 * index + axis] as number);
  const place = (voxel: number): Vec3 => {
    const [nx, ny] = grid.dimensions;
    const steps: Vec3 = [voxel % nx, Math.floor(voxel / nx) % ny, Math.floor(voxel / (nx * ny))];
    const of = (axis: 0 | 1 | 2) => center[axis] + diagonal * (grid.origin[axis] + grid.spacing * steps[axis]);
    return [of(0), of(1), of(2)];
  };
  const [x = 0, y = 0, z = 0] = at;
  const far = ([a, b, c]: Vec3) => Math.hypot(a - x, b - y, c - z);
  const inside = Array.from(voxels, place);
  const nearest = inside.reduce((best, one) => (far(one) < far(best) ? one : best), inside[0] ?? [x, y, z]);
  const { low, high } = boxOf(mesh.positions, mesh.triangles);
  return new HandlebodyError(error.code, {
    message: `Handle ${index} at ${words(at)} lies outside the model, which spans ${words(low)} to ${words(high)}.`,
    remedy: `Put it at ${words(nearest)}, the nearest point inside, or on a vertex.`,
    culprit: error.culprit,
    cause: error,
  });
}

/** What three or more handles leave free that neither turn nor stand off one line. */
export function twistWarning(places: Float64Array, kinds: Uint32Array): IrbfWarning | undefined {
  if (kinds.length < 3 || kinds.some((kind) => kind !== 0)) return undefined;
  const offset = (k: number) => AXES.map((axis) => (places[3 * k + axis] as number) - (places[axis] as number));
  const offsets = Array.from(kinds, (_, k) => offset(k));
  const length = ([a = 0, b = 0, c = 0]: number[]) => Math.hypot(a, b, c);
  const [x = 0, y = 0, z = 0] = offsets.sort((a, b) => length(b) - length(a))[0] ?? [];
  const squared = x * x + y * y + z * z;
  const off = ([a = 0, b = 0, c = 0]: number[]) => length([y * c - z * b, z * a - x * c, x * b - y * a]);
  if (offsets.some((one) => off(one) > ON_LINE * squared)) return undefined;
  return {
    code: 'twist-free',
    message: `The ${kinds.length} handles stand on one line, so nothing holds the model from turning about it.`,
    remedy: "Add a handle off the line, or give one the kind 'rotation'.",
  };
}

/** Between the model's units and those of a body that has an origin of its own: the first three numbers of each row. */
export function shiftRows(
  rows: Float64Array,
  origin: Vec3,
  { stride, sign }: { readonly stride: number; readonly sign: 1 | -1 },
): void {
  for (let row = 0; row < rows.length; row += stride)
    for (let axis = 0; axis < 3; axis++) rows[row + axis] = (rows[row + axis] as number) + sign * (origin[axis] as number);
}

/** Where handles sit, checked: a vertex or a place. */
export function readHandles(given: unknown, vertexCount: number) {
  return list(given, 'handles', 'handles, such as { vertex: 0 } or { at: [x, y, z] }', (handle, name, index) => {
    const culprit = { kind: 'handle', index } as const;
    const readers = {
      vertex: optional((vertex: unknown) => {
        if (Number.isInteger(vertex) && (vertex as number) >= 0 && (vertex as number) < vertexCount) return vertex as number;
        throw new HandlebodyError('handle-out-of-range', {
          message: `Handle ${index} sits on vertex ${told(vertex)}, but the mesh has ${vertexCount} vertices.`,
          remedy: `Use a vertex number from 0 to ${vertexCount - 1}.`,
          culprit,
        });
      }),
      at: optional((at, key) => row(at, `${name}.${key}`, 3, { ...culprit, code: 'handle-not-finite' })),
      kind: named(['position', 'rotation']),
    };
    const read = options(handle, readers, { kind: 'position' }, name);
    if ((read.vertex === undefined) !== (read.at === undefined)) return read;
    throw new HandlebodyError('invalid-option', {
      message: `The "${name}" has ${read.at ? 'a vertex and a place' : 'neither a vertex nor a place'}.`,
      remedy: 'Give each handle one of { vertex } and { at: [x, y, z] }.',
      culprit,
    });
  });
}
