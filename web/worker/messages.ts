/** What the page and the baking worker say to each other. Everything is plain data; arrays are transferred, not copied. */
import { type CulpritKind, type ErrorCode, HandlebodyError } from '../../wasm/ts/errors.ts';
import type { BakeOptions, BakeShape, BakeWarning, BodyData } from '../../wasm/ts/types.ts';

/** Options that can be posted; the rest act on the page's side. */
export type PostedBakeOptions = Omit<BakeOptions, 'signal' | 'onProgress' | 'onWarning'>;

export interface BakeRequest {
  readonly type: 'bake';
  readonly shape: BakeShape;
  readonly options: PostedBakeOptions;
}

/** A copy of a shape, and the buffers that can be handed over with it. */
export function copyShape(shape: BakeShape): { copy: BakeShape; buffers: ArrayBuffer[] } {
  const copy = Object.fromEntries(
    Object.entries(shape).map(([name, value]) => [name, ArrayBuffer.isView(value) ? (value as Uint8Array).slice() : value]),
  ) as unknown as BakeShape;
  const buffers = Object.values(copy).flatMap((value) => (ArrayBuffer.isView(value) ? [value.buffer as ArrayBuffer] : []));
  return { copy, buffers };
}

/** An error as plain data: a posted error loses its class and all properties of its own. */
interface PostedError {
  readonly code: ErrorCode;
  readonly message: string;
  readonly remedy: string;
  readonly culprit?: { readonly kind: CulpritKind; readonly index: number } | undefined;
  readonly stack?: string | undefined;
}

export type BakeReply =
  /** The worker's code runs: without this, the page knows that it never started. */
  | { readonly type: 'ready' }
  | { readonly type: 'progress'; readonly part: number }
  | { readonly type: 'warning'; readonly warning: BakeWarning }
  /** A mesh that was baked stays behind: the page has it. That of another shape comes along. */
  | { readonly type: 'body'; readonly body: Omit<BodyData, 'mesh'> & Partial<Pick<BodyData, 'mesh'>> }
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
    message: `Baking failed: ${message}`,
    remedy: 'This is a defect: please report it, with the model if you can.',
    stack: error instanceof Error ? error.stack : undefined,
  };
}

/** The error that the worker meant. Its `cause` holds the worker's stack. */
export function unpackError({ code, message, remedy, culprit, stack }: PostedError): HandlebodyError {
  return new HandlebodyError(code, { message, remedy, culprit, cause: stack });
}
