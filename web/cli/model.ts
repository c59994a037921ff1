/** Models of any format that the command reads, as glTF documents, and how they are written. */
import path from 'node:path';
import type { Document } from '@gltf-transform/core';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { meshDocument, readGlb, readGltf, readObj, readPly, writeGlb } from '../assets/index.ts';
import { looksLikeGltf } from '../assets/open-unusual.ts';
import { filesBeside } from './files-beside.ts';
import type { Report } from './report.ts';

type ModelFormat = 'GLB' | 'glTF' | 'OBJ' | 'PLY';

interface Model {
  readonly document: Document;
  readonly format: ModelFormat;
}

/** By its first bytes, or by its name for OBJ, which has no mark. */
export function formatOf(bytes: Uint8Array, name: string): ModelFormat {
  const head = String.fromCharCode(...bytes.subarray(0, 4));
  if (head === 'glTF') return 'GLB';
  if (/^ply[\r\n]/.test(head)) return 'PLY';
  if (/\.gltf$/i.test(name) || looksLikeGltf(bytes)) return 'glTF';
  return /\.obj$/i.test(name) ? 'OBJ' : /\.ply$/i.test(name) ? 'PLY' : 'GLB';
}

/**
 * Reads a model, with the files that it names and that lie beside it; `report` is warned of what was changed or gets lost. With `pictures`
 * 'optional', for who only looks at a model, an image that is missing is a warning.
 *
 * Throws 'file-*' errors that name the file.
 */
export async function readModel(
  bytes: Uint8Array,
  name: string,
  report?: Report,
  { pictures = 'needed' }: { pictures?: 'needed' | 'optional' } = {},
): Promise<Model> {
  const format = formatOf(bytes, name);
  try {
    if (format === 'OBJ' || format === 'PLY') {
      const mesh = format === 'OBJ' ? readObj(bytes) : readPly(bytes);
      for (const message of mesh.warnings) report?.warn({ code: 'left-out', message });
      return { document: meshDocument(mesh, path.basename(name, path.extname(name))), format };
    }
    const onMissingPicture = pictures === 'needed' ? undefined : (error: HandlebodyError) => report?.warn(error);
    const options = {
      resource: filesBeside(name, onMissingPicture),
      onWarning: (warning: { code: string; message: string; remedy: string }) => report?.warn(warning),
    };
    return { document: await (format === 'GLB' ? readGlb : readGltf)(bytes, options), format };
  } catch (error) {
    throw naming(name, error);
  }
}

/** The document as GLB, byte for byte the same each time. */
export function modelBytes(document: Document): Promise<Uint8Array> {
  return writeGlb(document);
}

/** An error of reading a file, with the file's name before it. */
export function naming(name: string, error: unknown): unknown {
  if (!(error instanceof HandlebodyError) || error.message.includes(name)) return error;
  const { code, message, remedy, culprit } = error;
  return new HandlebodyError(code, { message: `"${name}": ${message}`, remedy, culprit, cause: error });
}
