/**
 * How many pieces a surface has: triangles that share a corner, by position and not by number, hang together. Vertices of no triangle
 * count for nothing.
 */
export function countComponents(positions: ArrayLike<number>, triangles: ArrayLike<number>): number {
  const parent = weld(positions);
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

/** For each vertex the first one at its place. */
function weld(positions: ArrayLike<number>): Uint32Array {
  const count = positions.length / 3;
  const first = new Uint32Array(count);
  const mask = 2 ** Math.ceil(Math.log2(count * 2 + 1)) - 1;
  const table = new Int32Array(mask + 1).fill(-1);
  // −0 is 0, and every NaN is one.
  const words = new Uint32Array(Float32Array.from(positions, (x) => x + 0).buffer);
  for (let v = 0; v < count; v++) {
    const [x, y, z] = [words[3 * v] as number, words[3 * v + 1] as number, words[3 * v + 2] as number];
    const mixed = Math.imul(x, 0x9e3779b1) ^ Math.imul(y, 0x85ebca6b) ^ Math.imul(z, 0xc2b2ae35);
    let slot = (mixed ^ (mixed >>> 15)) & mask;
    for (let at = table[slot] as number; at !== -1; at = table[slot] as number) {
      if (words[3 * at] === x && words[3 * at + 1] === y && words[3 * at + 2] === z) break;
      slot = (slot + 1) & mask;
    }
    if (table[slot] === -1) table[slot] = v;
    first[v] = table[slot] as number;
  }
  return first;
}
