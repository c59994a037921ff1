/** Opening a glTF of any kind: what has everything inside and plain is only checked; the rest is made so by code that is loaded for it. */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { checkGlb, type GlbParts, splitGlb } from './check-glb.ts';
import { decodeText } from './decode-text.ts';
import type { GltfReadOptions } from './gltf-warnings.ts';

/** Names by which a file may say that data lies elsewhere or is compressed. A wrong guess costs time alone. */
const UNUSUAL = /"uri"|meshopt_compression/;

/** A GLB, or the text of a .gltf. Throws what `checkGlb` and `plainGltf` throw. */
export async function openGltf(bytes: Uint8Array, options: GltfReadOptions = {}): Promise<GlbParts> {
  if (looksLikeGltf(bytes)) return (await import('./plain-gltf.ts')).plainGltf({ json: parseGltf(bytes) }, options);
  if (!isUnusual(bytes)) return checkGlb(bytes);
  return (await import('./plain-gltf.ts')).plainGltf(splitGlb(bytes), options);
}

/** The same as the bytes of a GLB that is whole and plain: those given, where they are so already. */
export async function openAsGlb(bytes: Uint8Array, options: GltfReadOptions = {}): Promise<Uint8Array> {
  const parts = await openGltf(bytes, options);
  const isWhole = !looksLikeGltf(bytes) && !isUnusual(bytes);
  return isWhole ? bytes : (await import('./pack-glb.ts')).packGlb(parts);
}

/** Whether bytes are the text of a JSON object, in any of the encodings that editors write. */
export function looksLikeGltf(bytes: Uint8Array): boolean {
  return /^\s*\{/.test(decodeText(bytes.subarray(0, 64)));
}

/** Looks for the names in the JSON of a GLB. */
function isUnusual(bytes: Uint8Array): boolean {
  if (bytes.length < 20) return false;
  const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(12, true);
  return UNUSUAL.test(new TextDecoder().decode(bytes.subarray(20, 20 + length)));
}

function parseGltf(bytes: Uint8Array): unknown {
  const text = decodeText(bytes);
  try {
    return JSON.parse(text);
  } catch (cause) {
    const cut = /end of JSON|Unterminated|end of data/i.test(String(cause));
    throw new HandlebodyError(cut ? 'file-truncated' : 'file-invalid', {
      message: `The glTF ${cut ? 'is cut off' : 'is no JSON'}: ${cause instanceof Error ? cause.message : String(cause)}.`,
      remedy: cut ? 'Download or export it again.' : 'Export the model again; a glTF validator says more.',
      culprit: { kind: 'byte', index: Number(/position (\d+)/.exec(String(cause))?.[1] ?? 0) },
      cause,
    });
  }
}
