/** Handlebody in three.js: "handlebody/three". three.js itself is a peer dependency; glTF-Transform is not needed. */

export type { DrawnRun } from '../assets/drawn-corners.ts';
export type { FileErrorCode, FileErrorCodes } from '../assets/error-codes.ts';
export type { PoseSpaceData, StoredPoseSpace } from '../assets/pose-space-schema.ts';
export type { SceneChoices, SceneWarning, SceneWarningCode } from '../assets/scene-choices.ts';
export type { Matrix } from '../assets/transform.ts';
export { Deformable, deformable } from './deformable.ts';
export { DeformedGeometry } from './deformed-geometry.ts';
export { DRAGGABLE_DEFAULTS, Draggable, type DraggableHandle, type DraggableOptions, draggable } from './draggable.ts';
export { embeddedTextures } from './embedded-textures.ts';
export { type ExportedData, handlebodyExporterPlugin } from './exporter.ts';
export { meshFromObject } from './geometry.ts';
export { HandleOverlay, type HandleOverlayOptions } from './handle-overlay.ts';
export { HANDLE_STYLE } from './handle-style.ts';
export { BareHandles, type BareHandlesOptions, type HandlePoint } from './handles.ts';
export type { ObjectInstance } from './instances.ts';
export {
  type HandlebodyData,
  HandlebodyGLTFPlugin,
  handlebodyData,
  handlebodyPlugin,
  type LoadedPoseSpace,
} from './loader.ts';
export type { ObjectMesh, ObjectPart } from './object-part.ts';
export { type DrivenSpace, PoseDriver, poseDriver } from './pose-driver.ts';
export type { SurfacePick } from './surface-pick.ts';
