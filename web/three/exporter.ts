/**
 * Handlebody's two glTF extensions for three.js' GLTFExporter, which writes none that it does not know: without this plugin an exported
 * model has lost its body and its pose spaces.
 */

import type { Object3D } from 'three';
import type { GLTFExporterPlugin, GLTFWriter } from 'three/addons/exporters/GLTFExporter.js';
import { object as record } from '../../wasm/ts/arguments.ts';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { hashPositions } from '../../wasm/ts/hash.ts';
import type { BodyData, TypedArray } from '../../wasm/ts/types.ts';
import { encodeBody } from '../assets/body-codec.ts';
import { packGlb } from '../assets/pack-glb.ts';
import { parsePoseSpace, poseSpaceDefinition } from '../assets/pose-space-schema.ts';
import { BODY_ACCESSORS, checkBody, HANDLEBODY_BODY, HANDLEBODY_POSE_SPACE, headerOf } from '../assets/schema.ts';
import { inWordsAtOnce } from '../assets/words-at-once.ts';
import { meshFromObject } from './geometry.ts';
import type { HandlebodyData, LoadedPoseSpace } from './loader.ts';

/** What is to be exported: what `handlebodyData` gives of a loaded model, or a body and pose spaces of other make. */
export type ExportedData = Partial<HandlebodyData>;

/** The parts of GLTFExporter's writer that plugins work with, which its types leave out. */
interface Writer {
  readonly json: WriterJson;
  readonly buffers: ArrayBuffer[];
  byteOffset: number;
  readonly pending: Promise<unknown>[];
  readonly nodeMap: ReadonlyMap<Object3D, number>;
  readonly extensionsUsed: Record<string, boolean>;
  processBuffer(buffer: ArrayBuffer): number;
}

interface MeshJson {
  readonly primitives: readonly { readonly targets?: readonly unknown[] }[];
  readonly extensions?: Readonly<Record<string, unknown>>;
}

interface WriterJson {
  readonly nodes?: { mesh?: number; extensions?: unknown }[];
  readonly meshes?: MeshJson[];
  bufferViews?: object[];
  accessors?: object[];
  extensions?: Record<string, unknown>;
}

/**
 * For `GLTFExporter.register`: writes a body, and pose spaces on the meshes that they are for, into what is exported.
 *
 * A body is good for the very positions that it was baked for. So nodes are written by translation, rotation and scale, which come back to
 * the bit where a matrix does not, and what was written is read once more before the export ends, as GLTFLoader reads it. Exporting ends
 * with 'body-mismatch' where the scene is deformed, has parts hidden since it was baked, was moved itself, or has geometry that
 * GLTFExporter writes in another order; with 'file-unsupported' where a mesh of a pose space is not part of what is exported, or an
 * InstancedMesh is; with what `parsePoseSpace` throws where a mesh lost its morph targets.
 *
 * ```ts
 * import { handlebodyData, handlebodyExporterPlugin, handlebodyPlugin } from 'handlebody/three';
 * import { GLTFExporter } from 'three/addons/exporters/GLTFExporter.js';
 * import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
 *
 * const gltf = await new GLTFLoader().register(handlebodyPlugin).loadAsync('dog.glb');
 * const exporter = new GLTFExporter().register(handlebodyExporterPlugin(handlebodyData(gltf)));
 * const glb = await exporter.parseAsync(gltf.scene, { binary: true });
 * ```
 */
export function handlebodyExporterPlugin(data: ExportedData): (writer: GLTFWriter) => GLTFExporterPlugin {
  const { body, poseSpaces = [] } = record(
    data,
    'data',
    'Give { body, poseSpaces }, as handlebodyData(gltf) does.',
  ) as ExportedData;
  return (given) => {
    const writer = given as unknown as Writer;
    return {
      writeNode: writeExactly,
      afterParse() {
        for (const space of poseSpaces) writePoseSpace(writer, space);
        // GLTFExporter waits for what is pending, not for its plugins.
        if (body) writer.pending.push(writeBody(writer, body));
      },
    };
  };
}

/** A matrix is taken apart when it is read, and put together again with other last bits. */
function writeExactly(object: Object3D, node: Record<string, unknown>): void {
  if (node.matrix === undefined || !object.matrixAutoUpdate) return;
  delete node.matrix;
  node.translation = object.position.toArray();
  node.rotation = object.quaternion.toArray();
  node.scale = object.scale.toArray();
}

