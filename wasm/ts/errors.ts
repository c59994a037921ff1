import type { CulpritKind, SolverErrorCode } from './abi.generated.ts';

export type { CulpritKind, SolverErrorCode } from './abi.generated.ts';

/**
 * Everything that can go wrong, by name: what the solver returns (wasm/core/errors/status.h), and here what its loader and its classes
 * throw. Readers of files, makers of shapes and the command add their own names beside their code, by `declare module`: so
 * `new HandlebodyError('file-nto-glb', …)` does not compile.
 */
export interface ErrorCodes extends Record<SolverErrorCode, true> {
  /** The object, or the solver that made it, was used after dispose(). */
  disposed: true;
  /** The caller's AbortSignal fired. */
  aborted: true;
  /** WebAssembly is missing, blocked or could not be compiled. */
  'wasm-unavailable': true;
  /** The instance trapped before; load() a new one. */
  'wasm-trapped': true;
  /** A body that was baked for another mesh. */
  'body-mismatch': true;
  /** An example's shape has another length than the others'. */
  'example-shape-mismatch': true;
}

/** Stable names of everything that can go wrong in the entries of the library that a program imports. */
export type ErrorCode = keyof ErrorCodes;

/** Which part of the input is at fault: the vertex, handle, example … with this number. */
export interface Culprit {
  readonly kind: CulpritKind;
  readonly index: number;
}

/**
 * The one error type of this library. `message` says in a plain sentence what is wrong, `remedy` what to do about it; both are
 * written to be shown to people. `code` is stable and made for programs.
 *
 * ```ts
 * try {
 *   await hb.bake({ positions: new Float32Array(3), triangles: new Uint32Array() });
 * } catch (error) {
 *   if (error instanceof HandlebodyError) console.log(error.code, error.message, error.remedy);
 * }
 * ```
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
