/** Sound parts of a glTF as a glTF-Transform document, with every extension that the file uses as far as it can be kept. */
import { type Document, type Extension, GLB_BUFFER, type JSONDocument } from '@gltf-transform/core';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { GlbParts } from './check-glb.ts';
import { checkRequiredExtensions } from './check-gltf.ts';
import type { GltfJson } from './gltf-json.ts';
import { decompressed, type GltfReadOptions, type GltfWarning } from './gltf-warnings.ts';
import { createIo, type IoOptions } from './io.ts';
import { keepUnknown } from './kept-extension.ts';

const ALWAYS = ['KHR_mesh_quantization', 'HANDLEBODY_body', 'HANDLEBODY_pose_space'];
const DRACO = 'KHR_draco_mesh_compression';

export interface ReadGltfOptions extends IoOptions, GltfReadOptions {
  /** The decoder of Google's `draco3dgltf`, `await draco3d.createDecoderModule()`: without it, compressed models are refused. */
  readonly draco?: object | undefined;
}

/** Throws 'file-unsupported' for what needs an extension that is not known, 'file-invalid' for what glTF-Transform cannot read. */
export async function toDocument(parts: GlbParts, options: ReadGltfOptions): Promise<Document> {
  const { draco, onWarning } = options;
  const used = (parts.json.extensionsUsed ?? []) as readonly string[];
  const given = (options.extensions ?? []).filter(({ EXTENSION_NAME }) => draco || EXTENSION_NAME !== DRACO);
  const extensions = await extensionsFor(used, given, draco !== undefined);
  const known = [...ALWAYS, ...extensions.map(({ EXTENSION_NAME }) => EXTENSION_NAME)];
  checkRequiredExtensions(parts.json, known);
  // Optional means that the data is there plain, too; some writers leave it out.
  if (!draco && needsDraco(parts)) checkRequiredExtensions({ extensionsRequired: [DRACO] }, known);
  const unknown = used.filter((name) => !known.includes(name));
  // Told in the end: what a listener throws is nothing that the file has done.
  const warnings: GltfWarning[] = [];
  let document: Document;
  try {
    const kept = keepUnknown(parts.json, unknown, (warning) => warnings.push(warning));
    const io = createIo({ extensions: [...extensions, ...kept] });
    if (draco) io.registerDependencies({ 'draco3d.decoder': draco });
    document = await io.readJSON(withResources(parts));
    if (draco && used.includes(DRACO)) {
      document.disposeExtension(DRACO);
      warnings.push(decompressed('Draco'));
    }
  } catch (cause) {
    if (cause instanceof HandlebodyError) throw cause;
    throw new HandlebodyError('file-invalid', {
      message: `The glTF is damaged: ${cause instanceof Error ? cause.message : String(cause)}`,
      remedy: 'Export the model again; a glTF validator says more.',
      culprit: { kind: 'byte', index: 20 },
      cause,
    });
  }
  for (const warning of warnings) onWarning?.(warning);
  return document;
}

/** The caller's extensions, and glTF-Transform's own for what else the file uses; those that decompress only where they can. */
async function extensionsFor(
  used: readonly string[],
  given: readonly (typeof Extension)[],
  draco: boolean,
): Promise<(typeof Extension)[]> {
  const names = given.map(({ EXTENSION_NAME }) => EXTENSION_NAME);
  if (used.every((name) => ALWAYS.includes(name) || names.includes(name))) return [...given];
  const { ALL_EXTENSIONS } = await import('@gltf-transform/extensions');
  const others = (ALL_EXTENSIONS as (typeof Extension)[]).filter(
    ({ EXTENSION_NAME: name }) => used.includes(name) && ![...ALWAYS, ...names].includes(name) && (draco || name !== DRACO),
  );
  return [...given, ...others];
}

/** Whether a primitive's positions are nowhere but in its compressed copy. */
function needsDraco({ json }: GlbParts): boolean {
  const accessors = (json.accessors ?? []) as { bufferView?: number; sparse?: unknown }[];
  const meshes = (json.meshes ?? []) as { primitives?: { attributes: Record<string, number>; extensions?: object }[] }[];
  return meshes.some(({ primitives = [] }) =>
    primitives.some(({ attributes, extensions }) => {
      const positions = accessors[attributes.POSITION ?? -1];
      return extensions && DRACO in extensions && positions && positions.bufferView === undefined && !positions.sparse;
    }),
  );
}

/** The binary part is copied and cut to its length: aligned numbers need an aligned start, and documents keep what they read. */
function withResources({ json, bin }: GlbParts): JSONDocument {
  const [buffer] = (json.buffers ?? []) as { byteLength: number }[];
  const resources = buffer && bin ? { [GLB_BUFFER]: Uint8Array.from(bin.subarray(0, buffer.byteLength)) } : {};
  return { json: withOffsets(json) as unknown as JSONDocument['json'], resources };
}

/** glTF-Transform takes the accessor's own offset for those of its sparse parts, where they give none. */
function withOffsets(json: GltfJson): GltfJson {
  const accessors = json.accessors as { sparse?: { indices: object; values: object } }[] | undefined;
  if (!accessors?.some(({ sparse }) => sparse)) return json;
  const from = (part: object) => ({ byteOffset: 0, ...part });
  return {
    ...json,
    accessors: accessors.map((accessor) => {
      const { sparse } = accessor;
      return sparse ? { ...accessor, sparse: { ...sparse, indices: from(sparse.indices), values: from(sparse.values) } } : accessor;
    }),
  };
}
