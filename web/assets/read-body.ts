import type { Document } from '@gltf-transform/core';
import type { BodyData } from '../../wasm/ts/types.ts';
import { decodeBody } from './body-codec.ts';
import type { BodyAccessorName, BodyProperty } from './body-extension.ts';
import { inWords } from './fault.ts';
import { gltfDocument } from './given.ts';
import { readMesh } from './read-mesh.ts';
import { BODY_ACCESSORS, HANDLEBODY_BODY, parseStoredHeader, type StoredArrays } from './schema.ts';

/**
 * The baked body of a document, or undefined when it has none. Its mesh is `readMesh(document).mesh`, read by the choices of the bake. Decompressing takes some
 * milliseconds a million distances.
 *
 * Rejects with 'body-version', 'body-invalid', 'body-mismatch' or 'wasm-unavailable', and what `readMesh` throws.
 *
 * ```ts
 * const body = await readBody(await readGlb(bytes));
 * if (body) hb.irbf(body).setHandles([{ vertex: 120 }]);
 * ```
 */
export async function readBody(document: Document): Promise<BodyData | undefined> {
  const property = gltfDocument(document, 'document').getRoot().getExtension<BodyProperty>(HANDLEBODY_BODY);
  if (!property) return undefined;
  const header = await inWords(() => parseStoredHeader(property.getHeader()));
  const names = Object.keys(BODY_ACCESSORS) as BodyAccessorName[];
  const arrays = Object.fromEntries(names.map((name) => [name, property.getAccessor(name)?.getArray()?.slice()]));
  return decodeBody({
    header,
    arrays: arrays as Partial<StoredArrays>,
    mesh: () => readMesh(document, { reading: header.reading ?? {} }).mesh,
  });
}
