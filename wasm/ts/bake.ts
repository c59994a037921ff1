import { type Exports, LAYOUT } from './abi.generated.ts';
import { options, row } from './arguments.ts';
import { BAKE_DEFAULTS, BAKE_READERS, METHODS, PACKINGS, QUALITIES } from './bake-options.ts';
import { prepareShape } from './bake-shape.ts';
import { tellWarnings } from './bake-warnings.ts';
import { throwIfAborted } from './errors.ts';
import { hashPositions } from './hash.ts';
import type { Heap } from './heap.ts';
import { runStepped } from './stepped.ts';
import type { BakeOptions, BakeShape, BodyData, DistanceMethod, Mesh, Skeleton } from './types.ts';

/** Computes interior distances (paper 001, §4.1), centers (§4.3) and spheres (§4.2). See `Handlebody.bake`. */
export async function bake(heap: Heap<Exports>, shape: BakeShape, given: BakeOptions): Promise<BodyData> {
  // Read once: from the first pause on, shape and options may be others.
  const read = options(given, BAKE_READERS, BAKE_DEFAULTS);
  const { centers, distance, resolution, quality, spheres, packing, level, density, signal, onProgress, onWarning } = read;
  const bones = typeof read.bones === 'string' ? [] : read.bones;
  throwIfAborted(signal);
  const numbers = {
    center_count: orZero(centers),
    resolution: orZero(resolution),
    quality: QUALITIES.indexOf(quality),
    method: METHODS.indexOf(distance),
    max_spheres: orZero(spheres),
    packing: PACKINGS.indexOf(packing),
    tree_level: orZero(level),
    straight_bones: read.bones === 'straight' ? 1 : 0,
    bone_count: bones.length,
  };
  const { mesh, cloud, volume, used } = prepareShape(heap, shape);
  const vertexCount = mesh.positions.length / 3;
  if (density) row(density, 'density', vertexCount);

  const handle = heap.scope((scratch) => {
    const layout = LAYOUT.hb_bake_options;
    const [at, out] = [scratch.reserve(layout.sizeof), scratch.reserve(4)];
    const put = (offset: number, value: number) => heap.u32(at + offset, 1).fill(value);
    const positions = scratch.putF64(mesh.positions);
    const triangles = scratch.putU32(mesh.triangles);
    for (const [name, value] of Object.entries(numbers)) put(layout[name as keyof typeof numbers], value);
    put(layout.cloud, cloud ? 1 : 0);
    if (density) put(layout.density, scratch.putF64(density));
    heap.f64(at + layout.overlap, 2).set([read.overlap, orZero(read.smallestRadius)]);
    if (bones.length > 0) {
      const from = mesh.origin ?? [0, 0, 0];
      put(layout.bones, scratch.putF64(bones.flatMap((bone) => Array.from(bone, (x, i) => x - (from[i % 3] as number)))));
    }
    if (used) put(layout.used, scratch.putU8(used));
    if (volume) {
      put(layout.voxel_count, volume.voxels.length);
      put(layout.voxels, scratch.putU32(volume.voxels));
      heap.u32(at + layout.dims, 3).set(volume.dimensions);
      heap.f64(at + layout.origin, 3).set(volume.origin.map((x, axis) => x - (mesh.origin?.[axis] ?? 0)));
      heap.f64(at + layout.spacing, 1).fill(volume.spacing);
    }
    heap.check((e) => e.hb_bake_begin(positions, vertexCount, triangles, mesh.triangles.length / 3, at, out));
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

const orZero = (number: number | 'auto') => (number === 'auto' ? 0 : number);

function readBody(heap: Heap<Exports>, bake: number, mesh: Mesh, distance: DistanceMethod): BodyData {
  const layout = LAYOUT.hb_body;
  return heap.scope((scratch) => {
    const body = scratch.reserve(layout.sizeof);
    heap.check((e) => e.hb_bake_body(bake, body));
    const double = (offset: number) => heap.f64(body + offset, 1)[0] ?? 0;
    const triple = (offset: number) => Array.from(heap.f64(body + offset, 3)) as [number, number, number];
    const word = (offset: number) => heap.u32(body + offset, 1)[0] ?? 0;
    const [voxels, centers, spheres] = [word(layout.voxel_count), word(layout.center_count), word(layout.sphere_count)];
    const skeleton = readSkeleton(heap, bake);
    return {
      version: 2,
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
      ...(word(layout.sphere_axes) !== 0 && { sphereAxes: heap.f64(word(layout.sphere_axes), spheres * 3).slice() }),
      smoothLength: double(layout.smooth_length),
      ...(skeleton && { skeleton }),
    };
  });
}

function readSkeleton(heap: Heap<Exports>, bake: number): Skeleton | undefined {
  const layout = LAYOUT.hb_skeleton;
  return heap.scope((scratch) => {
    const at = scratch.reserve(layout.sizeof);
    heap.check((e) => e.hb_bake_skeleton(bake, at));
    const word = (offset: number) => heap.u32(at + offset, 1)[0] ?? 0;
    const [nodes, branches, spheres] = [word(layout.node_count), word(layout.branch_count), word(layout.sphere_count)];
    if (nodes === 0) return undefined;
    const signed = (offset: number, count: number) => new Int32Array(heap.u32(word(offset), count).slice().buffer);
    return {
      nodes: heap.f64(word(layout.nodes), 4 * nodes).slice(),
      steps: heap.u32(word(layout.steps), word(layout.step_count)).slice(),
      lengths: heap.u32(word(layout.lengths), branches).slice(),
      parents: signed(layout.parents, branches),
      sphereBranches: signed(layout.sphere_branches, spheres),
    };
  });
}
