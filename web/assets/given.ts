/** What callers give the readers and writers of files and scenes: read, or refused by name, as everywhere (wasm/ts/arguments.ts). */
import type { Document, Mesh } from '@gltf-transform/core';
import { callback, object, optional, type Reader, refused, text } from '../../wasm/ts/arguments.ts';

export const gltfDocument: Reader<Document> = (value, name) => {
  if (typeof (value as Document | null)?.getRoot === 'function') return value as Document;
  throw refused(name, value, 'Give a document of glTF-Transform, such as readGlb() makes.');
};

export const gltfMesh: Reader<Mesh> = (value, name) => {
  if (typeof (value as Mesh | null)?.listPrimitives === 'function') return value as Mesh;
  throw refused(name, value, 'Give a mesh of the document, such as one of document.getRoot().listMeshes().');
};

/** Anything with properties, which are checked where they are used. */
const thing: Reader<object> = (value, name) => object(value, name, 'Give an object.');

const extensions: Reader<readonly unknown[]> = (value, name) => {
  const isExtension = (each: unknown) => typeof each === 'function' && 'EXTENSION_NAME' in each;
  if (Array.isArray(value) && value.every(isExtension)) return value;
  throw refused(name, value, 'Give an array of glTF-Transform’s extensions, such as ALL_EXTENSIONS.');
};

/** Of documents that are read and written. */
export const IO_READERS = { extensions: optional(extensions) };
export const GLTF_READERS = { ...IO_READERS, resource: optional(callback), onWarning: optional(callback), draco: optional(thing) };
export const WRITE_READERS = { ...IO_READERS, name: optional(text), body: optional(thing) };
