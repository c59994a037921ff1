import { HandlebodyError } from '../../wasm/ts/errors.ts';

/** Fetches a file and tells how far it is; the part is `undefined` when the server does not say how long the file is. */
export async function fetchModel(
  url: URL,
  signal: AbortSignal,
  onProgress: (part: number | undefined) => void,
): Promise<ArrayBuffer> {
  let response: Response;
  try {
    response = await fetch(url, { signal });
  } catch (cause) {
    if (signal.aborted) throw cause;
    // Browsers do not say which of the two it was.
    const elsewhere = url.origin === globalThis.location?.origin ? '' : ', or does not allow its files on pages of other sites';
    throw unreadable(`The model could not be fetched: the server did not answer${elsewhere}.`, cause, elsewhere && CROSS_ORIGIN);
  }
  if (!response.ok || !response.body) throw unreadable(`The model could not be fetched: the server answered ${response.status}.`);
  // A compressed answer announces its compressed length, which says nothing about the bytes read here.
  const announced = response.headers.has('content-encoding') ? 0 : Number(response.headers.get('content-length') ?? 0);
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let length = 0;
  const reader = response.body.getReader();
  const next = () =>
    reader.read().catch((cause: unknown) => {
      throw signal.aborted ? cause : unreadable('The model came only in part: the connection broke off.', cause);
    });
  for (let piece = await next(); !piece.done; piece = await next()) {
    parts.push(piece.value);
    length += piece.value.length;
    onProgress(announced > 0 ? Math.min(length / announced, 1) : undefined);
  }
  return new Blob(parts).arrayBuffer();
}

const CROSS_ORIGIN = 'Check the connection and the address; the server has to send “Access-Control-Allow-Origin”.';

function unreadable(message: string, cause?: unknown, remedy = ''): HandlebodyError {
  const usual = 'Check your connection, then choose the model again.';
  return new HandlebodyError('file-unreadable', { message, remedy: remedy || usual, cause });
}
