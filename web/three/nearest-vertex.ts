import type { Mesh } from '../../wasm/ts/types.ts';

/** The vertex nearest to a place, in the model's units. */
export function nearestVertex({ positions, origin = [0, 0, 0] }: Mesh, place: { x: number; y: number; z: number }): number {
  const [x, y, z] = [place.x - origin[0], place.y - origin[1], place.z - origin[2]];
  let [best, least] = [0, Number.POSITIVE_INFINITY];
  for (let v = 0; v < positions.length / 3; v++) {
    const [dx, dy, dz] = [
      (positions[3 * v] as number) - x,
      (positions[3 * v + 1] as number) - y,
      (positions[3 * v + 2] as number) - z,
    ];
    const d = dx * dx + dy * dy + dz * dz;
    if (d < least) [best, least] = [v, d];
  }
  return best;
}
