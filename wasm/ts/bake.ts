import { type Exports, LAYOUT } from './abi.generated.ts';
import { prepareShape } from './bake-shape.ts';
import { tellWarnings } from './bake-warnings.ts';
import { HandlebodyError, throwIfAborted } from './errors.ts';
import { hashPositions } from './hash.ts';
import type { Heap } from './heap.ts';
import { runStepped } from './stepped.ts';
import type { BakeOptions, BakeShape, BodyData, DistanceMethod, Mesh } from './types.ts';

export const BAKE_DEFAULTS = {
  centers: 200,
  distance: 'fast-marching',
  resolution: 96,
  spheres: 120,
  packing: 'skeleton',
} as const;

const METHODS: Record<DistanceMethod, number> = { 'fast-marching': 0, euclidean: 1, heat: 2, 'mean-value': 3 };
const PACKINGS = { skeleton: 0, tree: 1 } as const;

/** Computes interior distances (paper 001, §4.1), centers (§4.3) and spheres (§4.2). See `Handlebody.bake`. */
export async function bake(heap: Heap<Exports>, shape: BakeShape, options: BakeOptions): Promise<BodyData> {
  // Read once: from the first pause on, shape and options may be others.
  const { centers, distance, resolution, spheres, packing, density, signal, onProgress, onWarning } = {
    ...BAKE_DEFAULTS,
    ...options,
  };
  throwIfAborted(signal);
  for (const [name, value] of Object.entries({ centers, resolution, spheres })) {
    if (!Number.isInteger(value) || value < 1 || value > 0xffff_ffff) {
      throw new HandlebodyError('invalid-option', {
        message: `The bake's "${name}" is ${value}.`,
        remedy: `Give a positive whole number, for instance ${BAKE_DEFAULTS[name as 'centers']}.`,
      });
    }
  }
  const numbers = {
    center_count: centers,
    resolution,
    method: chosen('distance method', METHODS, distance),
    max_spheres: spheres,
    packing: chosen('packing', PACKINGS, packing),
  };
  const { mesh, cloud, voxels, used } = prepareShape(heap, shape);
  const vertexCount = mesh.positions.length / 3;
  if (density && density.length !== vertexCount) {
    throw new HandlebodyError('invalid-shape', {
      message: `There are ${density.length} densities for ${vertexCount} vertices.`,
      remedy: 'Give one number a vertex, 1 where nothing special is wanted.',
    });
  }

  const handle = heap.scope((scratch) => {
    const layout = LAYOUT.hb_bake_options;
    const [given, out] = [scratch.reserve(layout.sizeof), scratch.reserve(4)];
    const put = (offset: number, value: number) => heap.u32(given + offset, 1).fill(value);
    const positions = scratch.putF64(mesh.positions);
    const triangles = scratch.putU32(mesh.triangles);
    for (const [name, value] of Object.entries(numbers)) put(layout[name as keyof typeof numbers], value);
    put(layout.cloud, cloud ? 1 : 0);
    if (density) put(layout.density, scratch.putF64(density));
    if (used) put(layout.used, scratch.putU8(used));
    if (voxels && 'dimensions' in shape) {
      put(layout.voxel_count, voxels.length);
      put(layout.voxels, scratch.putU32(voxels));
      heap.u32(given + layout.dims, 3).set(shape.dimensions);
      heap.f64(given + layout.origin, 3).set(shape.origin.map((x, axis) => x - (mesh.origin?.[axis] ?? 0)));
      heap.f64(given + layout.spacing, 1).fill(shape.spacing);
    }
    heap.check((e) => e.hb_bake_begin(positions, vertexCount, triangles, mesh.triangles.length / 3, given, out));
    return heap.u32(out, 1)[0] ?? 0;
  });
  try {
    let told = 0;
    const tell = (part: number) => {
      if (onWarning) told = tellWarnings(heap, handle, { from: told, origin: mesh.origin, tell: onWarning });
      onProgress?.(part);
    };
    const how = { ...(signal && { signal }), onProgress: tell };
    await runStepped(heap, (progress) => heap.check((e) => e.hb_bake_step(handle, progress)), how);
    return readBody(heap, handle, mesh, distance);
  } finally {
    heap.release((e) => e.hb_bake_free(handle));
  }
}

function chosen<Name extends string>(what: string, numbers: Record<Name, number>, name: Name): number {
  if (Object.hasOwn(numbers, name)) return numbers[name];
  throw new HandlebodyError('invalid-option', {
    message: `There is no ${what} called "${name}".`,
    remedy: `Use one of: ${Object.keys(numbers).join(', ')}.`,
  });
}

function readBody(heap: Heap<Exports>, bake: number, mesh: Mesh, distance: DistanceMethod): BodyData {
  const layout = LAYOUT.hb_body;
  return heap.scope((scratch) => {
    const body = scratch.reserve(layout.sizeof);
    heap.check((e) => e.hb_bake_body(bake, body));
    const double = (offset: number) => heap.f64(body + offset, 1)[0] ?? 0;
    const triple = (offset: number) => Array.from(heap.f64(body + offset, 3)) as [number, number, number];
    const word = (offset: number) => heap.u32(body + offset, 1)[0] ?? 0;
    const [voxels, centers, spheres] = [word(layout.voxel_count), word(layout.center_count), word(layout.sphere_count)];
    return {
      version: 1,
      mesh,
      distance,
      positionsHash: hashPositions(mesh.positions),
      normalization: { center: triple(layout.center), diagonal: double(layout.diagonal) },
      grid: {
        origin: triple(layout.origin),
        spacing: double(layout.spacing),
        dimensions: Array.from(heap.u32(body + layout.dims, 3)) as [number, number, number],
      },
      voxels: heap.u32(word(layout.voxels), voxels).slice(),
      centers: heap.u32(word(layout.centers), centers).slice(),
      distances: heap.u16(word(layout.distances), centers * voxels).slice(),
      distanceScale: double(layout.distance_scale),
      spheres: heap.f64(word(layout.spheres), spheres * 4).slice(),
    };
  });
}
