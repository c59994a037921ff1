/** What the page and a worker say to each other. Everything is plain data; arrays are transferred, not copied. */
import { type CulpritKind, type ErrorCode, HandlebodyError } from '../../wasm/ts/errors.ts';
import type { BakeWarning } from '../../wasm/ts/types.ts';

export interface WorkRequest<Question> {
  readonly type: 'work';
  readonly question: Question;
  /** For a script that brings no solver of its own. */
  readonly wasm?: WebAssembly.Module;
}

/** An error as plain data: a posted error loses its class and all properties of its own. */
interface PostedError {
  readonly code: ErrorCode;
  readonly message: string;
  readonly remedy: string;
  readonly culprit?: { readonly kind: CulpritKind; readonly index: number } | undefined;
  readonly stack?: string | undefined;
}

export type WorkReply<Answer> =
  /** The worker's code runs: without this, the page knows that it never started. It holds the lock `life` until it ends. */
  | { readonly type: 'ready'; readonly life?: string | undefined }
  | { readonly type: 'progress'; readonly part: number }
  | { readonly type: 'warning'; readonly warning: BakeWarning }
  | { readonly type: 'done'; readonly answer: Answer }
  | { readonly type: 'error'; readonly error: PostedError };

/** Any error as plain data. */
export function packError(error: unknown): PostedError {
  if (error instanceof HandlebodyError) {
    const { code, message, remedy, culprit, stack } = error;
    return { code, message, remedy, culprit, stack };
  }
  const message = error instanceof Error ? error.message : String(error);
  return {
    code: 'internal',
    message: `The worker failed: ${message}`,
    remedy: 'This is a defect: please report it, with the model if you can.',
    stack: error instanceof Error ? error.stack : undefined,
  };
}

/** The error that the worker meant. Its `cause` holds the worker's stack. */
export function unpackError({ code, message, remedy, culprit, stack }: PostedError): HandlebodyError {
  return new HandlebodyError(code, { message, remedy, culprit, cause: stack });
}
