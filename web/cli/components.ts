import { joinVertices } from '../assets/join-vertices.ts';

/**
 * How many pieces a surface has: triangles that share a corner, by position and not by number, hang together. Vertices of no triangle
 * count for nothing.
 */
export function countComponents(positions: ArrayLike<number>, triangles: ArrayLike<number>): number {
  const parent = joinVertices(positions);
  const find = (vertex: number): number => {
    let v = vertex;
    while (parent[v] !== v) {
      parent[v] = parent[parent[v] as number] as number;
      v = parent[v] as number;
    }
    return v;
  };
  for (let t = 0; t < triangles.length; t += 3) {
    const first = find(triangles[t] as number);
    parent[find(triangles[t + 1] as number)] = first;
    parent[find(triangles[t + 2] as number)] = find(first);
  }
  const roots = new Set<number>();
  for (let k = 0; k < triangles.length; k++) roots.add(find(triangles[k] as number));
  return roots.size;
}
