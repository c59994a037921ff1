import type { CulpritKind, ErrorCode } from './abi.generated.ts';

export type { CulpritKind, ErrorCode } from './abi.generated.ts';

/** Which part of the input is at fault: the vertex, handle, example … with this number. */
export interface Culprit {
  readonly kind: CulpritKind;
  readonly index: number;
}

/**
 * The one error type of this library. `message` says in a plain sentence what is wrong, `remedy` what to do about it; both are
 * written to be shown to people. `code` is stable and made for programs.
 */
export class HandlebodyError extends Error {
  override readonly name = 'HandlebodyError';
  readonly code: ErrorCode;
  readonly remedy: string;
  readonly culprit: Culprit | undefined;

  constructor(code: ErrorCode, options: { message: string; remedy: string; culprit?: Culprit | undefined; cause?: unknown }) {
    super(options.message, { cause: options.cause });
    this.code = code;
    this.remedy = options.remedy;
    this.culprit = options.culprit;
  }
}

/** Throws what an aborted signal asks for, as our own error type. */
export function throwIfAborted(signal: AbortSignal | undefined): void {
  if (!signal?.aborted) return;
  throw new HandlebodyError('aborted', {
    message: 'The work was cancelled.',
    remedy: 'Start it again when you need it.',
    cause: signal.reason,
  });
}
