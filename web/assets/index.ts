/// <reference lib="esnext.float16" preserve="true" />
// glTF-Transform's own declarations name Float16Array, which a reader's library may not have.
/** GLB files to typed arrays and back, by glTF-Transform, and OBJ, PLY, STL and OFF to typed arrays: "handlebody/gltf-transform". Knows no three.js. */
export { type BodyAccessorName, BodyExtension, BodyProperty, type IBodyProperty } from './body-extension.ts';
export { checkGlb, type GlbParts } from './check-glb.ts';
export { checkGltf, checkRequiredExtensions } from './check-gltf.ts';
export type { MeshRange } from './concatenate.ts';
export type { FileErrorCode, FileErrorCodes } from './error-codes.ts';
export type { FileMesh } from './file-mesh.ts';
export type { FileWarning, FileWarningCode, ReadOptions } from './file-warnings.ts';
export { readGlb, type WriteMeshOptions, writeGlb } from './glb.ts';
export type { GltfJson } from './gltf-json.ts';
export type { GltfReadOptions, GltfWarning } from './gltf-warnings.ts';
export { createIo, HANDLEBODY_EXTENSIONS, type IoOptions } from './io.ts';
export { type GlbMesh, meshDocument } from './mesh-document.ts';
export { MeshQuantization } from './mesh-quantization.ts';
export { type IPoseSpaceProperty, PoseSpaceExtension, PoseSpaceProperty } from './pose-space-extension.ts';
export { POSE_SPACE_VERSION, type PoseSpaceData, type PoseSpaceInput, type StoredPoseSpace } from './pose-space-schema.ts';
export { attachPoseSpace, readPoseSpaces } from './pose-spaces.ts';
export { readBody } from './read-body.ts';
export { readGltf } from './read-gltf.ts';
export { type PrimitiveRange, readMesh } from './read-mesh.ts';
export { readObj } from './read-obj.ts';
export { readOff } from './read-off.ts';
export { readPly } from './read-ply.ts';
export { readStl } from './read-stl.ts';
export type { SceneChoices, SceneWarning, SceneWarningCode } from './scene-choices.ts';
export { BODY_VERSION, HANDLEBODY_BODY, HANDLEBODY_POSE_SPACE } from './schema.ts';
export type { FileBytes } from './to-bytes.ts';
export type { ReadGltfOptions } from './to-document.ts';
export type { Matrix } from './transform.ts';
export type { CheckGltfOptions } from './verify-gltf.ts';
export { attachBody, detachBody } from './write-body.ts';
