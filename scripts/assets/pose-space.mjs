/** The glTF mesh extension `HANDLEBODY_pose_space`, format version 0: a place and morph-target weights for each example. */
import { Extension, ExtensionProperty, PropertyType } from '@gltf-transform/core';

const NAME = 'HANDLEBODY_pose_space';

/**
 * @typedef {object} PoseSpaceData
 * @property {0} version
 * @property {{ name: string, min: number, max: number }[]} dimensions
 * @property {{ name: string, at: number[], weights: number[] }[]} examples
 */

/** The extension's data on one mesh. */
export class PoseSpace extends ExtensionProperty {
  /** @override */
  static EXTENSION_NAME = NAME;
  /** @override @readonly */
  extensionName = NAME;
  /** @override @readonly */
  propertyType = 'PoseSpace';
  /** @override @readonly */
  parentTypes = [PropertyType.MESH];
  /** @type {PoseSpaceData} */
  data = { version: 0, dimensions: [], examples: [] };

  /** @override */
  init() {}
}

export class HandlebodyPoseSpace extends Extension {
  /** @override */
  static EXTENSION_NAME = NAME;
  /** @override @readonly */
  extensionName = NAME;

  /** @param {PoseSpaceData} data */
  createPoseSpace(data) {
    const property = new PoseSpace(this.document.getGraph());
    property.data = data;
    return property;
  }

  /**
   * @override
   * @param {import('@gltf-transform/core').ReaderContext} context
   */
  read(context) {
    context.jsonDoc.json.meshes?.forEach((def, i) => {
      const data = def.extensions?.[NAME];
      if (data) context.meshes[i]?.setExtension(NAME, this.createPoseSpace(/** @type {PoseSpaceData} */ (data)));
    });
    return this;
  }

  /**
   * @override
   * @param {import('@gltf-transform/core').WriterContext} context
   */
  write(context) {
    for (const mesh of this.document.getRoot().listMeshes()) {
      const property = mesh.getExtension(NAME);
      const def = context.jsonDoc.json.meshes?.[context.meshIndexMap.get(mesh) ?? -1];
      if (property instanceof PoseSpace && def) def.extensions = { ...def.extensions, [NAME]: property.data };
    }
    return this;
  }
}
