/**
 * Handlebody's two glTF extensions for three.js' GLTFLoader.
 *
 * ```ts
 * const loader = new GLTFLoader().register(handlebodyPlugin);
 * const gltf = await loader.loadAsync('face.glb');
 * const { body, poseSpaces } = handlebodyData(gltf);
 * ```
 */

import type { Object3D, Mesh as ThreeMesh } from 'three';
import type { GLTF, GLTFLoaderPlugin, GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import { object as record } from '../../wasm/ts/arguments.ts';
import type { BodyData } from '../../wasm/ts/types.ts';
import { decodeBody } from '../assets/body-codec.ts';
import { Fault, inWords } from '../assets/fault.ts';
import type { PoseSpaceData } from '../assets/pose-space-schema.ts';
import { BODY_ACCESSORS, HANDLEBODY_BODY, HANDLEBODY_POSE_SPACE, parseStoredHeader, type StoredArrays } from '../assets/schema.ts';
import { isMesh } from './object-part.ts';
import { readObject } from './read-object.ts';

/** A pose space, and the meshes of the scene whose `morphTargetInfluences` its weights are for. */
export interface LoadedPoseSpace extends PoseSpaceData {
  readonly meshes: readonly ThreeMesh[];
}

/** What a loaded file has for Handlebody: `gltf.userData.handlebody`. */
export interface HandlebodyData {
  /** Its mesh is that of `meshFromObject(gltf.scene)`. */
  readonly body?: BodyData;
  readonly poseSpaces: readonly LoadedPoseSpace[];
}

/**
 * What the plugin found, typed; no body and no pose spaces when it was not registered.
 *
 * ```ts
 * const { body } = handlebodyData(gltf);
 * if (!body) console.log('bake it first');
 * ```
 */
export function handlebodyData(gltf: Pick<GLTF, 'userData'>): HandlebodyData {
  const { userData } = record(gltf, 'gltf', 'Give what GLTFLoader loads.') as unknown as GLTF;
  return (
    (record(userData, 'gltf.userData', 'Give what GLTFLoader loads.').handlebody as HandlebodyData | undefined) ?? {
      poseSpaces: [],
    }
  );
}

/**
 * Register it with a GLTFLoader to get `gltf.userData.handlebody`. GLTFExporter drops both extensions again, unless
 * `handlebodyExporterPlugin` is registered there.
 *
 * ```ts
 * new GLTFLoader().register(handlebodyPlugin);
 * ```
 */
export function handlebodyPlugin(parser: GLTFParser): HandlebodyGLTFPlugin {
  return new HandlebodyGLTFPlugin(parser);
}

/**
 * Reads HANDLEBODY_body and HANDLEBODY_pose_space when the scene is there. A file with a damaged extension, or one baked for other
 * positions, fails to load with a `HandlebodyError`: 'body-version', 'body-invalid', 'body-mismatch', 'wasm-unavailable', 'file-unsupported',
 * 'file-invalid', 'example-shape-mismatch' or 'example-not-finite'.
 *
 * ```ts
 * new GLTFLoader().register((parser) => new HandlebodyGLTFPlugin(parser));
 * ```
 */
export class HandlebodyGLTFPlugin implements GLTFLoaderPlugin {
  readonly name = HANDLEBODY_BODY;
  readonly #parser: GLTFParser;

  constructor(parser: GLTFParser) {
    this.#parser = parser;
  }

  async afterRoot(gltf: GLTF): Promise<void> {
    // A file without scenes shows nothing, and has no `gltf.scene`.
    const body = gltf.scene && (await inWords(() => this.#readBody(gltf.scene)));
    const poseSpaces = await inWords(() => this.#readPoseSpaces());
    gltf.userData.handlebody = { ...(body && { body }), poseSpaces } satisfies HandlebodyData;
  }

  async #readBody(scene: Object3D): Promise<BodyData | undefined> {
    const json = this.#parser.json.extensions?.[HANDLEBODY_BODY] as Record<string, unknown> | undefined;
    if (!json) return undefined;
    const header = parseStoredHeader(json);
    const names = Object.entries(BODY_ACCESSORS).filter(([name, rest]) => json[name] !== undefined || !('optional' in rest));
    const entries = names.map(async ([name]) => [name, await this.#readArray(json[name], name)] as const);
    const arrays = Object.fromEntries(await Promise.all(entries)) as Partial<StoredArrays>;
    return decodeBody({ header, arrays, mesh: async () => (await readObject(scene, { reading: header.reading ?? {} })).mesh });
  }

  /** The loader's arrays may be windows on one buffer, which posting a body to a worker would take along: so they are copied. */
  async #readArray(index: unknown, name: string): Promise<unknown> {
    try {
      if (this.#parser.json.accessors?.[index as number] === undefined) throw new Error(`accessor ${index} is missing`);
      return (await this.#parser.getDependency('accessor', index as number)).array.slice();
    } catch (cause) {
      throw new Fault('unreadable', [name], { cause });
    }
  }

  async #readPoseSpaces(): Promise<LoadedPoseSpace[]> {
    const { meshes = [], nodes = [] } = this.#parser.json as PosedJson;
    if (!meshes.some(({ extensions }) => extensions?.[HANDLEBODY_POSE_SPACE])) return [];
    const { parsePoseSpace } = await import('../assets/pose-space-schema.ts');
    // The loader's own list of what came of what knows one scene alone.
    const objects: Object3D[] = await this.#parser.getDependencies('node');
    const isNode = new Set(objects);
    const users: Object3D[][] = meshes.map(() => []);
    objects.forEach((object, i) => {
      users[nodes[i]?.mesh ?? -1]?.push(object);
    });
    return meshes.flatMap(({ extensions, primitives }, index) => {
      const json = extensions?.[HANDLEBODY_POSE_SPACE];
      if (!json) return [];
      const space = parsePoseSpace(json, { targetCount: primitives[0]?.targets?.length ?? 0 });
      return [{ ...space, meshes: (users[index] ?? []).flatMap((node) => meshesOf(node, isNode)) }];
    });
  }
}

interface PosedJson {
  readonly meshes?: { readonly extensions?: Record<string, unknown>; readonly primitives: { readonly targets?: unknown[] }[] }[];
  readonly nodes?: { readonly mesh?: number }[];
}

/** A node's own meshes, one for each primitive, and not those of the nodes below it. */
function meshesOf(object: Object3D, nodes: ReadonlySet<Object3D>): ThreeMesh[] {
  const below = object.children.filter((child) => !nodes.has(child)).flatMap((child) => meshesOf(child, nodes));
  return isMesh(object) ? [object, ...below] : below;
}