function writePoseSpace({ json, nodeMap, extensionsUsed }: Writer, { meshes, ...space }: LoadedPoseSpace): void {
  const definition = poseSpaceDefinition(space);
  const users = meshes.map((mesh) => {
    const node = json.nodes?.[nodeMap.get(mesh) ?? -1];
    if (node?.mesh !== undefined) return node as { mesh: number };
    throw new HandlebodyError('file-unsupported', {
      message: `The mesh "${mesh.name}" of a pose space is not among what is exported.`,
      remedy: 'Export the object that it belongs to, visible, or leave that pose space out.',
    });
  });
  for (const index of new Set(users.map(({ mesh }) => mesh))) {
    const mesh = json.meshes?.[index] as MeshJson;
    inWordsAtOnce(() => parsePoseSpace(definition, { targetCount: mesh.primitives[0]?.targets?.length ?? 0 }));
    const own = users.filter((node) => node.mesh === index);
    const isShared = (json.nodes ?? []).some((node) => node.mesh === index && !own.includes(node as { mesh: number }));
    const written = { ...mesh, extensions: { ...mesh.extensions, [HANDLEBODY_POSE_SPACE]: definition } };
    // GLTFExporter writes meshes of one geometry and material once, and not all of them may have the pose space.
    const to = isShared || mesh.extensions?.[HANDLEBODY_POSE_SPACE] !== undefined ? (json.meshes?.length ?? 0) : index;
    (json.meshes as MeshJson[])[to] = written;
    for (const node of own) node.mesh = to;
  }
  extensionsUsed[HANDLEBODY_POSE_SPACE] = true;
}

async function writeBody(writer: Writer, body: BodyData): Promise<void> {
  if (writer.extensionsUsed.EXT_mesh_gpu_instancing) {
    throw new HandlebodyError('file-unsupported', {
      message: 'The export has an InstancedMesh, whose copies a body in a file cannot tell apart.',
      remedy: 'Export each copy as a mesh of its own, and bake that.',
    });
  }
  const shapes = shapesAlone(writer);
  const header = inWordsAtOnce(() => headerOf(body));
  inWordsAtOnce(() => checkBody(body));
  const { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js');
  const { scene } = await new GLTFLoader().parseAsync(shapes, '');
  checkPositions(meshFromObject(scene, { reading: body.mesh.reading ?? {} }).mesh.positions, body);
  const { arrays, arraysHash } = await encodeBody(body);
  const accessors = Object.entries(BODY_ACCESSORS).flatMap(([name, { type }]) => {
    const array = arrays[name as keyof typeof arrays];
    return array ? [[name, writeAccessor(writer, array, type)]] : [];
  });
  writer.json.extensions = {
    ...writer.json.extensions,
    [HANDLEBODY_BODY]: { ...header, arraysHash, ...Object.fromEntries(accessors) },
  };
  writer.extensionsUsed[HANDLEBODY_BODY] = true;
}

/** What was written so far, without what shapes do not need: pictures would want a browser. */
function shapesAlone({ json, buffers }: Writer): ArrayBuffer {
  const copy = structuredClone(json) as unknown as Record<string, unknown> & WriterJson;
  for (const key of ['materials', 'textures', 'images', 'samplers', 'animations', 'cameras', 'extensions']) delete copy[key];
  for (const node of copy.nodes ?? []) for (const key of ['camera', 'extensions']) delete (node as Record<string, unknown>)[key];
  for (const { primitives } of copy.meshes ?? [])
    for (const primitive of primitives) delete (primitive as { material?: number }).material;
  const bin = new Uint8Array(buffers.reduce((sum, { byteLength }) => sum + byteLength, 0));
  let offset = 0;
  for (const buffer of buffers) {
    bin.set(new Uint8Array(buffer), offset);
    offset += buffer.byteLength;
  }
  return packGlb({ json: { ...copy, buffers: [{ byteLength: bin.length }] }, bin }).buffer;
}

function checkPositions(written: TypedArray, { mesh, positionsHash }: BodyData): void {
  if (hashPositions(written) === positionsHash) return;
  const [there, baked] = [written.length / 3, mesh.positions.length / 3];
  const vertex = Math.floor(written.findIndex((x: number, i: number) => x !== mesh.positions[i]) / 3);
  const how =
    there === baked ? `vertex ${vertex} would lie elsewhere` : `${there} vertices would be written, and ${baked} were baked`;
  throw new HandlebodyError('body-mismatch', {
    message: `The body cannot be exported with this scene: ${how}.`,
    remedy:
      'Export the object that was baked, at rest: put back what was deformed, moved or hidden since, or export without the body and bake the file.',
    ...(there === baked && { culprit: { kind: 'vertex', index: vertex } as const }),
  });
}

const COMPONENT_TYPES = new Map<unknown, number>([
  [Uint8Array, 5121],
  [Uint32Array, 5125],
  [Float32Array, 5126],
]);

const WIDTHS = { SCALAR: 1, VEC3: 3, VEC4: 4 } as const;

/** Numbers side by side: GLTFExporter's own way pads every byte to four. */
function writeAccessor(writer: Writer, array: Uint8Array | Uint32Array | Float32Array, type: keyof typeof WIDTHS): number {
  const { json } = writer;
  const padded = new Uint8Array(Math.ceil(array.byteLength / 4) * 4);
  padded.set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
  json.bufferViews ??= [];
  json.accessors ??= [];
  const buffer = writer.processBuffer(padded.buffer);
  const view = json.bufferViews.push({ buffer, byteOffset: writer.byteOffset, byteLength: array.byteLength }) - 1;
  writer.byteOffset += padded.byteLength;
  const count = array.length / WIDTHS[type];
  return json.accessors.push({ bufferView: view, componentType: COMPONENT_TYPES.get(array.constructor), type, count }) - 1;
}
