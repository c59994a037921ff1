/** Models of any format that the command reads, as glTF documents, and how they are written. */
import path from 'node:path';
import type { Document, Extension } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { checkGlb } from '../assets/check-glb.ts';
import { type FileFormat, fileFormat } from '../assets/file-format.ts';
import {
  HANDLEBODY_BODY,
  HANDLEBODY_POSE_SPACE,
  meshDocument,
  type ReadOptions,
  readGlb,
  readObj,
  readOff,
  readPly,
  readStl,
  writeGlb,
} from '../assets/index.ts';
import type { Report } from './report.ts';

/** Those whose data glTF-Transform cannot read without a decoder. */
const COMPRESSIONS = ['KHR_draco_mesh_compression', 'EXT_meshopt_compression'];

/** Extensions that pass through unharmed. */
const EXTENSIONS = (ALL_EXTENSIONS as (typeof Extension)[]).filter(({ EXTENSION_NAME }) => !COMPRESSIONS.includes(EXTENSION_NAME));

interface Model {
  readonly document: Document;
  readonly format: FileFormat;
}

/** Readers of the formats that hold a mesh and nothing else. */
const MESH_READERS = { OBJ: readObj, PLY: readPly, STL: readStl, OFF: readOff };

/** Reads a model; `report`, where it will be written again, is warned of what will be lost. Throws 'file-*' errors that name the file. */
export async function readModel(bytes: Uint8Array, name: string, report?: Report, options?: ReadOptions): Promise<Model> {
  const format = fileFormat(bytes, name);
  try {
    if (format !== 'GLB') {
      const mesh = MESH_READERS[format](bytes, options);
      for (const { code, message, remedy } of mesh.warnings) report?.warn({ code, message, remedy });
      return { document: meshDocument(mesh, path.basename(name, path.extname(name))), format };
    }
    if (report) warnOfLost(bytes, report);
    const document = await readGlb(bytes, { extensions: EXTENSIONS });
    joinBuffers(document);
    return { document, format };
  } catch (error) {
    throw naming(name, error);
  }
}

/** The document as GLB, byte for byte the same each time. */
export function modelBytes(document: Document): Promise<Uint8Array> {
  return writeGlb(document, { extensions: EXTENSIONS });
}

/** An error of reading a file, with the file's name before it. */
export function naming(name: string, error: unknown): unknown {
  if (!(error instanceof HandlebodyError) || error.message.includes(name)) return error;
  const { code, message, remedy, culprit } = error;
  return new HandlebodyError(code, { message: `"${name}": ${message}`, remedy, culprit, cause: error });
}

function warnOfLost(bytes: Uint8Array, report: Report): void {
  const known = [...EXTENSIONS.map(({ EXTENSION_NAME }) => EXTENSION_NAME), HANDLEBODY_BODY, HANDLEBODY_POSE_SPACE];
  const used = (checkGlb(bytes).json.extensionsUsed ?? []) as readonly string[];
  const lost = used.filter((name) => !known.includes(name));
  if (lost.length === 0) return;
  report.warn({
    code: 'extension-lost',
    message: `What the model says in ${lost.join(', ')} is not known here and gets lost.`,
    remedy: 'Apply such extensions after baking, if they leave the vertices alone.',
  });
}

/** A GLB has one buffer: what other ones hold moves into it. */
function joinBuffers(document: Document): void {
  const [first, ...others] = document.getRoot().listBuffers();
  if (!first || others.length === 0) return;
  for (const accessor of document.getRoot().listAccessors()) accessor.setBuffer(first);
  for (const buffer of others) buffer.dispose();
}
