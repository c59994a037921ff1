/** The container of a GLB: header and chunks. Every byte that is read was checked to be there. */
import { Fault } from './fault.ts';
import { isDeepText, MAX_DEPTH } from './gltf-json.ts';

const MAGIC = 0x46546c67; // "glTF"
const JSON_CHUNK = 0x4e4f534a;
const BIN_CHUNK = 0x004e4942;

export function isGlb(bytes: Uint8Array): boolean {
  return bytes.length >= 4 && new DataView(bytes.buffer, bytes.byteOffset, 4).getUint32(0, true) === MAGIC;
}

/** A GLB's chunks, its JSON parsed but not looked into. */
interface GlbChunks {
  readonly json: unknown;
  readonly text: string;
  readonly bin: Uint8Array | undefined;
  /** Where the binary chunk begins, or 0. */
  readonly binStart: number;
  /** Of the file, as its header says it. */
  readonly length: number;
}

/** The container alone, of what `isGlb`: throws a `Fault` as `checkGlb` has it in words, but for what is in the JSON. */
export function splitGlb(bytes: Uint8Array): GlbChunks {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 20) throw new Fault('glb-header', [bytes.length], { byte: bytes.length });
  const version = view.getUint32(4, true);
  if (version !== 2) {
    throw new Fault('glb-version', [version], { byte: 4 });
  }
  const length = view.getUint32(8, true);
  if (length > bytes.length) throw new Fault('glb-length', [length, bytes.length], { byte: bytes.length });

  let json: Uint8Array | undefined;
  let bin: Uint8Array | undefined;
  let binStart = 0;
  // Chunks after the second are for extensions and skipped; so is padding that is too short to be a chunk.
  for (let offset = 12, index = 0; offset + 8 <= length; index++) {
    const chunkLength = view.getUint32(offset, true);
    const type = view.getUint32(offset + 4, true);
    const start = offset + 8;
    if (start + chunkLength > length) {
      throw new Fault('glb-chunk', [chunkLength, offset], { byte: offset });
    }
    const chunk = bytes.subarray(start, start + chunkLength);
    if (index === 0) {
      if (type !== JSON_CHUNK) throw new Fault('glb-first', [], { byte: offset + 4 });
      json = chunk;
    } else if (index === 1 && type === BIN_CHUNK) {
      [bin, binStart] = [chunk, start];
    }
    offset = start + chunkLength;
  }
  if (!json) throw new Fault('glb-json', [], { byte: 12 });
  return { ...parseJson(json), bin, binStart, length };
}

function parseJson(chunk: Uint8Array): { json: unknown; text: string } {
  try {
    const text = new TextDecoder('utf-8', { fatal: true }).decode(chunk);
    if (isDeepText(text)) throw new Fault('nested', [MAX_DEPTH]);
    return { json: JSON.parse(text), text };
  } catch (cause) {
    if (cause instanceof Fault) throw cause;
    const position = Number(/position (\d+)/.exec(String(cause))?.[1] ?? 0);
    throw new Fault('glb-text', [], { byte: 20 + position, cause });
  }
}
