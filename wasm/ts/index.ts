import { HandlebodyError } from './errors.ts';
import { inlineModule } from './inline.ts';
import { type Handlebody, instantiate, type LoadOptions } from './load.ts';

export * from './api.ts';

/**
 * Loads the solver. The wasm is inside this module, so it works in a page, a worker or Node, under any bundler, with nothing to
 * configure.
 *
 * ```ts
 * import { load } from 'handlebody';
 * const hb = await load();
 * ```
 */
export async function load(options: LoadOptions = {}): Promise<Handlebody> {
  if (options.wasm) return instantiate(options.wasm, options.signal);
  if (typeof WebAssembly !== 'object') return instantiate(new Uint8Array(), options.signal);
  let module: WebAssembly.Module;
  try {
    module = await inlineModule();
  } catch (cause) {
    throw new HandlebodyError('wasm-unavailable', {
      message: `The solver's WebAssembly could not be compiled: ${cause instanceof Error ? cause.message : String(cause)}`,
      remedy: "Use a current browser; a content security policy needs 'wasm-unsafe-eval'.",
      cause,
    });
  }
  return instantiate(module, options.signal);
}
