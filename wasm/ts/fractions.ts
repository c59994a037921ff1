import { HandlebodyError } from './errors.ts';
import type { TypedArray } from './types.ts';

/** Throws 'invalid-shape' for an array of whole numbers as the place for results: it would cut them off. */
export function checkFractions(out: TypedArray): void {
  const kind = out[Symbol.toStringTag];
  if (kind.startsWith('Float')) return;
  throw new HandlebodyError('invalid-shape', {
    message: `The results cannot go into a ${kind}, which holds whole numbers.`,
    remedy: 'Give a Float32Array or a Float64Array.',
  });
}
