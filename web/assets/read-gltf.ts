import type { Document } from '@gltf-transform/core';
import { options as readOptions } from '../../wasm/ts/arguments.ts';
import { GLTF_READERS } from './given.ts';
import { openGltf } from './open-gltf.ts';
import { type FileBytes, ownBytes } from './to-bytes.ts';
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
 * const files = new Map([['cow.bin', new Uint8Array(36)]]); // by their names, from a disk, an upload, a fetch
 * const resource = async (uri: string) => files.get(uri);
 * const json = { asset: { version: '2.0' }, buffers: [{ uri: 'cow.bin', byteLength: 36 }] };
 * const document = await readGltf(new TextEncoder().encode(JSON.stringify(json)), { resource });
 * await writeFile('cow.glb', await writeGlb(document)); // everything inside
 * ```
 */
export async function readGltf(bytes: FileBytes, options: ReadGltfOptions = {}): Promise<Document> {
  const file = ownBytes(bytes);
  readOptions(options, GLTF_READERS);
  return toDocument(await openGltf(file, options), options);
}
