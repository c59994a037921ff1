/** What files are that are no GLB. */
import { HandlebodyError } from '../../wasm/ts/errors.ts';

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

/** 'file-not-glb', saying what bytes look like that are no GLB, or 'file-truncated'. */
export function refuseOther(bytes: Uint8Array): HandlebodyError {
  if (bytes.length === 0) {
    return new HandlebodyError('file-not-glb', { message: 'The file is empty.', remedy: 'Download or export it again.' });
  }
  const head = String.fromCharCode(...bytes.subarray(0, 64));
  if (bytes.length < 4 && 'glTF'.startsWith(head)) {
    return new HandlebodyError('file-truncated', {
      message: `The file is cut off: it ends after ${bytes.length} bytes.`,
      remedy: 'Download or export it again.',
      culprit: { kind: 'byte', index: bytes.length },
    });
  }
  const [, what, remedy] = LOOK_ALIKES.find(([pattern]) => pattern.test(head.replace(/^\xef\xbb\xbf/, ''))) ?? [];
  return new HandlebodyError('file-not-glb', {
    message: what ? `The file is not a GLB: it looks like ${what}.` : 'The file is not a GLB: its first bytes are not "glTF".',
    remedy: remedy ?? 'Export the model as .glb (binary glTF 2.0).',
    culprit: { kind: 'byte', index: 0 },
  });
}
