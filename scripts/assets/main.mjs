/**
 * `npm run assets`: makes `public/models/*.glb` and `public/models/LICENSES.md` again, from packages fetched by name,
 * version and hash. The files are committed; nothing needs this to run or be tested.
 *
 *     node scripts/assets/main.mjs [face] [dog] [spot] [--check]
 *
 * `--check` writes nothing, and fails if a file would change.
 */
import { existsSync, mkdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { dog } from './dog.mjs';
import { faceDocument } from './face.mjs';
import { AssetFetchError } from './fetch.mjs';
import { plainGlb, toBytes } from './gltf.mjs';
import { dogLicense, licenses } from './licenses.mjs';
import { spot } from './spot.mjs';

const MODELS = new URL('../../public/models/', import.meta.url);

/**
 * What is made: a file's name, and what makes its document.
 * @type {Record<string, () => import('@gltf-transform/core').Document | Promise<import('@gltf-transform/core').Document>>}
 */
const RECIPES = {
  face: faceDocument,
  dog: () => plainGlb(dog()),
  spot: () => plainGlb(spot()),
};

/** Where bodies want to be held: vertices. Those that are named here are baked, as by default. @type {Record<string, [name: string, vertex: number][]>} */
const HANDLES = {
  dog: [
    ['Front right paw', 1172],
    ['Front left paw', 4946],
    ['Back right paw', 7827],
    ['Back left paw', 9813],
    ['Nose', 13637],
    ['Tail tip', 3169],
  ],
  spot: [
    ['Front right hoof', 1166],
    ['Front left hoof', 2292],
    ['Back right hoof', 1143],
    ['Back left hoof', 2273],
    ['Nose', 1453],
    ['Tail', 1855],
  ],
};

/**
 * The document as a file, with interior distances on the bodies: baked last, since other steps would not know the extension.
 * @param {string} name
 * @param {import('@gltf-transform/core').Document} document
 */
async function bakedBytes(name, document) {
  const handles = HANDLES[name];
  if (!handles) return toBytes(document);
  const { load } = await import('../../dist/wasm/ts/index.js');
  const { attachBody, readMesh } = await import('../../dist/web/assets/index.js');
  const body = await (await load()).bake(readMesh(document).mesh);
  await attachBody(document, { ...body, handles: handles.map(([name, vertex]) => ({ name, vertex })) });
  return toBytes(document);
}

/**
 * @param {string} name
 * @param {Uint8Array} bytes
 * @param {boolean} check
 * @returns {boolean} Whether the file is, or was, another one.
 */
function put(name, bytes, check) {
  const path = fileURLToPath(new URL(name, MODELS));
  const same = existsSync(path) && readFileSync(path).equals(bytes);
  console.log(`${name}: ${bytes.length.toLocaleString('en')} bytes, ${same ? 'unchanged' : check ? 'would change' : 'written'}`);
  if (same || check) return !same;
  mkdirSync(MODELS, { recursive: true });
  writeFileSync(`${path}.part`, bytes);
  renameSync(`${path}.part`, path);
  return true;
}

const { values, positionals } = parseArgs({ allowPositionals: true, options: { check: { type: 'boolean', default: false } } });
const names = positionals.length > 0 ? positionals : Object.keys(RECIPES);
try {
  let changed = false;
  for (const name of names) {
    const recipe = RECIPES[name];
    if (!recipe) throw new RangeError(`There is no model "${name}": choose from ${Object.keys(RECIPES).join(', ')}.`);
    changed = put(`${name}.glb`, await bakedBytes(name, await recipe()), values.check) || changed;
  }
  changed = put('LICENSES.md', new TextEncoder().encode(licenses()), values.check) || changed;
  changed = put('LICENSE-dog.txt', dogLicense(), values.check) || changed;
  if (values.check && changed) process.exitCode = 1;
} catch (error) {
  if (!(error instanceof AssetFetchError || error instanceof RangeError)) throw error;
  console.error(error.message);
  process.exitCode = 2;
}
