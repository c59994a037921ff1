/** A GLB that is whole in itself, checked. */
import { checkGltf } from './check-gltf.ts';
import { isGlb, splitGlb } from './glb-chunks.ts';
import type { GltfJson } from './gltf-json.ts';
import { refuseOther } from './look-alikes.ts';
import { type FileBytes, toBytes } from './to-bytes.ts';
import { inWordsAtOnce } from './words-at-once.ts';

/** A GLB taken apart: its JSON, checked, and its binary chunk, a view into the bytes given. */
export interface GlbParts {
  readonly json: GltfJson;
  readonly bin: Uint8Array | undefined;
}

/**
 * Checks that bytes are a sound GLB (container, JSON, and that nothing in it points outside the file or runs in circles), and takes it
 * apart. Allocates nothing that the file's own size does not justify.
 *
 * Throws 'file-not-glb' (naming what it looks like), 'file-truncated', 'file-unsupported', 'mesh-too-large' or 'file-invalid'; the
 * culprit is a byte of the file where one can be named.
 *
 * ```ts
 * const { json } = checkGlb(new Uint8Array(await file.arrayBuffer()));
 * console.log(json.asset);
 * ```
 */
export function checkGlb(bytes: FileBytes): GlbParts {
  const glb = toBytes(bytes);
  if (!isGlb(glb)) throw refuseOther(glb);
  const { json, bin, binStart, length } = inWordsAtOnce(() => splitGlb(glb));
  return { json: checkGltf(json, { binLength: bin?.length, jsonStart: 20, binStart, fileLength: length }), bin };
}
