// The packed library in Node: its entries load and answer, and so does its command.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { at } from '../lib/paths.mjs';
import { capture, mustRun } from '../lib/run.mjs';

/** Every entry loads that needs no peer, and a refused mesh gives a typed error with a remedy. */
const SMOKE = `
import { HandlebodyError, load } from 'handlebody';
import { load as loadExternal } from 'handlebody/external';
import { createIo, readBody } from 'handlebody/gltf-transform';
import { HandlebodyError as RuntimeError, load as loadRuntime } from 'handlebody/runtime';
import { load as loadRuntimeExternal } from 'handlebody/runtime/external';

if ((await readBody(await createIo().readJSON({ json: { asset: { version: '2.0' } }, resources: {} }))) !== undefined)
  throw new Error('an empty file has a body');
for (const start of [load, loadExternal]) {
  const hb = await start();
  if (!(hb.memory > 0)) throw new Error('the solver has no memory');
  try {
    await hb.bake({ positions: new Float64Array(3), triangles: new Uint32Array(0) });
    throw new Error('a mesh of one vertex was baked');
  } catch (error) {
    if (!(error instanceof HandlebodyError) || !error.remedy) throw error;
  }
}
if (RuntimeError !== HandlebodyError) throw new Error('the entries have error classes of their own');
for (const start of [loadRuntime, loadRuntimeExternal]) {
  const hb = await start();
  if ('bake' in hb) throw new Error('the runtime promises to bake');
  const value = hb.shepard({ dimension: 1, points: [0, 1], values: [2, 3] }).evaluate([1])[0];
  if (value !== 3) throw new Error('the runtime interpolates to ' + value);
}
for (const [start, file] of [[load, 'handlebody.runtime.wasm'], [loadRuntime, 'handlebody.wasm']]) {
  const error = await start({ wasm: new URL(import.meta.resolve('handlebody/' + file)) }).catch((e) => e);
  if (!(error instanceof HandlebodyError) || !error.remedy) throw new Error(file + ' was not refused');
}
console.log('the packed library loads and answers in Node ' + process.versions.node);
`;

/** What the command is tried on: a box, eight vertices and six faces. */
const BOX = `${[0, 1, 2, 3, 4, 5, 6, 7].map((i) => `v ${i & 1} ${(i >> 1) & 1} ${i >> 2}`).join('\n')}
f 1 3 4 2
f 5 6 8 7
f 1 2 6 5
f 3 7 8 4
f 1 5 7 3
f 2 4 8 6
`;

/**
 * Runs the installed command as npx does: it bakes a box, bends it, and ends with its documented status when it cannot.
 * @param {string} folder
 */
function tryCommand(folder) {
  writeFileSync(path.join(folder, 'box.obj'), BOX);
  const handles = [
    { vertex: 0, to: [0, 0, 0] },
    { vertex: 1, to: [1, 0, 0] },
    { vertex: 7, to: [1.2, 1, 1] },
  ];
  writeFileSync(path.join(folder, 'handles.json'), JSON.stringify({ handles }));
  const handlebody = (/** @type {string[]} */ ...args) =>
    capture('npx', ['--no-install', 'handlebody', ...args], { cwd: folder, shell: process.platform === 'win32' });
  const expect = (/** @type {number} */ status, /** @type {string[]} */ ...args) => {
    const result = handlebody(...args);
    if (result.status !== status) throw new Error(`handlebody ${args.join(' ')} ended with ${result.status}:\n${result.stderr}`);
    return result.stdout;
  };
  const { version } = JSON.parse(readFileSync(at('package.json'), 'utf8'));
  if (expect(0, '--version').trim() !== version) throw new Error('the installed command is of another version');
  expect(0, 'bake', 'box.obj', '-o', 'box.glb', '--resolution', '24', '--centers', '8');
  if (JSON.parse(expect(0, 'inspect', 'box.glb', '--json')).body?.matches !== true) throw new Error('the box was not baked');
  expect(0, 'deform', 'box.glb', '--handles', 'handles.json', '-o', 'bent.glb');
  for (const [what, element] of Object.entries({ 'box.glb': 'handle-body', 'course-12': 'handle-figure' })) {
    expect(0, 'embed', what, '-o', 'page.html');
    if (!readFileSync(path.join(folder, 'page.html'), 'utf8').includes(`<${element} `)) throw new Error(`${what} was not embedded`);
  }
  expect(3, 'bake', 'none.glb', '-o', 'out.glb');
  console.log('the installed command bakes, inspects, deforms, embeds and refuses');
}

/** The C header finds in the package what it includes. @param {string} folder */
function tryHeader(folder) {
  const wasm = path.join(folder, 'node_modules', 'handlebody', 'wasm');
  const header = readFileSync(path.join(wasm, 'abi', 'handlebody.h'), 'utf8');
  const included = [...header.matchAll(/^#include "(.+)"$/gm)].map((match) => match[1] ?? '');
  const missing = included.find((file) => !existsSync(path.join(wasm, file)));
  if (missing) throw new Error(`wasm/abi/handlebody.h includes ${missing}, which is not in the package.`);
}

/** Runs in Node what is installed in a project. @param {string} folder */
export async function trySmoke(folder) {
  writeFileSync(path.join(folder, 'smoke.mjs'), SMOKE);
  await mustRun(process.execPath, ['smoke.mjs'], { cwd: folder });
  tryHeader(folder);
  tryCommand(folder);
}

const WITH_THREE = `
import { load } from 'handlebody';
import 'handlebody/element';
import { DeformedGeometry, meshFromObject } from 'handlebody/three';
import { CapsuleGeometry, Mesh, REVISION } from 'three';

const model = new Mesh(new CapsuleGeometry(0.2, 1, 8, 16));
const { mesh, parts } = meshFromObject(model);
const hb = await load();
const irbf = hb.irbf(await hb.bake(mesh, { resolution: 32 }));
irbf.setHandles([{ at: [0, -0.5, 0] }, { at: [0, 0.5, 0] }]);
irbf.targets.set([0.3, 0.45, 0], 10);
irbf.solve();
const positions = new Float32Array(mesh.positions.length);
irbf.deform(positions);
new DeformedGeometry(parts).update(positions);
model.geometry.computeBoundingBox();
if (!(model.geometry.boundingBox.max.x > 0.4)) throw new Error('the capsule does not lean over');
console.log('the packed library moves a mesh of three.js r' + REVISION);
`;

/** Deforms a mesh of the three.js that is installed in a project. @param {string} folder */
export async function tryThree(folder) {
  writeFileSync(path.join(folder, 'with-three.mjs'), WITH_THREE);
  await mustRun(process.execPath, ['with-three.mjs'], { cwd: folder });
}
