/** The container of a GLB: header and chunks. Every byte that is read was checked to be there. */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { asBytes, type Bytes } from './bytes.ts';
import { checkGltf } from './check-gltf.ts';
import type { GltfJson } from './gltf-json.ts';

const MAGIC = 0x46546c67; // "glTF"
const JSON_CHUNK = 0x4e4f534a;
const BIN_CHUNK = 0x004e4942;

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
export function checkGlb(bytes: Bytes): GlbParts {
  const { json, bin, binStart, length } = splitGlb(asBytes(bytes));
  return { json: checkGltf(json, { binLength: bin?.length, jsonStart: 20, binStart, fileLength: length }), bin };
}

/** A GLB's chunks, its JSON parsed but not looked into. */
interface GlbChunks {
  readonly json: unknown;
  readonly bin: Uint8Array | undefined;
  /** Where the binary chunk begins, or 0. */
  readonly binStart: number;
  /** Of the file, as its header says it. */
  readonly length: number;
}

/** The container alone: throws as `checkGlb` does, but for what is in the JSON. */
export function splitGlb(bytes: Uint8Array): GlbChunks {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  checkMagic(bytes);
  if (bytes.length < 20) throw truncated(`ends after ${bytes.length} bytes, within its header`, bytes.length);
  const version = view.getUint32(4, true);
  if (version !== 2) {
    throw new HandlebodyError('file-unsupported', {
      message: `The file is a GLB of version ${version}; version 2 is read.`,
      remedy: 'Export the model with a current tool.',
      culprit: { kind: 'byte', index: 4 },
    });
  }
  const length = view.getUint32(8, true);
  if (length > bytes.length) throw truncated(`says it has ${length} bytes, but ${bytes.length} are there`, bytes.length);

  let json: Uint8Array | undefined;
  let bin: Uint8Array | undefined;
  let binStart = 0;
  // Chunks after the second are for extensions and skipped; so is padding that is too short to be a chunk.
  for (let offset = 12, index = 0; offset + 8 <= length; index++) {
    const chunkLength = view.getUint32(offset, true);
    const type = view.getUint32(offset + 4, true);
    const start = offset + 8;
    if (start + chunkLength > length) {
      throw invalid(`has a chunk of ${chunkLength} bytes at byte ${offset}, which runs past its end`, offset);
    }
    const chunk = bytes.subarray(start, start + chunkLength);
    if (index === 0) {
      if (type !== JSON_CHUNK) throw invalid('does not begin with a JSON chunk', offset + 4);
      json = chunk;
    } else if (index === 1 && type === BIN_CHUNK) {
      [bin, binStart] = [chunk, start];
    }
    offset = start + chunkLength;
  }
  if (!json) throw invalid('has no JSON chunk', 12);
  return { json: parseJson(json), bin, binStart, length };
}

/** Throws 'file-not-glb', saying what the bytes look like, or 'file-truncated'. */
export function checkMagic(bytes: Uint8Array): void {
  if (bytes.length >= 4 && bytes[0] === 0x67 && new DataView(bytes.buffer, bytes.byteOffset, 4).getUint32(0, true) === MAGIC)
    return;
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

function parseJson(chunk: Uint8Array): unknown {
  try {
    return JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(chunk));
  } catch (cause) {
    const position = Number(/position (\d+)/.exec(String(cause))?.[1] ?? 0);
    throw invalid('has a JSON chunk that is not JSON', 20 + position, cause);
  }
}

function truncated(what: string, byte: number): HandlebodyError {
  return new HandlebodyError('file-truncated', {
    message: `The file is cut off: it ${what}.`,
    remedy: 'Download or export it again.',
    culprit: { kind: 'byte', index: byte },
  });
}

function invalid(what: string, byte: number, cause?: unknown): HandlebodyError {
  return new HandlebodyError('file-invalid', {
    message: `The GLB is damaged: it ${what}.`,
    remedy: 'Export the model again; a glTF validator says more.',
    culprit: { kind: 'byte', index: byte },
    cause,
  });
}
