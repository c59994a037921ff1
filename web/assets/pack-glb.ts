import type { GlbParts } from './check-glb.ts';

const MAGIC = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;
const BIN_CHUNK = 0x004e4942;
const SPACE = 0x20;

/** The parts as one GLB. */
export function packGlb({ json, bin }: GlbParts): Uint8Array<ArrayBuffer> {
  const text = new TextEncoder().encode(JSON.stringify(json));
  const [textRoom, binRoom] = [text.length, bin?.length ?? 0].map((length) => Math.ceil(length / 4) * 4) as [number, number];
  const glb = new Uint8Array(20 + textRoom + (bin ? 8 + binRoom : 0));
  const view = new DataView(glb.buffer);
  [MAGIC, 2, glb.length, textRoom, JSON_CHUNK].forEach((word, i) => {
    view.setUint32(4 * i, word, true);
  });
  glb.fill(SPACE, 20, 20 + textRoom).set(text, 20);
  if (bin) {
    view.setUint32(20 + textRoom, binRoom, true);
    view.setUint32(24 + textRoom, BIN_CHUNK, true);
    glb.set(bin, 28 + textRoom);
  }
  return glb;
}
