import type { BufferAttribute, InterleavedBufferAttribute } from 'three';

/** So many numbers a vertex, whatever the attribute's layout; those that it lacks are 0, as on the graphics card. */
export function decode(attribute: BufferAttribute | InterleavedBufferAttribute, width = 3): Float32Array {
  const out = new Float32Array(attribute.count * width);
  const there = Math.min(width, attribute.itemSize);
  for (let i = 0, at = 0; i < attribute.count; i++, at += width) {
    out[at] = attribute.getX(i);
    if (there > 1) out[at + 1] = attribute.getY(i);
    if (there > 2) out[at + 2] = attribute.getZ(i);
    if (there > 3) out[at + 3] = attribute.getW(i);
  }
  return out;
}
