import type { Document, TypedArray } from '@gltf-transform/core';
import { object } from '../../wasm/ts/arguments.ts';
import type { BodyData } from '../../wasm/ts/types.ts';
import { encodeBody } from './body-codec.ts';
import { type BodyAccessorName, BodyExtension, type BodyProperty } from './body-extension.ts';
import { gltfDocument } from './given.ts';
import { readMesh } from './read-mesh.ts';
import { BODY_ACCESSORS, checkBody, HANDLEBODY_BODY, headerOf } from './schema.ts';
import { inWordsAtOnce } from './words-at-once.ts';

/**
 * Puts a baked body into a document, in place of one that is there. Attach it last: whatever moves, adds or reorders vertices afterwards
 * makes it worthless, and reading it then fails with 'body-mismatch'. The sphere coordinates are stored as floats, all else exactly.
 *
 * It belongs to the document's root: `cloneDocument` of glTF-Transform copies it, `mergeDocuments` leaves it behind.
 *
 * Rejects with 'file-unsupported' for a document with EXT_mesh_gpu_instancing, whose copies a body cannot tell apart, with 'body-mismatch' when the body was not baked for this document, 'body-version' or 'body-invalid' when it is of another
 * format or its arrays contradict each other; the document is then as it was.
 *
 * ```ts
 * const document = await readGlb(bytes);
 * await attachBody(document, await hb.bake(readMesh(document).mesh));
 * await writeFile('body.glb', await writeGlb(document));
 * ```
 */
export async function attachBody(document: Document, body: BodyData): Promise<BodyProperty> {
  gltfDocument(document, 'document');
  const parts = object(body, 'body', 'Give what bake() made.');
  for (const part of ['mesh', 'normalization', 'grid']) object(parts[part], `body.${part}`, 'Give what bake() made.');
  const header = inWordsAtOnce(() => headerOf(body));
  const checked = { ...body, ...header, mesh: readMesh(document, { reading: header.reading ?? {} }).mesh };
  inWordsAtOnce(() => checkBody(checked));
  const { arrays, arraysHash } = await encodeBody(checked);

  detachBody(document);
  const root = document.getRoot();
  const buffer = root.listBuffers()[0] ?? document.createBuffer();
  const property = document
    .createExtension(BodyExtension)
    .createBody()
    .setHeader({ ...header, arraysHash });
  for (const [name, { type }] of Object.entries(BODY_ACCESSORS)) {
    if (!arrays[name as BodyAccessorName]) continue;
    const accessor = document.createAccessor(`${HANDLEBODY_BODY}.${name}`, buffer).setType(type);
    // None of them is shared between threads: the encoder made them, or the bake.
    const array = arrays[name as BodyAccessorName] as TypedArray;
    property.setAccessor(name as BodyAccessorName, accessor.setArray(array));
  }
  root.setExtension(HANDLEBODY_BODY, property);
  return property;
}

/**
 * Takes a document's body out, with its accessors. Returns whether there was one.
 *
 * ```ts
 * detachBody(document);
 * ```
 */
export function detachBody(document: Document): boolean {
  const property = gltfDocument(document, 'document').getRoot().getExtension<BodyProperty>(HANDLEBODY_BODY);
  if (!property) return false;
  const accessors = Object.keys(BODY_ACCESSORS).map((name) => property.getAccessor(name as BodyAccessorName));
  property.dispose();
  // A pipeline that removes duplicates may have given an accessor a second use.
  for (const accessor of accessors)
    if (accessor?.listParents().every((parent) => parent === document.getRoot())) accessor.dispose();
  document.disposeExtension(HANDLEBODY_BODY);
  return true;
}
