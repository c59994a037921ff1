import type { Handlebody } from '../../wasm/ts/index.ts';
import type { HandlebodyRuntime } from '../../wasm/ts/runtime.ts';

/** The solver's smaller link, one instance for all elements of a page, fetched when the first asks for it. */
export const runtime = once<HandlebodyRuntime>(() => import('../../wasm/ts/runtime.ts').then(({ load }) => load()));

/** The whole of it, for figures that bake or compute weights. */
export const whole = once<Handlebody>(() => import('../../wasm/ts/index.ts').then(({ load }) => load()));

/** Asked for again where it did not come, or came to an end. */
function once<T extends HandlebodyRuntime>(make: () => Promise<T>): () => Promise<T> {
  let coming: Promise<T> | undefined;
  let made: T | undefined;
  return () => {
    if (made?.usable === false) [coming, made] = [undefined, undefined];
    coming ??= make();
    coming.then(
      (hb) => {
        made = hb;
      },
      () => {
        coming = undefined;
      },
    );
    return coming;
  };
}
