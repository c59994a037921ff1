import type { Mesh } from '../../wasm/ts/types.ts';

/** `count` vertices spread over the surface: the first is farthest from the middle, each next one farthest from all before. */
export function farthestVertices(mesh: Pick<Mesh, 'positions' | 'triangles'>, count: number): number[] {
  const { positions } = mesh;
  const used = usedVertices(mesh);
  const middle = [0, 0, 0];
  for (const v of used)
    for (let axis = 0; axis < 3; axis++)
      middle[axis] = (middle[axis] as number) + (positions[3 * v + axis] as number) / used.length;
  const nearest = new Float64Array(used.length).fill(Number.POSITIVE_INFINITY);
  const chosen: number[] = [];
  let [x, y, z] = middle as [number, number, number];
  for (let round = 0; round < Math.min(count, used.length); round++) {
    let best = 0;
    used.forEach((v, k) => {
      const [ax, ay, az] = [
        (positions[v * 3] as number) - x,
        (positions[v * 3 + 1] as number) - y,
        (positions[v * 3 + 2] as number) - z,
      ];
      const d = ax * ax + ay * ay + az * az;
      // The middle only picks the first; it is no handle itself.
      nearest[k] = round <= 1 ? d : Math.min(nearest[k] as number, d);
      if ((nearest[k] as number) > (nearest[best] as number)) best = k;
    });
    if (round > 0 && nearest[best] === 0) break;
    const vertex = used[best] as number;
    chosen.push(vertex);
    [x, y, z] = [positions[vertex * 3] as number, positions[vertex * 3 + 1] as number, positions[vertex * 3 + 2] as number];
  }
  return chosen;
}

/** Vertices of no triangle are no part of the surface; of a cloud, all count. */
function usedVertices({ positions, triangles }: Pick<Mesh, 'positions' | 'triangles'>): Uint32Array {
  const used = new Uint8Array(positions.length / 3).fill(triangles.length === 0 ? 1 : 0);
  for (const vertex of triangles) used[vertex] = 1;
  return Uint32Array.from(used.keys()).filter((v) => used[v] === 1);
}
