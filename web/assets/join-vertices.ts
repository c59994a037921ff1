/** For each vertex of n×3 positions the first one at its place, as floats: −0 is 0, and every NaN is one. */
export function joinVertices(positions: ArrayLike<number>): Uint32Array {
  const count = positions.length / 3;
  const first = new Uint32Array(count);
  const mask = 2 ** Math.ceil(Math.log2(count * 2 + 1)) - 1;
  const table = new Int32Array(mask + 1).fill(-1);
  const floats = new Float32Array(positions.length);
  for (let i = 0; i < floats.length; i++) floats[i] = (positions[i] as number) + 0;
  const words = new Uint32Array(floats.buffer);
  for (let v = 0; v < count; v++) {
    const [x, y, z] = [words[3 * v] as number, words[3 * v + 1] as number, words[3 * v + 2] as number];
    let slot = mixed(x, y, z) & mask;
    for (let at = table[slot] as number; at !== -1; at = table[slot] as number) {
      if (words[3 * at] === x && words[3 * at + 1] === y && words[3 * at + 2] === z) break;
      slot = (slot + 1) & mask;
    }
    if (table[slot] === -1) table[slot] = v;
    first[v] = table[slot] as number;
  }
  return first;
}

/** How many triangles have the three vertices of one before them, in whatever order; `onFirst` gets the first of them. */
export function countDoubled(triangles: Uint32Array, onFirst: (triangle: number) => void): number {
  const count = triangles.length / 3;
  const mask = 2 ** Math.ceil(Math.log2(count * 2 + 1)) - 1;
  const table = new Int32Array(mask + 1).fill(-1);
  let doubled = 0;
  const sorted = new Uint32Array(triangles.length);
  for (let t = 0; t < count; t++) {
    const [a, b, c] = [triangles[3 * t] as number, triangles[3 * t + 1] as number, triangles[3 * t + 2] as number];
    const [low, high] = [Math.min(a, b, c), Math.max(a, b, c)];
    const middle = a + b + c - low - high;
    sorted[3 * t] = low;
    sorted[3 * t + 1] = middle;
    sorted[3 * t + 2] = high;
    let slot = mixed(low, middle, high) & mask;
    for (let at = table[slot] as number; at !== -1; at = table[slot] as number) {
      if (sorted[3 * at] === low && sorted[3 * at + 1] === middle && sorted[3 * at + 2] === high) break;
      slot = (slot + 1) & mask;
    }
    if (table[slot] === -1) table[slot] = t;
    else if (doubled++ === 0) onFirst(t);
  }
  return doubled;
}

function mixed(x: number, y: number, z: number): number {
  const sum = Math.imul(x, 0x9e3779b1) ^ Math.imul(y, 0x85ebca6b) ^ Math.imul(z, 0xc2b2ae35);
  const half = Math.imul(sum ^ (sum >>> 15), 0x2c1b3c6d);
  return half ^ (half >>> 13);
}
