/** The glTF extension HANDLEBODY_pose_space for glTF-Transform. What stands in the file: `pose-space-schema.ts`. */
import {
  Extension,
  ExtensionProperty,
  type Nullable,
  PropertyType,
  type ReaderContext,
  type WriterContext,
} from '@gltf-transform/core';
import { plainCopy } from './plain-copy.ts';
import { HANDLEBODY_POSE_SPACE } from './schema.ts';

export interface IPoseSpaceProperty {
  name: string;
  extras: Record<string, unknown>;
  definition: Record<string, unknown>;
}

/**
 * A mesh's pose space in a glTF-Transform document. Use `attachPoseSpace` and `readPoseSpaces`, which check what they handle.
 *
 * ```ts
 * for (const mesh of document.getRoot().listMeshes()) console.log(mesh.getExtension<PoseSpaceProperty>('HANDLEBODY_pose_space')?.getDefinition());
 * ```
 */
export class PoseSpaceProperty extends ExtensionProperty<IPoseSpaceProperty> {
  static override readonly EXTENSION_NAME = HANDLEBODY_POSE_SPACE;
  declare readonly extensionName: typeof HANDLEBODY_POSE_SPACE;
  declare readonly propertyType: 'HandlebodyPoseSpace';
  declare readonly parentTypes: [PropertyType.MESH];

  protected override init(): void {
    Object.assign(this, {
      extensionName: HANDLEBODY_POSE_SPACE,
      propertyType: 'HandlebodyPoseSpace',
      parentTypes: [PropertyType.MESH],
    });
  }

  protected override getDefaults(): Nullable<IPoseSpaceProperty> {
    return Object.assign(super.getDefaults(), { definition: {} });
  }

  /** As the JSON has it: not yet checked, see `parsePoseSpace`. */
  getDefinition(): Record<string, unknown> {
    return this.get('definition');
  }

  setDefinition(definition: object): this {
    return this.set('definition', plainCopy(definition, this.extensionName));
  }
}

/**
 * Lets glTF-Transform read and write pose spaces.
 *
 * ```ts
 * const io = new NodeIO().registerExtensions([BodyExtension, PoseSpaceExtension]);
 * ```
 */
export class PoseSpaceExtension extends Extension {
  static override readonly EXTENSION_NAME = HANDLEBODY_POSE_SPACE;
  override readonly extensionName = HANDLEBODY_POSE_SPACE;

  createPoseSpace(): PoseSpaceProperty {
    return new PoseSpaceProperty(this.document.getGraph());
  }

  /** Takes what is there, so that a damaged pose space does not keep the model from opening; `readPoseSpaces` checks it. */
  override read(context: ReaderContext): this {
    for (const [i, mesh] of (context.jsonDoc.json.meshes ?? []).entries()) {
      const json = (mesh.extensions as Record<string, unknown> | undefined)?.[HANDLEBODY_POSE_SPACE];
      if (typeof json !== 'object' || json === null) continue;
      context.meshes[i]?.setExtension(HANDLEBODY_POSE_SPACE, this.createPoseSpace().setDefinition(json));
    }
    return this;
  }

  override write(context: WriterContext): this {
    for (const mesh of this.document.getRoot().listMeshes()) {
      const space = mesh.getExtension<PoseSpaceProperty>(HANDLEBODY_POSE_SPACE);
      const json = context.jsonDoc.json.meshes?.[context.meshIndexMap.get(mesh) ?? -1];
      if (space && json) json.extensions = { ...json.extensions, [HANDLEBODY_POSE_SPACE]: space.getDefinition() };
    }
    return this;
  }
}
