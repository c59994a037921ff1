/** Opening what is no plain GLB: a .gltf, data in other files or compressed, or no glTF at all. */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { GlbParts } from './check-glb.ts';
import { decodeText } from './decode-text.ts';
import { Fault, inWords } from './fault.ts';
import { isGlb, splitGlb } from './glb-chunks.ts';
import { isDeepText, MAX_DEPTH } from './gltf-json.ts';
import type { GltfReadOptions } from './gltf-warnings.ts';
import { refuseOther } from './look-alikes.ts';
import { plainGltf } from './plain-gltf.ts';

export { packGlb } from './pack-glb.ts';

/** Throws what `checkGlb` and `plainGltf` throw. */
export async function openUnusual(bytes: Uint8Array, options?: GltfReadOptions): Promise<GlbParts> {
  if (isGlb(bytes)) return plainGltf(await inWords(() => splitGlb(bytes)), options);
  if (looksLikeGltf(bytes)) return plainGltf({ json: await inWords(() => parseGltf(bytes)) }, options);
  throw refuseOther(bytes);
}

/** Whether bytes are the text of a JSON object, in any of the encodings that editors write. */
export function looksLikeGltf(bytes: Uint8Array): boolean {
  return /^\s*\{/.test(decodeText(bytes.subarray(0, 64)));
}

function parseGltf(bytes: Uint8Array): unknown {
  const text = decodeText(bytes);
  if (isDeepText(text)) throw new Fault('nested', [MAX_DEPTH]);
  try {
    return JSON.parse(text);
  } catch (cause) {
    const position = Number(/position (\d+)/.exec(String(cause))?.[1] ?? Number.NaN);
    const cut = position >= text.trimEnd().length || /end of (JSON|data)|Unterminated/i.test(String(cause));
    throw new HandlebodyError(cut ? 'file-truncated' : 'file-invalid', {
      message: `The glTF ${cut ? 'is cut off' : 'is no JSON'}: ${cause instanceof Error ? cause.message : String(cause)}.`,
      remedy: cut ? 'Download or export it again.' : 'Export the model again; a glTF validator says more.',
      culprit: { kind: 'byte', index: position || 0 },
      cause,
    });
  }
}
