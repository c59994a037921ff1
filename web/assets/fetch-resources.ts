/** The buffers and images of a glTF, from data URIs and from files beside it. */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { decodeDataUri, isDataUri } from './data-uri.ts';
import { asObject, type GltfJson } from './gltf-json.ts';
import type { GltfReadOptions } from './gltf-warnings.ts';
import { ownBytes } from './to-bytes.ts';

/** The objects of a list in the JSON, with their numbers; whether it is a list at all is checked later. */
export function entriesOf(json: GltfJson, name: string): (readonly [number, GltfJson])[] {
  const list = json[name];
  if (!Array.isArray(list)) return [];
  return list.flatMap((entry, i) => (asObject(entry) ? [[i, entry as GltfJson] as const] : []));
}

/** A list of the JSON to be added to; what is no list is left to the check. */
export function listOf(json: GltfJson, name: string): unknown[] {
  const list = json[name];
  if (list !== undefined && !Array.isArray(list)) throw damaged(`"${name}" is no list`);
  return [...((list as unknown[] | undefined) ?? [])];
}

/** Fetches each name once. `undefined` for an image that is not there, or when there is nothing to fetch with. */
export class Resources {
  readonly #resource: GltfReadOptions['resource'];
  readonly #found = new Map<string, Promise<Uint8Array | undefined>>();

  constructor({ resource }: GltfReadOptions) {
    this.#resource = resource;
  }

  /** Throws 'file-invalid', 'file-unsupported' or 'file-unreadable', naming the buffer or image. */
  async get(uri: unknown, kind: 'buffer' | 'image', number: number): Promise<{ bytes: Uint8Array; mimeType?: string } | undefined> {
    const what = `${kind}s[${number}]`;
    if (typeof uri !== 'string') throw damaged(`${what}.uri is no text`);
    if (isDataUri(uri)) {
      try {
        return decodeDataUri(uri);
      } catch (cause) {
        throw damaged(`${what}.uri is a damaged data URI`, cause);
      }
    }
    if (!this.#resource) {
      if (kind === 'image') return undefined;
      throw new HandlebodyError('file-unsupported', {
        message: `The data of ${what} lies outside the file, in "${shortened(uri)}".`,
        remedy: 'Give its files along (the option "resource"), or export the model as one .glb file with everything inside.',
      });
    }
    const key = `${kind} ${uri}`;
    const found = this.#found.get(key) ?? this.#fetch(uri, kind, number);
    this.#found.set(key, found);
    const bytes = await found;
    return bytes && { bytes };
  }

  async #fetch(uri: string, kind: 'buffer' | 'image', number: number): Promise<Uint8Array | undefined> {
    const plain = withoutPercents(uri);
    let failure: unknown;
    for (const name of plain === uri ? [uri] : [plain, uri]) {
      try {
        const bytes = await this.#resource?.(name, kind);
        // The next file may be read into the same memory.
        if (bytes) return ownBytes(bytes);
      } catch (error) {
        failure ??= error;
      }
    }
    if (failure === undefined && kind === 'image') return undefined;
    if (failure instanceof HandlebodyError) throw failure;
    const why = failure instanceof Error ? `: ${failure.message.replace(/\.$/, '')}` : '';
    throw new HandlebodyError('file-unreadable', {
      message: `The model needs the file "${shortened(plain)}" (${kind}s[${number}].uri), which is not there${why}.`,
      remedy: 'Keep the files of a .gltf together, or export the model as one .glb file with everything inside.',
      cause: failure,
    });
  }
}

/** A name as people read it; one with damaged escapes stays as it is. */
function withoutPercents(uri: string): string {
  try {
    return decodeURIComponent(uri);
  } catch {
    return uri;
  }
}

function shortened(uri: string): string {
  return uri.length > 80 ? `${uri.slice(0, 79)}…` : uri;
}

export function damaged(what: string, cause?: unknown): HandlebodyError {
  return new HandlebodyError('file-invalid', {
    message: `The glTF is damaged: ${what}.`,
    remedy: 'Export the model again; a glTF validator says more.',
    culprit: { kind: 'byte', index: 0 },
    cause,
  });
}

/** What an image is by its first bytes, else by what is said of it. */
export function imageType(bytes: Uint8Array, said: unknown): string {
  const head = String.fromCharCode(...bytes.subarray(0, 16));
  const [, type] = SIGNATURES.find(([pattern]) => pattern.test(head)) ?? [];
  return type ?? (typeof said === 'string' && said.startsWith('image/') ? said : 'image/png');
}

const SIGNATURES: readonly (readonly [RegExp, string])[] = [
  [/^\x89PNG/, 'image/png'],
  [/^\xff\xd8\xff/, 'image/jpeg'],
  [/^RIFF.{4}WEBP/s, 'image/webp'],
  [/^\xabKTX 20\xbb/, 'image/ktx2'],
  [/^.{4}ftypavi[fs]/s, 'image/avif'],
];
