import { HandlebodyError } from '../../wasm/ts/errors.ts';

/** A file that a model names, among those that came with it: by its path where that is known, else by its name. */
export function besideIt(uri: string, model: File, files: readonly File[]): Promise<ArrayBuffer> {
  const last = (path: string) => path.slice(path.lastIndexOf('/') + 1);
  const folder = model.webkitRelativePath.slice(0, -model.name.length);
  const found =
    files.find((file) => file.webkitRelativePath === folder + uri.replace(/^\.\//, '')) ??
    files.find(({ name }) => name === last(uri));
  if (found) return found.arrayBuffer();
  throw new HandlebodyError('file-unreadable', {
    message: `The model needs the file “${uri.slice(0, 80)}”, which did not come with it.`,
    remedy: 'Choose or drop the model together with its files, or its whole folder.',
  });
}
