/** meshoptimizer's vertex codec, loaded when the first body is read or written. */
import { HandlebodyError } from '../../wasm/ts/errors.ts';

/** Loads what decompresses. Rejects with 'wasm-unavailable'. */
export async function loadDecoder() {
  return start(async () => (await import('meshoptimizer/decoder')).MeshoptDecoder);
}

/** Loads what compresses. Rejects with 'wasm-unavailable'. */
export async function loadEncoder() {
  return start(async () => (await import('meshoptimizer/encoder')).MeshoptEncoder);
}

async function start<Codec extends { supported: boolean; ready: Promise<void> }>(load: () => Promise<Codec>): Promise<Codec> {
  try {
    const codec = await load();
    if (!codec.supported) throw new Error('this browser does not offer WebAssembly');
    await codec.ready;
    return codec;
  } catch (cause) {
    throw new HandlebodyError('wasm-unavailable', {
      message: `The codec of baked bodies, which is WebAssembly, could not be started: ${cause instanceof Error ? cause.message : String(cause)}.`,
      remedy:
        "Use a current browser; a content security policy needs 'wasm-unsafe-eval'. Check that the page's scripts can be fetched.",
      cause,
    });
  }
}
