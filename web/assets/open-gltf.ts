/** Opening a glTF of any kind: what has everything inside and plain is only checked; the rest is made so by code that is loaded for it. */
import type { GlbParts } from './check-glb.ts';
import { inWords } from './fault.ts';
import { isGlb, splitGlb } from './glb-chunks.ts';
import type { GltfReadOptions } from './gltf-warnings.ts';
import { verifyGltf } from './verify-gltf.ts';

/** Names by which a file may say that data lies elsewhere or is compressed. A wrong guess costs time alone. */
const UNUSUAL = /"uri"|meshopt_compression/;

/** A GLB, or the text of a .gltf. Throws what `checkGlb` and `plainGltf` throw. */
export async function openGltf(bytes: Uint8Array, options?: GltfReadOptions): Promise<GlbParts> {
  return (await inWords(() => openUsual(bytes))) ?? (await import('./open-unusual.ts')).openUnusual(bytes, options);
}

/** The same as the bytes of a GLB that is whole and plain: those given, where they are so already. */
export async function openAsGlb(bytes: Uint8Array, options?: GltfReadOptions): Promise<Uint8Array> {
  if (await inWords(() => openUsual(bytes))) return bytes;
  const { openUnusual, packGlb } = await import('./open-unusual.ts');
  return packGlb(await openUnusual(bytes, options));
}

function openUsual(bytes: Uint8Array): GlbParts | undefined {
  if (!isGlb(bytes)) return undefined;
  const { json, text, bin, binStart, length } = splitGlb(bytes);
  if (UNUSUAL.test(text)) return undefined;
  return { json: verifyGltf(json, { binLength: bin?.length, jsonStart: 20, binStart, fileLength: length }), bin };
}
