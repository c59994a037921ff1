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
    throw unreadable('The model could not be fetched: the server did not answer.', cause);
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

function unreadable(message: string, cause?: unknown): HandlebodyError {
  return new HandlebodyError('file-unreadable', { message, remedy: 'Check your connection, then choose the model again.', cause });
}
