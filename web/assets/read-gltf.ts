import type { Document } from '@gltf-transform/core';
import { openGltf } from './open-gltf.ts';
import { type FileBytes, toBytes } from './to-bytes.ts';
import { type ReadGltfOptions, toDocument } from './to-document.ts';

/**
 * Reads a .gltf into a glTF-Transform document, with the files that it names, or with its data in data URIs; a GLB is read, too. The
 * document is as if everything lay in one GLB: `writeGlb` writes it so. What `resource` gives is checked before anything else is
 * allocated, and a file that is shorter than the model says is 'file-truncated'. Percent signs in names are decoded first.
 *
 * Which files `resource` may reach is its own affair: names like "../secret" and "file:///…" are passed on as they are.
 *
 * Rejects as `readGlb` does, and with 'file-unreadable' naming a file that is missing.
 *
 * ```ts
 * const files = new Map([...input.files ?? []].map((file) => [file.name, file]));
 * const resource = async (uri: string) => files.get(uri)?.arrayBuffer();
 * const document = await readGltf(await files.get('cow.gltf')!.arrayBuffer(), { resource });
 * const { mesh } = readMesh(document);
 * ```
 */
export async function readGltf(bytes: FileBytes, options: ReadGltfOptions = {}): Promise<Document> {
  return toDocument(await openGltf(toBytes(bytes), options), options);
}
