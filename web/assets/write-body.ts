import type { Document } from '@gltf-transform/core';
import type { BodyData } from '../../wasm/ts/types.ts';
import { type BodyAccessorName, BodyExtension, type BodyProperty } from './body-extension.ts';
import { readMesh } from './read-mesh.ts';
import { assembleBody, BODY_ACCESSORS, HANDLEBODY_BODY, parseBodyHeader } from './schema.ts';

/**
 * Puts a baked body into a document, in place of one that is there. Attach it last: whatever moves, adds or reorders vertices afterwards
 * makes it worthless, and reading it then throws 'body-mismatch'. The sphere coordinates are stored as floats, all else exactly.
 *
 * Throws 'body-mismatch' when the body was not baked for this document, 'body-invalid' when its arrays contradict each other.
 *
 * ```ts
 * const document = await readGlb(bytes);
 * attachBody(document, await hb.bake(readMesh(document).mesh));
 * await writeFile('body.glb', await writeGlb(document));
 * ```
 */
export function attachBody(document: Document, body: BodyData): BodyProperty {
  const { mesh } = readMesh(document);
  const { version, positionsHash, normalization, grid, distanceScale } = body;
  const header = parseBodyHeader({ version, positionsHash, normalization, grid, distanceScale });
  assembleBody({ header, arrays: body, mesh });

  detachBody(document);
  const root = document.getRoot();
  const buffer = root.listBuffers()[0] ?? document.createBuffer();
  const property = document.createExtension(BodyExtension).createBody().setHeader(header);
  for (const [name, { type, array }] of Object.entries(BODY_ACCESSORS)) {
    const accessor = document.createAccessor(`${HANDLEBODY_BODY}.${name}`, buffer).setType(type);
    property.setAccessor(name as BodyAccessorName, accessor.setArray(array.from(body[name as BodyAccessorName])));
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
  const property = document.getRoot().getExtension<BodyProperty>(HANDLEBODY_BODY);
  if (!property) return false;
  const accessors = Object.keys(BODY_ACCESSORS).map((name) => property.getAccessor(name as BodyAccessorName));
  property.dispose();
  // A pipeline that removes duplicates may have given an accessor a second use.
  for (const accessor of accessors)
    if (accessor?.listParents().every((parent) => parent === document.getRoot())) accessor.dispose();
  return true;
}
