import type { Handlebody } from '../../wasm/ts/index.ts';
import type { HandlebodyRuntime } from '../../wasm/ts/runtime.ts';
import { renewed } from '../ui/solver-end.ts';

/** The solver's smaller link, one instance for all elements of a page, fetched when the first asks for it. */
export const runtime = renewed<HandlebodyRuntime>(() => import('../../wasm/ts/runtime.ts').then(({ load }) => load()));

/** The whole of it, for figures that bake or compute weights. */
export const whole = renewed<Handlebody>(() => import('../../wasm/ts/index.ts').then(({ load }) => load()));
