import type { Document, Mesh } from '@gltf-transform/core';
import { list, object } from '../../wasm/ts/arguments.ts';
import { gltfDocument, gltfMesh } from './given.ts';
import { PoseSpaceExtension, type PoseSpaceProperty } from './pose-space-extension.ts';
import { type PoseSpaceData, type PoseSpaceInput, parsePoseSpace, poseSpaceDefinition } from './pose-space-schema.ts';
import { HANDLEBODY_POSE_SPACE } from './schema.ts';
import { inWordsAtOnce } from './words-at-once.ts';

/**
 * Gives a mesh a pose space, in place of one that it has. A mesh made by `mesh.clone()` shares the pose space of the original, which keeps
 * it; `cloneDocument` and `mergeDocuments` of glTF-Transform copy pose spaces with their meshes, and its `prune` keeps them. Its `dedup`
 * takes meshes of the same primitives for one, whatever pose spaces they have: give it `propertyTypes` without meshes, or attach afterwards.
 *
 * Throws 'file-invalid', 'example-shape-mismatch' or 'example-not-finite' when it does not fit the mesh.
 *
 * ```ts
 * attachPoseSpace(document, face, {
 *   version: 1,
 *   dimensions: [{ name: 'valence', min: -1, max: 1 }],
 *   examples: [{ name: 'happy', at: [0.8], weights: [1, 0] }, { name: 'sad', at: [-0.6], target: 1 }],
 * });
 * ```
 */
export function attachPoseSpace(document: Document, mesh: Mesh, poseSpace: PoseSpaceInput): PoseSpaceProperty {
  gltfDocument(document, 'document');
  gltfMesh(mesh, 'mesh');
  const { dimensions, examples } = object(poseSpace, 'poseSpace', 'Give { dimensions, examples }.');
  list(dimensions, 'poseSpace.dimensions', '{ name, min, max }', (each) => each);
  list(examples, 'poseSpace.examples', '{ name, at, weights }', (each, name) => object(each, name, 'Give { name, at, weights }.'));
  const definition = poseSpaceDefinition(poseSpace);
  inWordsAtOnce(() => parsePoseSpace(definition, { targetCount: morphTargetCount(mesh) }));
  const former = mesh.getExtension<PoseSpaceProperty>(HANDLEBODY_POSE_SPACE);
  const property = document.createExtension(PoseSpaceExtension).createPoseSpace().setDefinition(definition);
  mesh.setExtension(HANDLEBODY_POSE_SPACE, property);
  // A clone shares what its original has, and that is not its own to throw away.
  if (former?.listParents().length === 0) former.dispose();
  return property;
}

/**
 * Every pose space of a document, with the mesh that it is for.
 *
 * Throws 'file-unsupported', 'file-invalid', 'example-shape-mismatch' or 'example-not-finite'.
 *
 * ```ts
 * for (const { mesh, dimensions } of readPoseSpaces(document)) console.log(mesh.getName(), dimensions);
 * ```
 */
export function readPoseSpaces(document: Document): (PoseSpaceData & { mesh: Mesh })[] {
  return gltfDocument(document, 'document')
    .getRoot()
    .listMeshes()
    .flatMap((mesh) => {
      const property = mesh.getExtension<PoseSpaceProperty>(HANDLEBODY_POSE_SPACE);
      if (!property) return [];
      return [{ mesh, ...inWordsAtOnce(() => parsePoseSpace(property.getDefinition(), { targetCount: morphTargetCount(mesh) })) }];
    });
}

function morphTargetCount(mesh: Mesh): number {
  return mesh.listPrimitives()[0]?.listTargets().length ?? 0;
}
