import { type Numbers, numbers } from './arguments.ts';

/**
 * A 64-bit hash, after FNV-1a, of positions rounded to float: it ties baked distances to the mesh that they were computed for, however
 * the file that carries both was stored. Not a defence against forgery.
 *
 * ```ts
 * hashPositions(mesh.positions) === body.positionsHash; // the body was baked for this mesh
 * ```
 */
export function hashPositions(positions: Numbers): string {
  const list = numbers(positions, 'positions', { finite: false });
  if (list.length === 0) return hashWords([]); // an array whose memory went to another thread cannot even be read
  const floats = list instanceof Float32Array ? list : Float32Array.from(list);
  return hashWords([new Uint32Array(floats.buffer, floats.byteOffset, floats.length)]);
}

/** The same of any words, one array after another. */
export function hashWords(arrays: readonly Uint32Array[]): string {
  // Two 32-bit lanes with different offsets and primes: BigInt arithmetic would take seconds on a large model.
  let low = 0x811c9dc5;
  let high = 0xcbf29ce4;
  for (const words of arrays) {
    for (const word of words) {
      low = Math.imul(low ^ word, 0x01000193);
      high = Math.imul(high ^ word, 0x01000197) ^ (low >>> 15);
    }
  }
  const hex = (n: number) => (n >>> 0).toString(16).padStart(8, '0');
  return hex(high) + hex(low);
}
