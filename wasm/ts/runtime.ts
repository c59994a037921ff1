import { bound } from './bound.ts';
import { HandlebodyRuntime } from './handlebody-runtime.ts';
import { loadInline } from './inline.ts';
import type { LoadOptions } from './load.ts';
import { WASM_BYTES, WASM_DEFLATED_BASE64 } from './runtime-binary.generated.ts';

export * from './runtime-api.ts';

/**
 * Loads the smaller solver, for pages that interpolate, or deform with bodies and weights that were made elsewhere. The wasm is inside this
 * module, as in "handlebody".
 *
 * ```ts
 * import { load } from 'handlebody/runtime';
 * const irbf = (await load()).irbf(body); // read from a baked GLB, or sent by a worker
 * ```
 */
export async function load(options: LoadOptions = {}): Promise<HandlebodyRuntime> {
  const inside = { bytes: WASM_BYTES, deflated: WASM_DEFLATED_BASE64 };
  return bound(new HandlebodyRuntime(await loadInline('handlebody.runtime.wasm', inside, options)));
}
