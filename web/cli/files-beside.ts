/** The files that a model names and that lie beside it: nothing outside its folder is opened on a model's word. */
import { readFile, stat } from 'node:fs/promises';
import path from 'node:path';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { reason } from './files.ts';

/**
 * A `resource` for readers. An image that is not there is told to `onMissingPicture`, where that is given, and left outside.
 *
 * It throws 'file-unsupported' for names that leave the model's folder, 'file-unreadable' for what is not there.
 */
export function filesBeside(model: string, onMissingPicture?: (error: HandlebodyError) => void) {
  const folder = path.dirname(path.resolve(model));
  const missing = new Map<string, HandlebodyError>();
  return async (uri: string, kind: 'buffer' | 'image'): Promise<Uint8Array | undefined> => {
    const file = path.resolve(folder, uri);
    const steps = path.relative(folder, file);
    const leaves = steps === '' || steps.split(path.sep)[0] === '..' || path.isAbsolute(steps);
    if (leaves || path.isAbsolute(uri) || /^[a-z][a-z\d+.-]*:/i.test(uri) || uri.includes('\\') || uri.includes('\0'))
      throw outside(uri, kind);
    try {
      if (!(await stat(file)).isFile()) throw new Error('it is no file');
      return await readFile(file);
    } catch (cause) {
      const error = unreadable(uri, kind, cause);
      if (kind === 'buffer' || !onMissingPicture) throw error;
      if (!missing.has(uri)) onMissingPicture(error);
      missing.set(uri, error);
      return undefined;
    }
  };
}

function outside(uri: string, kind: string): HandlebodyError {
  return new HandlebodyError('file-unsupported', {
    message: `The model wants the ${kind} "${uri.slice(0, 80)}", which does not lie in its own folder, and only files there are read.`,
    remedy: 'Put the file beside the model and change its name there, or export the model as one .glb with everything inside.',
  });
}

function unreadable(uri: string, kind: string, cause: unknown): HandlebodyError {
  return new HandlebodyError('file-unreadable', {
    message: `The model needs the ${kind} "${uri.slice(0, 80)}" beside it, which cannot be read: ${reason(cause)}.`,
    remedy: 'Put the file beside the model, or export the model as one .glb with everything inside.',
    cause,
  });
}
