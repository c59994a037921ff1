/** A GLB that is whole in itself, checked; and what files are that are none. */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { checkGltf } from './check-gltf.ts';
import { isGlb, splitGlb, truncated } from './glb-chunks.ts';
import type { GltfJson } from './gltf-json.ts';
import { type FileBytes, toBytes } from './to-bytes.ts';

/** What files look like that people drop by mistake, by their first characters. */
const LOOK_ALIKES: readonly (readonly [RegExp, string, string])[] = [
  [/^\s*\{/, 'a .gltf in text form', 'Read it with readGltf, which takes its files too, or export it as one binary .glb file.'],
  [/^\s*</, 'a web page or XML, perhaps an error page saved under this name', 'Download the model again and look at what arrives.'],
  [/^\x89PNG/, 'a PNG picture', 'Give a .glb model.'],
  [/^\xff\xd8\xff/, 'a JPEG picture', 'Give a .glb model.'],
  [/^PK/, 'a ZIP archive (USDZ and .blend exports are such)', 'Unpack it, or export the model as .glb.'],
  [/^Kaydara FBX/, 'an FBX model', 'Export it as .glb, for instance with Blender.'],
  [/^BLENDER/, 'a Blender scene', 'Export it from Blender as .glb.'],
  [/^version https:\/\/git-lfs/, 'a Git LFS pointer, not the model itself', 'Run "git lfs pull".'],
  [/^ply\s/, 'a PLY model', 'Name it .ply, or convert it to .glb.'],
  [/^solid\s/, 'an STL model', 'Convert it to .glb.'],
  [/^(#|mtllib|o |g |v )/, 'an OBJ model', 'Name it .obj, or convert it to .glb.'],
];

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
  checkMagic(glb);
  const { json, bin, binStart, length } = splitGlb(glb);
  return { json: checkGltf(json, { binLength: bin?.length, jsonStart: 20, binStart, fileLength: length }), bin };
}

/** Throws 'file-not-glb', saying what the bytes look like, or 'file-truncated'. */
export function checkMagic(bytes: Uint8Array): void {
  if (isGlb(bytes)) return;
  if (bytes.length === 0) {
    throw new HandlebodyError('file-not-glb', { message: 'The file is empty.', remedy: 'Download or export it again.' });
  }
  const head = String.fromCharCode(...bytes.subarray(0, 64));
  if (bytes.length < 4 && 'glTF'.startsWith(head)) throw truncated(`ends after ${bytes.length} bytes`, bytes.length);
  const [, what, remedy] = LOOK_ALIKES.find(([pattern]) => pattern.test(head.replace(/^\xef\xbb\xbf/, ''))) ?? [];
  throw new HandlebodyError('file-not-glb', {
    message: what ? `The file is not a GLB: it looks like ${what}.` : 'The file is not a GLB: its first bytes are not "glTF".',
    remedy: remedy ?? 'Export the model as .glb (binary glTF 2.0).',
    culprit: { kind: 'byte', index: 0 },
  });
}
