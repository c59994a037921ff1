/** A baked body, from its caller to the solver's memory. */
import { LAYOUT } from './abi.generated.ts';
import { indices, number, numbers, object, row } from './arguments.ts';
import { unshared } from './copied.ts';
import { HandlebodyError } from './errors.ts';
import { hashPositions } from './hash.ts';
import type { Heap, Scratch } from './heap.ts';
import { readMesh } from './mesh-arrays.ts';
import type { BodyData, TypedArray, Vec3 } from './types.ts';

/** A body as it may be written into the solver's memory. What the hash is of is what is taken: positions are copied where others could write. */
export function readBody(given: unknown): BodyData {
  const body = object(given, 'body', 'Give what bake() made, or a reader of baked files.') as unknown as BodyData;
  const { positions, triangles, ...mesh } = readMesh(body.mesh, 'body.mesh');
  const { center, diagonal } = object(body.normalization, 'body.normalization', BAKE_AGAIN) as unknown as BodyData['normalization'];
  const { origin, spacing, dimensions } = object(body.grid, 'body.grid', BAKE_AGAIN) as unknown as BodyData['grid'];
  const read: BodyData = {
    ...body,
    mesh: { ...mesh, positions: unshared(positions) as TypedArray, triangles: triangles as TypedArray },
    normalization: {
      center: row(center, 'body.normalization.center', 3, BODY) as unknown as Vec3,
      diagonal: bodyNumber(diagonal, 'body.normalization.diagonal'),
    },
    grid: {
      origin: row(origin, 'body.grid.origin', 3, BODY) as unknown as Vec3,
      spacing: bodyNumber(spacing, 'body.grid.spacing'),
      dimensions: indices(row(dimensions, 'body.grid.dimensions', 3, BODY), 'body.grid.dimensions', BODY) as unknown as Vec3,
    },
    voxels: indices(body.voxels, 'body.voxels', BODY) as Uint32Array,
    centers: indices(body.centers, 'body.centers', { kind: 'center', code: 'body-invalid' }) as Uint32Array,
    distances: indices(body.distances, 'body.distances', BODY, 2 ** 16) as Uint16Array,
    distanceScale: bodyNumber(body.distanceScale, 'body.distanceScale'),
    smoothLength: bodyNumber(body.smoothLength ?? 0, 'body.smoothLength'),
    spheres: numbers(body.spheres, 'body.spheres', BODY) as Float64Array,
    ...(body.sphereAxes && { sphereAxes: numbers(body.sphereAxes, 'body.sphereAxes', BODY) as Float64Array }),
  };
  checkBody(read);
  return read;
}

const bodyNumber = number('a finite number, as bake() does', Number.isFinite, 'body-invalid');
const BODY = { code: 'body-invalid' } as const;
const BAKE_AGAIN = 'Bake the model again.';

/** Contradictions that must be found before the arrays are copied: lengths, and a mesh changed since baking. */
function checkBody(body: BodyData): void {
  const expected = body.centers.length * body.voxels.length;
  if (body.distances.length !== expected || body.spheres.length % 4 !== 0) {
    throw new HandlebodyError('body-invalid', {
      message: `The baked body has ${body.distances.length} distances, but ${body.centers.length} centers × ${body.voxels.length} voxels need ${expected}.`,
      remedy: BAKE_AGAIN,
    });
  }
  if (body.sphereAxes && 4 * body.sphereAxes.length !== 3 * body.spheres.length) {
    throw new HandlebodyError('body-invalid', {
      message: `The baked body has ${body.sphereAxes.length} numbers for the axes of ${body.spheres.length / 4} spheres, which need three each.`,
      remedy: BAKE_AGAIN,
    });
  }
  if (hashPositions(body.mesh.positions) !== body.positionsHash) {
    throw new HandlebodyError('body-mismatch', {
      message: 'The interior distances were baked for other vertex positions than this mesh has.',
      remedy: 'Bake the model again after its last change: bake last.',
    });
  }
}

/** A body as the ABI's hb_body. */
export function writeBody(heap: Heap, scratch: Scratch, body: BodyData): number {
  const layout = LAYOUT.hb_body;
  const at = scratch.reserve(layout.sizeof);
  const arrays = {
    positions: scratch.putF64(body.mesh.positions),
    triangles: scratch.putU32(body.mesh.triangles),
    voxels: scratch.putU32(body.voxels),
    centers: scratch.putU32(body.centers),
    distances: scratch.putU16(body.distances),
    spheres: scratch.putF64(body.spheres),
    ...(body.sphereAxes && { sphere_axes: scratch.putF64(body.sphereAxes) }),
  };
  heap.f64(at + layout.center, 3).set(body.normalization.center);
  heap.f64(at + layout.diagonal, 1)[0] = body.normalization.diagonal;
  heap.f64(at + layout.origin, 3).set(body.grid.origin);
  heap.f64(at + layout.spacing, 1)[0] = body.grid.spacing;
  heap.f64(at + layout.distance_scale, 1)[0] = body.distanceScale;
  heap.f64(at + layout.smooth_length, 1)[0] = body.smoothLength ?? 0;
  heap.u32(at + layout.dims, 3).set(body.grid.dimensions);
  const words = {
    vertex_count: body.mesh.positions.length / 3,
    triangle_count: body.mesh.triangles.length / 3,
    voxel_count: body.voxels.length,
    center_count: body.centers.length,
    sphere_count: body.spheres.length / 4,
    ...arrays,
  };
  for (const [name, value] of Object.entries(words)) heap.u32(at + layout[name as keyof typeof words], 1)[0] = value;
  return at;
}
