import { WASM_BYTES, WASM_DEFLATED_BASE64 } from './binary.generated.ts';

/** Decompresses and compiles the wasm that the library carries inside. */
export async function inlineModule(): Promise<WebAssembly.Module> {
  const deflated = Uint8Array.from(atob(WASM_DEFLATED_BASE64), (c) => c.charCodeAt(0));
  const stream = new Blob([deflated]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
  const bytes = await new Response(stream).arrayBuffer();
  if (bytes.byteLength !== WASM_BYTES) throw new Error(`the wasm inside is damaged: ${bytes.byteLength} of ${WASM_BYTES} bytes`);
  return WebAssembly.compile(bytes);
}
