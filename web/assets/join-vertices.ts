/** A hash table's slots for so many entries: a power of two, less one, of which at most three quarters are taken. */
const maskFor = (count: number) => 2 ** Math.ceil(Math.log2((count * 4) / 3 + 1)) - 1;

const MINUS_ZERO = 0x8000_0000;

/** For each vertex of n×3 positions the first one at its place, as floats: −0 is 0. */
export function joinVertices(positions: ArrayLike<number>): Uint32Array {
  const floats = positions instanceof Float32Array ? positions : Float32Array.from(positions);
  const words = new Uint32Array(floats.buffer, floats.byteOffset, floats.length);
  const word = (i: number) => (words[i] === MINUS_ZERO ? 0 : (words[i] as number));
  const count = floats.length / 3;
  const first = new Uint32Array(count);
  const mask = maskFor(count);
  const table = new Int32Array(mask + 1).fill(-1);
  for (let v = 0; v < count; v++) {
    const x = word(3 * v);
    const y = word(3 * v + 1);
    const z = word(3 * v + 2);
    let slot = mixed(x, y, z) & mask;
    for (let at = table[slot] as number; at !== -1; at = table[slot] as number) {
      if (word(3 * at) === x && word(3 * at + 1) === y && word(3 * at + 2) === z) break;
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
  const mask = maskFor(count);
  const table = new Int32Array(mask + 1).fill(-1);
  let doubled = 0;
  const lowOf = (t: number) => Math.min(triangles[t] as number, triangles[t + 1] as number, triangles[t + 2] as number);
  const highOf = (t: number) => Math.max(triangles[t] as number, triangles[t + 1] as number, triangles[t + 2] as number);
  const sumOf = (t: number) => (triangles[t] as number) + (triangles[t + 1] as number) + (triangles[t + 2] as number);
  for (let t = 0; t < count; t++) {
    const [low, high, sum] = [lowOf(3 * t), highOf(3 * t), sumOf(3 * t)];
    let slot = mixed(low, sum, high) & mask;
    for (let at = table[slot] as number; at !== -1; at = table[slot] as number) {
      if (lowOf(3 * at) === low && highOf(3 * at) === high && sumOf(3 * at) === sum) break;
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
