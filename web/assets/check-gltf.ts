import {
  list,
  notNegative,
  numbers,
  object,
  optional,
  type Readers,
  options as readOptions,
  text,
} from '../../wasm/ts/arguments.ts';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { GltfJson } from './gltf-json.ts';
import { type CheckGltfOptions, verifyGltf } from './verify-gltf.ts';
import { inWordsAtOnce } from './words-at-once.ts';

/** Extensions that replace the data of accessors by something compressed. */
const COMPRESSIONS = new Map([
  ['KHR_draco_mesh_compression', 'Draco'],
  ['EXT_meshopt_compression', 'meshopt'],
  ['KHR_meshopt_compression', 'meshopt'],
]);

const size = optional(notNegative);
const READERS = {
  binLength: size,
  bufferLengths: optional(numbers),
  fileLength: size,
  jsonStart: size,
  binStart: size,
} satisfies Readers<CheckGltfOptions>;

/**
 * Returns the JSON when it is sound. Throws 'file-invalid', 'file-unsupported' or 'mesh-too-large'.
 *
 * ```ts
 * checkGltf(JSON.parse(text));
 * ```
 */
export function checkGltf(value: unknown, options: CheckGltfOptions = {}): GltfJson {
  readOptions(options, READERS);
  return inWordsAtOnce(() => verifyGltf(value, options));
}

/**
 * Refuses files that need an extension outside `supported`.
 *
 * ```ts
 * checkRequiredExtensions(json, ['KHR_mesh_quantization']); // throws 'file-unsupported' for a Draco-compressed model
 * ```
 */
export function checkRequiredExtensions(json: GltfJson, supported: readonly string[]): void {
  object(json, 'json', 'Give the JSON of a glTF, parsed.');
  list(supported, 'supported', 'names of extensions', (each, label) => text(each, label));
  const required = (json.extensionsRequired ?? []) as readonly string[];
  const missing = required.find((name) => !supported.includes(name));
  if (missing === undefined) return;
  const compression = COMPRESSIONS.get(missing);
  throw new HandlebodyError('file-unsupported', {
    message: compression
      ? `The model is compressed with ${compression} (${missing} in extensionsRequired), which is not read here.`
      : `The model needs the extension ${missing} (extensionsRequired), which is not read here.`,
    remedy: compression
      ? `Export it without mesh compression${compression === 'Draco' ? ', or give the decoder: the option "draco" of readGlb' : ', and compress last'}.`
      : 'Export it without that extension, or register it.',
  });
}
