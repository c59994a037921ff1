import { type Document, type Extension, type JSONDocument, Logger, type PlatformIO, WebIO } from '@gltf-transform/core';
import { options as readOptions } from '../../wasm/ts/arguments.ts';
import { BodyExtension } from './body-extension.ts';
import { IO_READERS } from './given.ts';
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
export function createIo(options: IoOptions = {}): WebIO {
  readOptions(options, IO_READERS);
  const { extensions = [] } = options;
  const known = new Map<string, typeof Extension>();
  for (const extension of [MeshQuantization, BodyExtension, PoseSpaceExtension, ...extensions] as (typeof Extension)[]) {
    known.set(extension.EXTENSION_NAME, extension);
  }
  // Unknown optional extensions would each be warned of on the console, which a library has no business with.
  return new ExactIo().setLogger(new Logger(Logger.Verbosity.ERROR)).registerExtensions([...known.values()]);
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

/**
 * Writes every transform as it is. glTF-Transform leaves out those within 1e-5 of none, which may be more than a small model's size; and it
 * gives a camera that sees without end one, at 100.
 */
class ExactIo extends WebIO {
  override async readJSON(given: JSONDocument): Promise<Document> {
    const document = await super.readJSON(given);
    for (const [i, camera] of document.getRoot().listCameras().entries()) {
      const perspective = given.json.cameras?.[i]?.perspective;
      if (perspective && perspective.zfar === undefined) camera.setZFar(Number.POSITIVE_INFINITY);
    }
    return document;
  }

  override async writeJSON(...given: Parameters<PlatformIO['writeJSON']>): Promise<JSONDocument> {
    const written = await super.writeJSON(...given);
    const [document]: [Document, ...unknown[]] = given;
    document
      .getRoot()
      .listNodes()
      .forEach((node, i) => {
        const json = written.json.nodes?.[i];
        if (!json) return;
        const differs = (value: readonly number[], none: readonly number[]) => value.some((x, k) => x !== none[k]);
        const [translation, rotation, scale] = [node.getTranslation(), node.getRotation(), node.getScale()];
        if (differs(translation, [0, 0, 0])) json.translation = translation;
        if (differs(rotation, [0, 0, 0, 1])) json.rotation = rotation;
        if (differs(scale, [1, 1, 1])) json.scale = scale;
      });
    for (const { perspective } of written.json.cameras ?? [])
      if (perspective?.zfar === Number.POSITIVE_INFINITY) delete perspective.zfar;
    return written;
  }
}
