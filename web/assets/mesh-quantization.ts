import { Extension } from '@gltf-transform/core';

/**
 * KHR_mesh_quantization: positions and normals as small integers. glTF-Transform decodes them by itself; the extension only has to be
 * known, because files that use it require it. Register `KHRMeshQuantization` of @gltf-transform/extensions instead if you use that.
 *
 * ```ts
 * const io = new NodeIO().registerExtensions([MeshQuantization]); // reads quantized meshes
 * ```
 */
export class MeshQuantization extends Extension {
  static override readonly EXTENSION_NAME = 'KHR_mesh_quantization';
  override readonly extensionName = 'KHR_mesh_quantization';

  override read(): this {
    return this;
  }

  override write(): this {
    return this;
  }
}
