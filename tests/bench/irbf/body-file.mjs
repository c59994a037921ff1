/** The body file that the native side of the benchmark reads: see bench.cpp for the order. */

/**
 * @param {import('../../../wasm/ts/index.ts').BodyData} body
 * @param {readonly number[]} handles Vertex numbers.
 * @param {readonly [number, number, number]} shift Of the first handle's target, model units.
 * @returns {Uint8Array}
 */
export function bodyFile(body, handles, shift) {
  const { positions, triangles } = body.mesh;
  const counts = Uint32Array.of(
    positions.length / 3,
    triangles.length / 3,
    body.voxels.length,
    body.centers.length,
    body.spheres.length / 4,
    handles.length,
    ...body.grid.dimensions,
  );
  const { center, diagonal } = body.normalization;
  const numbers = Float64Array.of(...center, diagonal, ...body.grid.origin, body.grid.spacing, body.distanceScale);
  const places = Float64Array.from(handles.flatMap((v) => [...positions.subarray(3 * v, 3 * v + 3)]));
  const parts = [
    counts,
    numbers,
    Float64Array.from(positions),
    body.spheres,
    places,
    Float64Array.from(shift),
    Uint32Array.from(triangles),
    body.voxels,
    body.centers,
    body.distances,
  ];
  return Buffer.concat(parts.map((part) => new Uint8Array(part.buffer, part.byteOffset, part.byteLength)));
}
