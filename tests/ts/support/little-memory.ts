import { readFileSync } from 'node:fs';
import type { Exports } from '../../../wasm/ts/abi.generated.ts';
import { type Handlebody, load } from '../../../wasm/ts/index.ts';

const PAGE = 65536;

/** A whole solver whose memory never grows, and what leaves it so many bytes. */
export interface Limited {
  readonly hb: Handlebody;
  /** Takes all memory but so many bytes in one piece; gives what takes it back. */
  leave(bytes: number): () => void;
  /** Bytes that can be had, in pieces. */
  free(): number;
}

export async function littleMemory(pages: number): Promise<Limited> {
  const { instantiate } = WebAssembly;
  let exports: Exports | undefined;
  WebAssembly.instantiate = (async (module: WebAssembly.Module, imports: WebAssembly.Imports) => {
    const instance = await instantiate(module, imports);
    exports = instance.exports as unknown as Exports;
    return instance;
  }) as unknown as typeof instantiate;
  const wasm = withMaximum(readFileSync(new URL('../../../wasm/handlebody.wasm', import.meta.url)), pages);
  const hb = await load({ wasm }).finally(() => {
    WebAssembly.instantiate = instantiate;
  });
  const { hb_alloc, hb_release } = exports as unknown as Exports;
  const taken = () => {
    const blocks: [number, number][] = [];
    for (let size = 2 ** 26; size >= 16; size /= 4)
      for (let at = hb_alloc(size) >>> 0; at !== 0; at = hb_alloc(size) >>> 0) blocks.push([at, size]);
    return blocks;
  };
  const release = (blocks: [number, number][]) => {
    for (const [at] of blocks) hb_release(at);
  };
  return {
    hb,
    leave: (bytes) => {
      const room = hb_alloc(bytes) >>> 0;
      if (room === 0) throw new Error(`There are no ${bytes} bytes in one piece.`);
      const blocks = taken();
      hb_release(room);
      return () => release(blocks);
    },
    free: () => {
      const blocks = taken();
      release(blocks);
      return blocks.reduce((sum, [, size]) => sum + size, 0);
    },
  };
}

/** The same module, with a memory of so many pages at the most, and from the beginning. */
function withMaximum(bytes: Uint8Array, pages: number): Uint8Array<ArrayBuffer> {
  const parts: Uint8Array[] = [bytes.slice(0, 8)];
  for (let at = 8; at < bytes.length; ) {
    const [size, from] = leb(bytes, at + 1);
    // The memory section: one memory, with a maximum.
    if (bytes[at] === 5) {
      const section = [1, 1, ...toLeb(pages), ...toLeb(pages)];
      parts.push(Uint8Array.from([5, ...toLeb(section.length), ...section]));
    } else parts.push(bytes.slice(at, from + size));
    at = from + size;
  }
  return Uint8Array.from(parts.flatMap((part) => [...part]));
}

function leb(bytes: Uint8Array, at: number): [value: number, after: number] {
  let value = 0;
  for (let shift = 0; ; shift += 7, at++) {
    const byte = bytes[at] as number;
    value += (byte & 127) * 2 ** shift;
    if (byte < 128) return [value, at + 1];
  }
}

function toLeb(value: number): number[] {
  return value < 128 ? [value] : [(value & 127) | 128, ...toLeb(Math.floor(value / 128))];
}

export const MEGABYTES = (n: number) => (n * 2 ** 20) / PAGE;
