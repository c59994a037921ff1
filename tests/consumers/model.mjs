// The model of all consumers: a capsule with a green texture, as it comes from anywhere, and baked.
import { writeFileSync } from 'node:fs';
import path from 'node:path';
import { Document } from '@gltf-transform/core';
import { PNG } from 'pngjs';
import { CapsuleGeometry } from 'three';
import { at } from '../../scripts/lib/paths.mjs';
import { capture } from '../../scripts/lib/run.mjs';

/** Writes capsule.glb and capsule.baked.glb into a folder, by the built library. @param {string} folder */
export async function writeModels(folder) {
  const { createIo } = await import('../../dist/web/assets/index.js');
  const [from, to] = [path.join(folder, 'capsule.glb'), path.join(folder, 'capsule.baked.glb')];
  writeFileSync(from, await createIo().writeBinary(capsule()));
  const options = ['--centers', '30', '--resolution', '24'];
  const baked = capture(process.execPath, [at('dist', 'web', 'cli', 'main.js'), 'bake', from, '-o', to, ...options]);
  if (baked.status !== 0) throw new Error(`The capsule could not be baked:\n${baked.stderr}`);
}

function capsule() {
  const geometry = new CapsuleGeometry(0.3, 1, 4, 12);
  const document = new Document();
  const buffer = document.createBuffer();
  const primitive = document
    .createPrimitive()
    .setIndices(document.createAccessor('', buffer).setArray(new Uint16Array(geometry.index?.array ?? [])));
  for (const [semantic, name, type] of /** @type {const} */ ([
    ['POSITION', 'position', 'VEC3'],
    ['NORMAL', 'normal', 'VEC3'],
    ['TEXCOORD_0', 'uv', 'VEC2'],
  ])) {
    const values = new Float32Array(geometry.getAttribute(name).array);
    primitive.setAttribute(semantic, document.createAccessor('', buffer).setType(type).setArray(values));
  }
  const png = new PNG({ width: 8, height: 8 });
  for (let i = 0; i < png.data.length; i += 4) png.data.set([0, 255, 0, 255], i);
  const texture = document
    .createTexture('green')
    .setMimeType('image/png')
    .setImage(new Uint8Array(PNG.sync.write(png)));
  primitive.setMaterial(document.createMaterial().setBaseColorTexture(texture).setMetallicFactor(0));
  document.createScene().addChild(document.createNode().setMesh(document.createMesh().addPrimitive(primitive)));
  return document;
}
