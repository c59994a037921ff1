import { hashPositions } from '../../../wasm/ts/hash.ts';
import type { BodyData, Mesh } from '../../../wasm/ts/types.ts';

/** A body for a mesh of 16 vertices or more, with noise for distances: files do not care. */
export function noisyBody(mesh: Mesh): BodyData {
  return {
    version: 1,
    distance: 'fast-marching',
    mesh,
    positionsHash: hashPositions(mesh.positions),
    normalization: { center: [0.1, 0.2, 0.3], diagonal: 7 },
    grid: { origin: [-0.5, -0.5, -0.5], spacing: 0.1, dimensions: [10, 10, 10] },
    voxels: Uint32Array.from({ length: 77 }, (_, i) => i * 7),
    centers: Uint32Array.of(3, 1, 15),
    distances: Uint16Array.from({ length: 3 * 77 }, (_, i) => i * 283),
    distanceScale: 1e-5,
    spheres: Float64Array.of(0, 0, 0, 0.5, 0.25, 0.25, 0.25, 0.125),
  };
}
