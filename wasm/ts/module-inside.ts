import { WASM_BYTES, WASM_DEFLATED_BASE64 } from './binary.generated.ts';
import { compile } from './inline.ts';

/** The whole solver that the library carries inside, compiled: to be started here or sent to a worker. */
export function moduleInside(): Promise<WebAssembly.Module> {
  return compile({ bytes: WASM_BYTES, deflated: WASM_DEFLATED_BASE64 });
}
