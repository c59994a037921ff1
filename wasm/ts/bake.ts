import { LAYOUT } from './abi.generated.ts';
import { HandlebodyError, throwIfAborted } from './errors.ts';
import { hashPositions } from './hash.ts';
import type { Heap } from './heap.ts';
import { runStepped } from './stepped.ts';
import type { BakeOptions, BodyData, DistanceMethod, Mesh } from './types.ts';

export const BAKE_DEFAULTS = { centers: 200, distance: 'fast-marching', resolution: 96, spheres: 120 } as const;

const METHODS: Record<DistanceMethod, number> = { 'fast-marching': 0, euclidean: 1 };

/** Computes interior distances (paper 001, §4.1), centers (§4.3) and spheres (§4.2). See `Handlebody.bake`. */
export async function bake(heap: Heap, mesh: Mesh, options: BakeOptions): Promise<BodyData> {
  const { centers, distance, resolution, spheres } = { ...BAKE_DEFAULTS, ...options };
  throwIfAborted(options.signal);
  checkMeshArrays(mesh);
  const method = METHODS[distance];
  for (const [name, value] of Object.entries({ centers, resolution, spheres })) {
    if (!Number.isInteger(value) || value < 1 || value > 0xffff_ffff) {
      throw new HandlebodyError('invalid-option', {
        message: `The bake's "${name}" is ${value}.`,
        remedy: `Give a positive whole number, for instance ${BAKE_DEFAULTS[name as 'centers']}.`,
      });
    }
  }
  if (method === undefined) {
    throw new HandlebodyError('invalid-option', {
      message: `There is no distance method called "${distance}".`,
      remedy: `Use one of: ${Object.keys(METHODS).join(', ')}.`,
    });
  }

  const handle = heap.scope((scratch) => {
    const out = scratch.reserve(4);
    const positions = scratch.putF64(mesh.positions);
    const triangles = scratch.putU32(mesh.triangles);
    const [n, m] = [mesh.positions.length / 3, mesh.triangles.length / 3];
    heap.check((e) => e.hb_bake_begin(positions, n, triangles, m, centers, resolution, method, spheres, out));
    return heap.u32(out, 1)[0] ?? 0;
  });
  try {
    await runStepped(heap, (progress) => heap.check((e) => e.hb_bake_step(handle, progress)), options);
    return { ...readBody(heap, handle, mesh), distance };
  } finally {
    heap.call((e) => e.hb_bake_free(handle));
  }
}

/** Lengths that the solver cannot see for itself; the values are checked there. */
export function checkMeshArrays(mesh: Mesh): void {
  for (const [name, length] of [
    ['positions', mesh.positions.length],
    ['triangles', mesh.triangles.length],
  ] as const) {
    if (length % 3 === 0) continue;
    throw new HandlebodyError('invalid-shape', {
      message: `The mesh's ${name} have ${length} numbers, which is not a multiple of 3.`,
      remedy: name === 'positions' ? 'Give x, y and z for every vertex.' : 'Give three vertex indices for every triangle.',
    });
  }
}

function readBody(heap: Heap, bake: number, mesh: Mesh): Omit<BodyData, 'distance'> {
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
