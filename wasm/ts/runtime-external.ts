import { bound } from './bound.ts';
import { HandlebodyRuntime } from './handlebody-runtime.ts';
import { instantiate, type LoadOptions, readLoadOptions } from './load.ts';

export * from './runtime-api.ts';

/**
 * Loads the smaller solver from a separate file, as "handlebody/external" does the whole. Without `wasm`, `handlebody.runtime.wasm` is
 * looked for in the package, where Node and most bundlers find it.
 *
 * ```ts
 * import { load } from 'handlebody/runtime/external';
 * const hb = await load(); // or load({ wasm: new URL('/files/handlebody.runtime.wasm', location.href) })
 * ```
 */
export async function load(options: LoadOptions = {}): Promise<HandlebodyRuntime> {
  const { wasm = new URL('../../../wasm/handlebody.runtime.wasm', import.meta.url), signal } = readLoadOptions(options);
  return bound(new HandlebodyRuntime(await instantiate('handlebody.runtime.wasm', wasm, signal)));
}
