import type { Accessor, Document } from '@gltf-transform/core';
import type { BodyData } from '../../wasm/ts/types.ts';
import type { BodyProperty } from './body-extension.ts';
import { readMesh } from './read-mesh.ts';
import { assembleBody, type BodyArrays, HANDLEBODY_BODY, parseBodyHeader } from './schema.ts';

/**
 * The baked body of a document, or undefined when it has none. Its mesh is `readMesh(document).mesh`.
 *
 * Throws 'body-version', 'body-invalid' or 'body-mismatch', and what `readMesh` throws.
 *
 * ```ts
 * const body = readBody(await readGlb(bytes));
 * if (body) hb.irbf(body).setHandles([{ vertex: 120 }]);
 * ```
 */
export function readBody(document: Document): BodyData | undefined {
  const property = document.getRoot().getExtension<BodyProperty>(HANDLEBODY_BODY);
  if (!property) return undefined;
  const header = parseBodyHeader(property.getHeader());
  const array = (accessor: Accessor | null) => accessor?.getArray()?.slice();
  const arrays = {
    voxels: array(property.getAccessor('voxels')),
    centers: array(property.getAccessor('centers')),
    distances: array(property.getAccessor('distances')),
    spheres: array(property.getAccessor('spheres')),
  };
  return assembleBody({ header, arrays: arrays as unknown as BodyArrays, mesh: readMesh(document).mesh });
}
