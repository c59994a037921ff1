/** Smooth normals for files that have none: the area-weighted mean of the triangles around each vertex, of unit length. */
export function areaNormals(positions: Float32Array, triangles: ArrayLike<number>): Float32Array {
  const sums = new Float64Array(positions.length);
  const at = (corner: number, axis: number) => positions[(triangles[corner] as number) * 3 + axis] as number;
  for (let t = 0; t < triangles.length; t += 3) {
    const [ux, uy, uz] = [at(t + 1, 0) - at(t, 0), at(t + 1, 1) - at(t, 1), at(t + 1, 2) - at(t, 2)];
    const [vx, vy, vz] = [at(t + 2, 0) - at(t, 0), at(t + 2, 1) - at(t, 1), at(t + 2, 2) - at(t, 2)];
    // Twice the area long: larger triangles count for more.
    const cross = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (let corner = t; corner < t + 3; corner++) {
      const vertex = (triangles[corner] as number) * 3;
      for (let axis = 0; axis < 3; axis++) sums[vertex + axis] = (sums[vertex + axis] as number) + (cross[axis] as number);
    }
  }
  const normals = new Float32Array(positions.length);
  for (let i = 0; i < sums.length; i += 3) {
    const [x, y, z] = [sums[i] as number, sums[i + 1] as number, sums[i + 2] as number];
    const length = Math.hypot(x, y, z);
    // A vertex of no area points up: glTF wants unit length of every normal.
    if (length > 0) normals.set([x / length, y / length, z / length], i);
    else normals[i + 1] = 1;
  }
  return normals;
}
