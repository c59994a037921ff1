import { WASM_BYTES, WASM_DEFLATED_BASE64 } from './binary.generated.ts';
import { bound } from './bound.ts';
import { Handlebody } from './handlebody.ts';
import { compile, loadInline } from './inline.ts';
import type { LoadOptions } from './load.ts';

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
  return bound(new Handlebody(await loadInline('handlebody.wasm', INSIDE, options)));
}

const INSIDE = { bytes: WASM_BYTES, deflated: WASM_DEFLATED_BASE64 };

/** The wasm inside, compiled: to be sent to a worker that has none. @internal */
export function moduleInside(): Promise<WebAssembly.Module> {
  return compile(INSIDE);
}
