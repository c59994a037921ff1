/** Models of any format that the command reads, as glTF documents, and how they are written. */
import path from 'node:path';
import type { Document } from '@gltf-transform/core';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { type FileFormat, fileFormat } from '../assets/file-format.ts';
import { meshDocument, readGlb, readGltf, readObj, readOff, readPly, readStl, writeGlb } from '../assets/index.ts';
import { filesBeside } from './files-beside.ts';
import type { Report } from './report.ts';

interface Model {
  readonly document: Document;
  readonly format: FileFormat;
}

interface ModelOptions {
  /** 'optional', for who only looks at a model: an image that is missing is a warning. */
  readonly pictures?: 'needed' | 'optional';
  /** Refuses what readers of OBJ, PLY, STL and OFF pass over otherwise. */
  readonly strict?: boolean;
  /** Whether the model is baked next: of flat and doubled triangles the bake tells what it makes of them. */
  readonly baked?: boolean;
}

const TOLD_BY_BAKE: readonly string[] = ['triangles-flat', 'triangles-doubled'];

/** Readers of the formats that hold a mesh and nothing else. */
const MESH_READERS = { OBJ: readObj, PLY: readPly, STL: readStl, OFF: readOff };

/**
 * Reads a model, with the files that it names and that lie beside it; `report` is warned of what was passed over, was changed or gets
 * lost. Throws 'file-*' errors that name the file.
 */
export async function readModel(
  bytes: Uint8Array,
  name: string,
  report?: Report,
  { pictures = 'needed', strict = false, baked = false }: ModelOptions = {},
): Promise<Model> {
  const format = fileFormat(bytes, name);
  try {
    if (format !== 'GLB' && format !== 'glTF') {
      const mesh = MESH_READERS[format](bytes, { strict });
      for (const { code, message, remedy } of mesh.warnings)
        if (!(baked && TOLD_BY_BAKE.includes(code))) report?.warn({ code, message, remedy });
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
