import { bound } from './bound.ts';
import { Handlebody } from './handlebody.ts';
import { instantiate, type LoadOptions, readLoadOptions } from './load.ts';

export * from './api.ts';

/**
 * Loads the solver from a separate file: smaller to transfer and compiled while it streams, for sites that host
 * `handlebody.wasm` themselves. Without `wasm` the file is looked for in the package, where Node and most bundlers find it.
 *
 * ```ts
 * import { load } from 'handlebody/external';
 * const hb = await load(); // or load({ wasm: new URL('/files/handlebody.wasm', location.href) })
 * ```
 */
export async function load(options: LoadOptions = {}): Promise<Handlebody> {
  const { wasm = new URL('../../../wasm/handlebody.wasm', import.meta.url), signal } = readLoadOptions(options);
  return bound(new Handlebody(await instantiate('handlebody.wasm', wasm, signal)));
}
