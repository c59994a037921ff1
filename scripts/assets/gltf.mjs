/** Models to glTF-Transform documents, and documents to bytes. */
import { Document, Logger, VertexLayout } from '@gltf-transform/core';

/** What every document starts from. The generator names no version and no time: the same input gives the same bytes. */
export function newDocument() {
  const document = new Document();
  document.getRoot().getAsset().generator = 'handlebody';
  document.createBuffer();
  return document;
}

/**
 * @param {Document} document
 * @param {'SCALAR' | 'VEC2' | 'VEC3' | 'VEC4'} type
 * @param {Float32Array | Uint32Array | Uint16Array | Uint8Array} array
 */
export function accessor(document, type, array) {
  const buffer = document.getRoot().listBuffers()[0] ?? document.createBuffer();
  const own = /** @type {import('@gltf-transform/core').TypedArray} */ (array);
  return document.createAccessor().setType(type).setArray(own).setBuffer(buffer);
}

/**
 * The narrowest array that holds the indices.
 * @param {Uint32Array} triangles
 * @param {number} vertexCount
 */
export function indexArray(triangles, vertexCount) {
  return vertexCount < 65536 ? Uint16Array.from(triangles) : triangles;
}

/**
 * A document of one plain mesh with one material: any viewer opens it.
 * @param {import('./mesh.mjs').Model} model
 * @returns {Document}
 */
export function plainGlb(model) {
  const document = newDocument();
  document.getRoot().getAsset().copyright = model.license;
  const material = document
    .createMaterial(model.name)
    .setBaseColorFactor(model.material.color)
    .setMetallicFactor(0)
    .setRoughnessFactor(model.material.roughness);
  if (model.material.texture)
    material.setBaseColorTexture(document.createTexture(model.name).setMimeType('image/png').setImage(model.material.texture));
  const primitive = document
    .createPrimitive()
    .setMaterial(material)
    .setAttribute('POSITION', accessor(document, 'VEC3', model.positions))
    .setAttribute('NORMAL', accessor(document, 'VEC3', model.normals))
    .setIndices(accessor(document, 'SCALAR', indexArray(model.triangles, model.positions.length / 3)));
  if (model.uvs) primitive.setAttribute('TEXCOORD_0', accessor(document, 'VEC2', model.uvs));
  if (model.colors) primitive.setAttribute('COLOR_0', accessor(document, 'VEC4', model.colors).setNormalized(true));
  const mesh = document.createMesh(model.name).addPrimitive(primitive);
  document.createScene(model.name).addChild(document.createNode(model.name).setMesh(mesh));
  return document;
}

/**
 * Our extensions come from the built library: `npm run assets` builds it first.
 * @param {Document} document
 */
export async function toBytes(document) {
  const { createIo } = await import('../../dist/web/assets/index.js');
  // A sparse accessor that is more than half full is worth a warning in general; a face unit of a small part is often one.
  // Attributes one after another compress better than vertex by vertex: the dog's by a fifth.
  const io = createIo().setLogger(new Logger(Logger.Verbosity.ERROR)).setVertexLayout(VertexLayout.SEPARATE);
  return io.writeBinary(document);
}
