/** Reading inputs whole and writing outputs whole or not at all. */
import { randomUUID } from 'node:crypto';
import {
  accessSync,
  closeSync,
  constants,
  fchmodSync,
  fsyncSync,
  lstatSync,
  openSync,
  readlinkSync,
  realpathSync,
  renameSync,
  rmSync,
  type Stats,
  statSync,
  writeFileSync,
  writeSync,
} from 'node:fs';
import { readFile, stat } from 'node:fs/promises';
import path from 'node:path';
import { setImmediate } from 'node:timers/promises';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { usageError } from './arguments.ts';
import { isStandardInput, isStandardOutput } from './special-files.ts';

/** Throws 'file-unreadable'. */
export async function readInput(file: string): Promise<Uint8Array> {
  try {
    if (isStandardInput(file)) return await readStandardInput();
    // One may give bytes for ever.
    if ((await stat(file)).isCharacterDevice()) throw new Error('it is a device');
    return await readFile(file);
  } catch (cause) {
    if (cause instanceof HandlebodyError) throw cause;
    throw new HandlebodyError('file-unreadable', {
      message: `"${file}" cannot be read: ${reason(cause)}.`,
      remedy: 'Check its name, and that you may read it.',
      cause,
    });
  }
}

/** Of standard input, which may never end; files tell their length. */
const MOST_INPUT = 2 ** 30;

async function readStandardInput(): Promise<Uint8Array> {
  if (process.stdin.isTTY)
    throw usageError('Standard input is a terminal, and a model is not typed.', 'Give a file, or send one in: < MODEL.glb.');
  const chunks: Buffer[] = [];
  let length = 0;
  for await (const chunk of process.stdin) {
    length += chunks[chunks.push(chunk as Buffer) - 1]?.length ?? 0;
    if (length > MOST_INPUT) throw new Error(`it has more than ${MOST_INPUT / 2 ** 20} MiB`);
  }
  return Buffer.concat(chunks);
}

/** A place to write to, looked at before the work begins. */
interface Output {
  readonly name: string;
  /** Where symbolic links lead; undefined for standard output. */
  readonly file: string | undefined;
  readonly before: Stats | undefined;
}

/**
 * Checks that an output can be written: its folder is there, and it is none of the inputs unless `force` says so. An older output is
 * replaced. Throws 'usage' or 'output-unwritable'.
 */
export function prepareOutput(name: string, { inputs, force }: { inputs: readonly string[]; force: boolean }): Output {
  if (isStandardOutput(name)) {
    if (process.stdout.isTTY) throw unwritable(name, 'standard output is a terminal, and a model is not text');
    return { name, file: undefined, before: undefined };
  }
  try {
    const before = statSync(name, { throwIfNoEntry: false });
    const input = before && inputs.find((other) => isSame(before, other));
    if (input !== undefined && !force) {
      throw usageError(
        `The output "${name}" is the input "${input}" itself.`,
        'Give another name after -o, or add --force to replace it.',
      );
    }
    if (before?.isDirectory()) throw unwritable(name, 'it is a folder');
    // A pipe's place in /proc has no path that could be opened again.
    const file = before ? (before.isFile() ? realpathSync(name) : path.resolve(name)) : endOfLinks(path.resolve(name));
    accessSync(before && !before.isFile() ? file : path.dirname(file), constants.W_OK);
    return { name, file, before };
  } catch (cause) {
    throw cause instanceof HandlebodyError ? cause : unwritable(name, reason(cause), cause);
  }
}

/**
 * Writes an output: to a file beside it, which then takes its name. Nothing else runs in between, so that a signal finds either the old
 * file or the new one; one that came during the work is heard first. Throws 'output-unwritable'.
 */
export async function writeOutput(output: Output, bytes: Uint8Array, signal: AbortSignal): Promise<void> {
  await setImmediate();
  signal.throwIfAborted();
  if (output.file === undefined) await writeStandardOutput(output.name, bytes);
  else replaceFile({ ...output, file: output.file }, bytes);
}

function writeStandardOutput(name: string, bytes: Uint8Array): Promise<void> {
  return new Promise((resolve, reject) => {
    process.stdout.write(bytes, (cause) => (cause ? reject(unwritable(name, reason(cause), cause)) : resolve()));
  });
}

/** Where links lead that end nowhere yet: the file that is to be made. The system has refused circles before. */
function endOfLinks(file: string): string {
  if (!lstatSync(file, { throwIfNoEntry: false })?.isSymbolicLink()) return file;
  return endOfLinks(path.resolve(realpathSync(path.dirname(file)), readlinkSync(file)));
}

function replaceFile({ name, file, before }: Output & { readonly file: string }, bytes: Uint8Array): void {
  // A device or a pipe has no name to take.
  if (before && !before.isFile()) {
    try {
      writeFileSync(file, bytes);
      return;
    } catch (cause) {
      throw unwritable(name, reason(cause), cause);
    }
  }
  // Not from the file's own name, which may be as long as a name can be.
  const temporary = path.join(path.dirname(file), `.handlebody-${randomUUID()}.tmp`);
  try {
    const descriptor = openSync(temporary, 'wx');
    try {
      if (before) fchmodSync(descriptor, before.mode & 0o777);
      for (let at = 0; at < bytes.length; ) at += writeSync(descriptor, bytes, at);
      fsyncSync(descriptor);
    } finally {
      closeSync(descriptor);
    }
    renameSync(temporary, file);
  } catch (cause) {
    rmSync(temporary, { force: true });
    throw unwritable(name, reason(cause), cause);
  }
}

/** An input that cannot be looked at cannot be the output either; reading it says what is wrong. */
function isSame(a: Stats, file: string): boolean {
  try {
    const b = statSync(file);
    return a.dev === b.dev && a.ino === b.ino;
  } catch {
    return false;
  }
}

/** As messages call it where it was not named as an output. */
export const STANDARD_OUTPUT = 'standard output';

export function unwritable(name: string, why: string, cause?: unknown): HandlebodyError {
  return new HandlebodyError('output-unwritable', {
    message: `"${name}" cannot be written: ${why}.`,
    remedy:
      name === STANDARD_OUTPUT
        ? 'Send what is printed to a place with room for it, or leave it on the terminal.'
        : 'Give another place after -o: a folder that is there, has room and that you may write to.',
    cause,
  });
}

/** The system's own words for what people meet, the error's otherwise. */
export function reason(cause: unknown): string {
  const { code, message } = cause as NodeJS.ErrnoException;
  const known: Record<string, string> = {
    ENOENT: 'there is no such file or folder',
    ENOTDIR: 'a part of its path is no folder',
    EISDIR: 'it is a folder',
    EACCES: 'permission is denied',
    EPERM: 'permission is denied',
    EROFS: 'its file system is read-only',
    ENOSPC: 'the disk is full',
    EFBIG: 'it is too large',
    ENAMETOOLONG: 'its name is too long',
    ELOOP: 'its links lead round in a circle',
    EPIPE: 'its reader is gone',
    ERR_FS_FILE_TOO_LARGE: 'it has more than 2 GiB',
  };
  return known[code ?? ''] ?? message;
}
