import type { HandlebodyRuntime } from '../../wasm/ts/runtime.ts';

let coming: Promise<HandlebodyRuntime> | undefined;

/** The solver's smaller link, one instance for all elements of a page, fetched when the first asks for it. */
export function runtime(): Promise<HandlebodyRuntime> {
  coming ??= import('../../wasm/ts/runtime.ts').then(({ load }) => load());
  coming.catch(() => {
    coming = undefined;
  });
  return coming;
}
