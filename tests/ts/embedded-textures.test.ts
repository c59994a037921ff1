/** Textures inside a GLB, read without an address of their own: what a strict content security policy allows. */
import { Document } from '@gltf-transform/core';
import { EXTTextureWebP } from '@gltf-transform/extensions';
import type { Mesh, MeshStandardMaterial, Texture } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { afterEach, expect, it, vi } from 'vitest';
import { createIo } from '../../web/assets/index.ts';
import { embeddedTextures } from '../../web/three/index.ts';

afterEach(() => vi.unstubAllGlobals());

const [PNG, WEBP] = [Uint8Array.of(137, 80, 78, 71, 1, 2, 3), Uint8Array.of(82, 73, 70, 70, 9)];

/** A triangle whose color is a PNG and whose roughness a WebP. */
async function model(): Promise<ArrayBuffer> {
  const document = new Document();
  document.createExtension(EXTTextureWebP).setRequired(true);
  const buffer = document.createBuffer();
  const material = document
    .createMaterial()
    .setBaseColorTexture(document.createTexture('color').setImage(PNG).setMimeType('image/png'))
    .setMetallicRoughnessTexture(document.createTexture('roughness').setImage(WEBP).setMimeType('image/webp'));
  const corners = document
    .createAccessor('', buffer)
    .setType('VEC3')
    .setArray(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]));
  const mesh = document
    .createMesh()
    .addPrimitive(document.createPrimitive().setAttribute('POSITION', corners).setMaterial(material));
  document.createScene().addChild(document.createNode().setMesh(mesh));
  return (await createIo({ extensions: [EXTTextureWebP] }).writeBinary(document)).slice().buffer;
}

/** A browser in which nothing can be fetched; `bitmaps` gets what is decoded. */
function strictBrowser(bitmaps: Blob[]): void {
  vi.stubGlobal('self', globalThis);
  vi.stubGlobal('fetch', () => Promise.reject(new Error('refused by the policy')));
  vi.stubGlobal('createImageBitmap', async (file: Blob) => {
    bitmaps.push(file);
    return { width: 1, height: 1, close() {} };
  });
}

const texturesOf = async (loader: GLTFLoader): Promise<(Texture | null)[]> => {
  const { scene } = await loader.parseAsync(await model(), '');
  const { map, roughnessMap } = (scene.children[0] as Mesh).material as MeshStandardMaterial;
  return [map, roughnessMap];
};

it('are decoded from their bytes, those of extensions too', async () => {
  const bitmaps: Blob[] = [];
  strictBrowser(bitmaps);
  const textures = await texturesOf(embeddedTextures(new GLTFLoader()));
  expect(textures.map((texture) => [texture?.name, texture?.flipY])).toEqual([
    ['color', false],
    ['roughness', false],
  ]);
  const read = await Promise.all(bitmaps.map(async (file) => [file.type, [...new Uint8Array(await file.arrayBuffer())]]));
  expect(new Map(read as [string, number[]][])).toEqual(
    new Map([
      ['image/png', [...PNG]],
      ['image/webp', [...WEBP]],
    ]),
  );
});

it('would be lost without: the loader fetches them', async () => {
  strictBrowser([]);
  vi.stubGlobal('console', { ...console, error: () => {} });
  expect(await texturesOf(new GLTFLoader())).toEqual([null, null]);
});
