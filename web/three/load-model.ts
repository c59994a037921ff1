import type { Object3D } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { BodyData } from '../../wasm/ts/types.ts';
import type { GltfReadOptions } from '../assets/gltf-warnings.ts';
import { openAsGlb } from '../assets/open-gltf.ts';
import { embeddedTextures } from './embedded-textures.ts';
import { handlebodyData, handlebodyPlugin, type LoadedPoseSpace } from './loader.ts';

/** What a GLB brings: an object, and maybe what was baked into it. */
export interface LoadedModel {
  readonly object: Object3D;
  readonly body: BodyData | undefined;
  readonly space: LoadedPoseSpace | undefined;
}

/** Checks a GLB, or a .gltf with its files, compressed or not, and makes three.js objects of it. */
export async function loadModel(buffer: ArrayBuffer, options?: GltfReadOptions): Promise<LoadedModel> {
  const loader = embeddedTextures(new GLTFLoader()).register(handlebodyPlugin);
  try {
    const glb = await openAsGlb(new Uint8Array(buffer), options);
    const gltf = await loader.parseAsync(glb.buffer as ArrayBuffer, '');
    const { body, poseSpaces } = handlebodyData(gltf);
    return { object: gltf.scene, body, space: poseSpaces[0] };
  } catch (cause) {
    if (cause instanceof HandlebodyError) throw cause;
    throw new HandlebodyError('file-invalid', {
      message: `The GLB could not be read: ${cause instanceof Error ? cause.message : String(cause)}`,
      remedy: 'Export the model again; a glTF validator says more.',
      cause,
    });
  }
}
