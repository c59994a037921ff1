/** Run by Node and by Chromium alike: see baked-bytes.test.ts. */
import { load } from '../../../wasm/ts/index.ts';
import type { BakeOptions } from '../../../wasm/ts/types.ts';
import { attachBody, detachBody, readGlb, readMesh, writeGlb } from '../../../web/assets/index.ts';

/** Bakes a GLB anew. */
export async function bakeGlb(glb: Uint8Array, options: BakeOptions): Promise<Uint8Array> {
  const document = await readGlb(glb);
  detachBody(document);
  await attachBody(document, await (await load()).bake(readMesh(document).mesh, options));
  return writeGlb(document);
}
