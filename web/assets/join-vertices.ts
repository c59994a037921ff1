/** A hash table's slots for so many entries: a power of two, less one, of which at most three quarters are taken. */
const maskFor = (count: number) => 2 ** Math.ceil(Math.log2((count * 4) / 3 + 1)) - 1;

const MINUS_ZERO = 0x8000_0000;

/**
 * A hash of three words by tables of random numbers, one for each of their bytes (Zobrist; linear probing is then constant in the mean
 * whatever the keys, Pătraşcu and Thorup, 2012). One that only multiplies is the same for all floats whose last bits are zero, as those of
 * small whole numbers are, and its collisions can be computed beforehand.
 */
function randomHash(): (x: number, y: number, z: number) => number {
  const table = Uint32Array.from({ length: 12 << 8 }, () => Math.random() * 2 ** 32);
  const of = (word: number, at: number) =>
    (table[at + (word & 255)] as number) ^
    (table[at + 256 + ((word >>> 8) & 255)] as number) ^
    (table[at + 512 + ((word >>> 16) & 255)] as number) ^
    (table[at + 768 + (word >>> 24)] as number);
  return (x, y, z) => of(x, 0) ^ of(y, 1024) ^ of(z, 2048);
}

/** For each vertex of n×3 positions the first one at its place, as floats: −0 is 0. */
export function joinVertices(positions: ArrayLike<number>): Uint32Array {
  const floats = positions instanceof Float32Array ? positions : Float32Array.from(positions);
  const words = new Uint32Array(floats.buffer, floats.byteOffset, floats.length);
  const word = (i: number) => (words[i] === MINUS_ZERO ? 0 : (words[i] as number));
  const count = floats.length / 3;
  const first = new Uint32Array(count);
  const mask = maskFor(count);
  const table = new Int32Array(mask + 1).fill(-1);
  const hash = randomHash();
  for (let v = 0; v < count; v++) {
    const x = word(3 * v);
    const y = word(3 * v + 1);
    const z = word(3 * v + 2);
    let slot = hash(x, y, z) & mask;
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
  const hash = randomHash();
  let doubled = 0;
  const lowOf = (t: number) => Math.min(triangles[t] as number, triangles[t + 1] as number, triangles[t + 2] as number);
  const highOf = (t: number) => Math.max(triangles[t] as number, triangles[t + 1] as number, triangles[t + 2] as number);
  const sumOf = (t: number) => (triangles[t] as number) + (triangles[t + 1] as number) + (triangles[t + 2] as number);
  for (let t = 0; t < count; t++) {
    const [low, high, sum] = [lowOf(3 * t), highOf(3 * t), sumOf(3 * t)];
    let slot = hash(low, sum, high) & mask;
    for (let at = table[slot] as number; at !== -1; at = table[slot] as number) {
      if (lowOf(3 * at) === low && highOf(3 * at) === high && sumOf(3 * at) === sum) break;
      slot = (slot + 1) & mask;
    }
    if (table[slot] === -1) table[slot] = t;
    else if (doubled++ === 0) onFirst(t);
  }
  return doubled;
}
