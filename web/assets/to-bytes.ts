import { HandlebodyError } from '../../wasm/ts/errors.ts';

/** A file's bytes: a buffer, or any view of one (a typed array, a `DataView`, Node's `Buffer`), of which the part that it shows counts. */
export type FileBytes = ArrayBufferLike | ArrayBufferView;

/** What people give instead, and how it becomes bytes. */
const REMEDIES: Record<string, string> = {
  string: 'Give its bytes: new TextEncoder().encode(text), or what fetch(…).arrayBuffer() and readFile(…) give.',
  Blob: 'Give await blob.arrayBuffer().',
  File: 'Give await file.arrayBuffer().',
  Response: 'Give await response.arrayBuffer().',
  Promise: 'Await it first.',
  Array: 'Give Uint8Array.from(array).',
};

/**
 * The bytes of a file, without a copy where the memory is the caller's alone. Bytes that other threads may write are copied, so that they
 * do not change while they are read.
 *
 * Throws 'file-not-bytes' for anything else, naming what it is.
 */
export function toBytes(given: unknown): Uint8Array {
  try {
    return viewOf(given);
  } catch (cause) {
    if (!(cause instanceof TypeError)) throw cause;
    // A view of memory that is gone cannot even be made.
    throw new HandlebodyError('file-not-bytes', {
      message: 'The file’s bytes were handed to another thread, and are here no more.',
      remedy: 'Read the file again, or hand a copy over.',
      cause,
    });
  }
}

/** The same in memory of its own, for whoever lets others have a turn before all is read. */
export function ownBytes(given: unknown): Uint8Array {
  return toBytes(given).slice();
}

function viewOf(given: unknown): Uint8Array {
  // By its name: a buffer of another window is no instance of this one's class.
  const kind = Object.prototype.toString.call(given).slice(8, -1);
  if (ArrayBuffer.isView(given)) {
    const bytes = new Uint8Array(given.buffer, given.byteOffset, given.byteLength);
    return isShared(given.buffer) ? bytes.slice() : bytes;
  }
  if (kind === 'ArrayBuffer') return new Uint8Array(given as ArrayBuffer);
  if (kind === 'SharedArrayBuffer') return new Uint8Array(given as SharedArrayBuffer).slice();
  const name = typeof given === 'string' ? 'string' : kind;
  throw new HandlebodyError('file-not-bytes', {
    message: `The "bytes" of a file are wanted, and ${describe(given, name)} is given.`,
    remedy: REMEDIES[name] ?? 'Give an ArrayBuffer, a typed array, a DataView or a Buffer.',
  });
}

const isShared = (buffer: ArrayBufferLike) => Object.prototype.toString.call(buffer) === '[object SharedArrayBuffer]';

function describe(given: unknown, name: string): string {
  if (given === null || given === undefined) return String(given);
  return `${/^[aeiou]/i.test(name) ? 'an' : 'a'} ${name}`;
}
