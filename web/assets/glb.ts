import type { Document, Extension } from '@gltf-transform/core';
import { object, options as readOptions } from '../../wasm/ts/arguments.ts';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { BodyData } from '../../wasm/ts/types.ts';
import { GLTF_READERS, gltfDocument, WRITE_READERS } from './given.ts';
import { isGlb } from './glb-chunks.ts';
import { createIo, type IoOptions } from './io.ts';
import { refuseOther } from './look-alikes.ts';
import { type GlbMesh, meshDocument } from './mesh-document.ts';
import { openGltf } from './open-gltf.ts';
import { type FileBytes, ownBytes } from './to-bytes.ts';
import { type ReadGltfOptions, toDocument } from './to-document.ts';
import { attachBody } from './write-body.ts';

/** They compress again, for which they need an encoder: only for those who register them. */
const COMPRESSIONS = ['KHR_draco_mesh_compression', 'EXT_meshopt_compression'];

/**
 * Reads a GLB into a glTF-Transform document. The bytes are copied. Safe on hostile input: it gives a document or throws a
 * `HandlebodyError` ('file-not-glb', 'file-truncated', 'file-invalid', 'file-unsupported', 'file-unreadable', 'mesh-too-large').
 *
 * Data compressed by meshopt is decoded, and plain from then on; so is Draco's with the option `draco`. Extensions that glTF-Transform
 * knows are kept, and unknown ones as far as they point at nothing by number; `onWarning` is told what was decompressed or gets lost.
 * Buffers and images outside the file come through the option `resource`; without it the first are refused, the others stay outside.
 *
 * ```ts
 * const document = await readGlb(new Uint8Array(await file.arrayBuffer()));
 * const { mesh } = readMesh(document);
 * ```
 */
export async function readGlb(bytes: FileBytes, options: ReadGltfOptions = {}): Promise<Document> {
  const glb = ownBytes(bytes);
  readOptions(options, GLTF_READERS);
  if (!isGlb(glb)) throw refuseOther(glb);
  return toDocument(await openGltf(glb, options), options);
}

export interface WriteMeshOptions extends IoOptions {
  /** Of the node and the mesh. */
  readonly name?: string;
  /** What was baked for this mesh. */
  readonly body?: BodyData;
}

/**
 * Writes a document as GLB, or a mesh of typed arrays with or without what was baked for it; byte for byte the same each time.
 *
 * Rejects with 'file-unsupported' naming an image that was not read with the document; of a mesh with what `meshDocument` and, with a
 * body, `attachBody` throw.
 *
 * ```ts
 * const mesh = readObj(bytes);
 * await writeFile('cow.glb', await writeGlb(mesh, { body: await hb.bake(mesh) }));
 * ```
 */
export function writeGlb(document: Document, options?: IoOptions): Promise<Uint8Array>;
export function writeGlb(mesh: GlbMesh, options?: WriteMeshOptions): Promise<Uint8Array>;
export async function writeGlb(from: Document | GlbMesh, options: WriteMeshOptions = {}): Promise<Uint8Array> {
  readOptions(options, WRITE_READERS);
  const mesh = object(from, 'document', 'Give a document of glTF-Transform, or { positions, triangles }.');
  const document = 'positions' in mesh ? meshDocument(from as GlbMesh, options.name) : gltfDocument(from, 'document');
  if (document !== from && options.body) await attachBody(document, options.body);
  checkTextures(document);
  const used = document.getRoot().listExtensionsUsed();
  const own = used.map((extension) => extension.constructor as typeof Extension);
  const extensions = [...own.filter(({ EXTENSION_NAME }) => !COMPRESSIONS.includes(EXTENSION_NAME)), ...(options.extensions ?? [])];
  const io = createIo({ extensions });
  // glTF-Transform would write the fractions that normalized numbers mean as if they were the numbers.
  const sparse = document
    .getRoot()
    .listAccessors()
    .filter((accessor) => accessor.getSparse() && accessor.getNormalized());
  for (const accessor of sparse) accessor.setSparse(false);
  try {
    return await io.writeBinary(document);
  } catch (cause) {
    if (cause instanceof HandlebodyError) throw cause;
    throw new HandlebodyError('file-invalid', {
      message: `The document cannot be written as glTF: ${cause instanceof Error ? cause.message : String(cause)}.`,
      remedy: 'Something in it, a color or a number perhaps, is not of its type: read the model anew from a sound file.',
      cause,
    });
  } finally {
    for (const accessor of sparse) accessor.setSparse(true);
  }
}

/** A GLB holds its images: one that is only a name would be neither inside nor named. */
function checkTextures(document: Document): void {
  const missing = document
    .getRoot()
    .listTextures()
    .find((texture) => !texture.getImage());
  if (!missing) return;
  const name = missing.getURI() || missing.getName();
  throw new HandlebodyError('file-unsupported', {
    message: `The image${name ? ` "${name.slice(0, 80)}"` : ''} lies outside the model and was not read with it, so it cannot be written into a GLB.`,
    remedy: 'Give its files along when reading (the option "resource"), or take the texture out of its materials.',
  });
}
