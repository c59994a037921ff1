/** Models whose data lies in several files, or is compressed, on the studio's stage. */
import { Document, NodeIO } from '@gltf-transform/core';
import { EXTMeshoptCompression } from '@gltf-transform/extensions';
import { MeshoptEncoder } from 'meshoptimizer/encoder';
import type { Browser, Page } from 'playwright-core';
import { PNG } from 'pngjs';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { ball } from './support/files.ts';
import { difference, launch, picture, settled, soon, visit } from './support/studio.ts';

let browser: Browser;
let page: Page;
let said: string[];
beforeAll(async () => {
  browser = await launch();
  ({ page, said } = await visit(browser, { reducedMotion: 'reduce', shared: true }));
});
afterAll(() => browser.close());

/** A ball with a texture. */
function ballDocument(): Document {
  const { positions, indices } = ball();
  const document = new Document();
  const buffer = document.createBuffer('ball').setURI('ball%20data.bin');
  const texture = document.createTexture('skin').setURI('skins/red.png').setMimeType('image/png');
  texture.setImage(
    new Uint8Array(PNG.sync.write(Object.assign(new PNG({ width: 2, height: 2 }), { data: Buffer.alloc(16, 255) }))),
  );
  const uvs = document
    .createAccessor('', buffer)
    .setType('VEC2')
    .setArray(new Float32Array((positions.length / 3) * 2));
  const primitive = document
    .createPrimitive()
    .setAttribute('POSITION', document.createAccessor('', buffer).setType('VEC3').setArray(Float32Array.from(positions)))
    .setAttribute('TEXCOORD_0', uvs)
    .setIndices(document.createAccessor('', buffer).setArray(Uint16Array.from(indices)))
    .setMaterial(document.createMaterial().setBaseColorTexture(texture));
  const node = document.createNode('ball').setMesh(document.createMesh('ball').addPrimitive(primitive));
  document.getRoot().setDefaultScene(document.createScene().addChild(node));
  return document;
}

interface Given {
  readonly name: string;
  readonly buffer: Buffer;
}

async function separate(): Promise<Given[]> {
  const { json, resources } = await new NodeIO().writeJSON(ballDocument());
  const files = Object.entries(resources).map(([uri, bytes]) => ({
    name: decodeURIComponent(uri.split('/').at(-1) ?? ''),
    buffer: Buffer.from(bytes),
  }));
  return [...files, { name: 'ball.gltf', buffer: Buffer.from(JSON.stringify(json)) }];
}

async function compressed(): Promise<Given[]> {
  const document = ballDocument();
  document.createExtension(EXTMeshoptCompression).setRequired(true);
  await MeshoptEncoder.ready;
  const io = new NodeIO().registerExtensions([EXTMeshoptCompression]).registerDependencies({ 'meshopt.encoder': MeshoptEncoder });
  return [{ name: 'compressed.glb', buffer: Buffer.from(await io.writeBinary(document)) }];
}

const choose = (files: readonly Given[]) =>
  page.setInputFiles(
    '#file',
    files.map((file) => ({ ...file, mimeType: 'application/octet-stream' })),
  );

/** As if they were let go over the page. */
async function drop(files: readonly Given[]): Promise<void> {
  const plain = files.map(({ name, buffer }) => ({ name, bytes: [...buffer] }));
  await page.evaluate((list) => {
    const dataTransfer = new DataTransfer();
    for (const { name, bytes } of list) dataTransfer.items.add(new File([new Uint8Array(bytes)], name));
    document.body.dispatchEvent(new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer }));
  }, plain);
}

const chosen = () => page.locator('#models input:checked + span').textContent();
const again = async () => {
  await page.locator('#models input[value=dog]').check({ force: true });
  await soon(() => page.locator('#studio').getAttribute('data-model')).toBe('dog');
  await settled(page);
};

it.each([
  ['a .gltf with its files, chosen together', separate, choose, 'ball'],
  ['a .gltf with its files, dropped together', separate, drop, 'ball'],
  ['a GLB compressed by meshopt', compressed, choose, 'compressed'],
])('shows %s, ready to be dragged', async (_, make, give, name) => {
  await give(await make());
  await soon(chosen).toBe(name);
  await settled(page);
  expect(await page.getByRole('alert').locator('.sentence').count()).toBe(0);
  expect(await page.locator('.handle').count()).toBe(6);
  await again();
  expect(said).toEqual([]);
});

it.each(['ball data.bin', 'red.png'])('names %s where it is missing, and keeps the picture', async (missing) => {
  const before = await picture(page);
  await choose((await separate()).filter(({ name }) => name !== missing));
  const alert = page.getByRole('alert');
  await soon(() => alert.locator('.code').textContent()).toContain('file-unreadable');
  expect(await alert.locator('.sentence').textContent()).toContain(missing);
  expect(difference(before, await picture(page))).toBeLessThan(20);
  expect(said).toEqual([]);
});
