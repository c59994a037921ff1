import { type Extension, Logger, WebIO } from '@gltf-transform/core';
import { BodyExtension } from './body-extension.ts';
import { MeshQuantization } from './mesh-quantization.ts';
import { PoseSpaceExtension } from './pose-space-extension.ts';

export interface IoOptions {
  /**
   * glTF-Transform extensions beside our own and KHR_mesh_quantization. `readGlb`, `readGltf` and `writeGlb` find those of
   * `@gltf-transform/extensions` by themselves; `createIo` drops what is not registered.
   */
  readonly extensions?: readonly (typeof Extension)[];
}

/**
 * A glTF-Transform I/O object, for browsers and Node alike, that knows Handlebody's extensions.
 *
 * ```ts
 * const io = createIo();
 * const bytes = await io.writeBinary(document);
 * ```
 */
export function createIo({ extensions = [] }: IoOptions = {}): WebIO {
  const known = new Map<string, typeof Extension>();
  for (const extension of [MeshQuantization, BodyExtension, PoseSpaceExtension, ...extensions] as (typeof Extension)[]) {
    known.set(extension.EXTENSION_NAME, extension);
  }
  // Unknown optional extensions would each be warned of on the console, which a library has no business with.
  return new WebIO().setLogger(new Logger(Logger.Verbosity.ERROR)).registerExtensions([...known.values()]);
}

/**
 * The extensions that `createIo` registers, to add to an I/O object of your own.
 *
 * ```ts
 * new NodeIO().registerExtensions([...ALL_EXTENSIONS, ...HANDLEBODY_EXTENSIONS]);
 * ```
 */
export const HANDLEBODY_EXTENSIONS: readonly (typeof Extension)[] = [
  BodyExtension,
  PoseSpaceExtension,
] as unknown as (typeof Extension)[];
