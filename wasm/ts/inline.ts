import { HandlebodyError } from './errors.ts';
import type { Heap } from './heap.ts';
import { checkWebAssembly, instantiate, type Link, type Links, type LoadOptions, readLoadOptions } from './load.ts';

/** A wasm file that the library carries inside: its size, and itself in raw deflate and base64. */
interface InlineWasm {
  readonly bytes: number;
  readonly deflated: string;
}

/** Starts one of the two links: from the wasm that the caller names, or else from the one inside. */
export async function loadInline<L extends Link>(link: L, inside: InlineWasm, options: LoadOptions): Promise<Heap<Links[L]>> {
  const { wasm, signal } = readLoadOptions(options);
  if (wasm) return instantiate(link, wasm, signal);
  checkWebAssembly();
  let module: WebAssembly.Module;
  try {
    module = await compile(inside);
  } catch (cause) {
    throw new HandlebodyError('wasm-unavailable', {
      message: `The solver's WebAssembly could not be compiled: ${cause instanceof Error ? cause.message : String(cause)}`,
      remedy: "Use a current browser; a content security policy needs 'wasm-unsafe-eval'.",
      cause,
    });
  }
  return instantiate(link, module, signal);
}

export async function compile({ bytes, deflated }: InlineWasm): Promise<WebAssembly.Module> {
  const stream = new Blob([Uint8Array.from(atob(deflated), (c) => c.charCodeAt(0))])
    .stream()
    .pipeThrough(new DecompressionStream('deflate-raw'));
  const inflated = await new Response(stream).arrayBuffer();
  if (inflated.byteLength !== bytes) throw new Error(`the wasm inside is damaged: ${inflated.byteLength} of ${bytes} bytes`);
  return WebAssembly.compile(inflated);
}
