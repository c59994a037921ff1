/** The nearest triangle that a ray meets, and its corner nearest to the hit: flat arrays, no scene graph. */
export function pickVertex(
  positions: ArrayLike<number>,
  triangles: ArrayLike<number>,
  origin: { x: number; y: number; z: number },
  direction: { x: number; y: number; z: number },
): number | undefined {
  const { x: dx, y: dy, z: dz } = direction;
  let nearest = Number.POSITIVE_INFINITY;
  let found: number | undefined;
  const at = (i: number) => positions[i] as number;
  for (let t = 0; t + 2 < triangles.length; t += 3) {
    const [ia, ib, ic] = [triangles[t] as number, triangles[t + 1] as number, triangles[t + 2] as number];
    const [ax, ay, az] = [at(ia * 3), at(ia * 3 + 1), at(ia * 3 + 2)];
    const [ux, uy, uz] = [at(ib * 3) - ax, at(ib * 3 + 1) - ay, at(ib * 3 + 2) - az];
    const [vx, vy, vz] = [at(ic * 3) - ax, at(ic * 3 + 1) - ay, at(ic * 3 + 2) - az];
    // Möller and Trumbore, both sides.
    const [px, py, pz] = [dy * vz - dz * vy, dz * vx - dx * vz, dx * vy - dy * vx];
    const determinant = ux * px + uy * py + uz * pz;
    if (determinant === 0) continue;
    const [sx, sy, sz] = [origin.x - ax, origin.y - ay, origin.z - az];
    const u = (sx * px + sy * py + sz * pz) / determinant;
    if (u < 0 || u > 1) continue;
    const [qx, qy, qz] = [sy * uz - sz * uy, sz * ux - sx * uz, sx * uy - sy * ux];
    const v = (dx * qx + dy * qy + dz * qz) / determinant;
    if (v < 0 || u + v > 1) continue;
    const distance = (vx * qx + vy * qy + vz * qz) / determinant;
    if (distance <= 0 || distance >= nearest) continue;
    nearest = distance;
    found = u > v ? (u > 1 - u - v ? ib : ia) : v > 1 - u - v ? ic : ia;
  }
  return found;
}
