import { type Document, GLB_BUFFER, type JSONDocument } from '@gltf-transform/core';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { BodyData } from '../../wasm/ts/types.ts';
import { checkGlb, type GlbParts } from './check-glb.ts';
import { checkRequiredExtensions } from './check-gltf.ts';
import { createIo, type IoOptions } from './io.ts';
import { type GlbMesh, meshDocument } from './mesh-document.ts';
import { attachBody } from './write-body.ts';

const ALWAYS = ['KHR_mesh_quantization', 'HANDLEBODY_body', 'HANDLEBODY_pose_space'];

/**
 * Reads a GLB into a glTF-Transform document. The bytes are copied. Safe on hostile input: it gives a document or throws a
 * `HandlebodyError` ('file-not-glb', 'file-truncated', 'file-invalid', 'file-unsupported', 'mesh-too-large').
 *
 * ```ts
 * const document = await readGlb(new Uint8Array(await file.arrayBuffer()));
 * const { mesh } = readMesh(document);
 * ```
 */
export async function readGlb(bytes: Uint8Array, options: IoOptions = {}): Promise<Document> {
  const parts = checkGlb(bytes);
  checkRequiredExtensions(parts.json, [...ALWAYS, ...(options.extensions ?? []).map((extension) => extension.EXTENSION_NAME)]);
  try {
    return await createIo(options).readJSON(resolveBuffers(parts));
  } catch (cause) {
    if (cause instanceof HandlebodyError) throw cause;
    throw new HandlebodyError('file-invalid', {
      message: `The glTF is damaged: ${cause instanceof Error ? cause.message : String(cause)}`,
      remedy: 'Export the model again; a glTF validator says more.',
      culprit: { kind: 'byte', index: 20 },
      cause,
    });
  }
}

export interface WriteMeshOptions extends IoOptions {
  /** Of the node and the mesh. */
  readonly name?: string;
  /** What was baked for this mesh. */
  readonly body?: BodyData;
}

/**
 * Writes a document as GLB, or a mesh of typed arrays with or without what was baked for it; byte for byte the same each time.
 *
 * Of a mesh it rejects with what `meshDocument` and, with a body, `attachBody` throw.
 *
 * ```ts
 * const mesh = readObj(bytes);
 * await writeFile('cow.glb', await writeGlb(mesh, { body: await hb.bake(mesh) }));
 * ```
 */
export function writeGlb(document: Document, options?: IoOptions): Promise<Uint8Array>;
export function writeGlb(mesh: GlbMesh, options?: WriteMeshOptions): Promise<Uint8Array>;
export async function writeGlb(from: Document | GlbMesh, options: WriteMeshOptions = {}): Promise<Uint8Array> {
  const document = 'positions' in from ? meshDocument(from, options.name) : from;
  if (document !== from && options.body) await attachBody(document, options.body);
  return createIo(options).writeBinary(document);
}

/**
 * Buffers are copied and cut to their length: glTF-Transform checks views of the file against the end of the memory that the file lies
 * in, not of the file, and aligned numbers need an aligned start.
 */
function resolveBuffers({ json, bin }: GlbParts): JSONDocument {
  const resources: Record<string, Uint8Array<ArrayBuffer>> = {};
  const buffers = ((json.buffers ?? []) as { uri?: string; byteLength: number }[]).map((buffer, i) => {
    if (buffer.uri === undefined) {
      if (bin) resources[GLB_BUFFER] = Uint8Array.from(bin.subarray(0, buffer.byteLength));
      return buffer;
    }
    const binary = atob(buffer.uri.slice(buffer.uri.indexOf(',') + 1));
    if (binary.length < buffer.byteLength) throw new Error(`buffer ${i} is shorter than it says`);
    const uri = `__buffer-${i}.bin`;
    resources[uri] = Uint8Array.from({ length: buffer.byteLength }, (_, k) => binary.charCodeAt(k));
    return { ...buffer, uri };
  });
  const resolved = json.buffers === undefined ? json : { ...json, buffers };
  return { json: resolved as unknown as JSONDocument['json'], resources };
}
