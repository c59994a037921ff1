/** Making a deformation of a baked body and holding it, beside baking it: the dog. Prints one JSON object of milliseconds and bytes. */
import { readFileSync } from 'node:fs';
import { load } from '../../../dist/wasm/ts/index.js';
import { readBody, readGlb } from '../../../dist/web/assets/index.js';
import { milliseconds } from './clock.mjs';
import { SETUP } from './setup.mjs';

const started = performance.now();
await load();
const loaded = performance.now() - started;
const document = await readGlb(readFileSync(SETUP.model));
let served = await readBody(document);
/** @type {number[]} */
const unpacking = [];
for (let round = 0; round < 3; round++) {
  const start = performance.now();
  served = await readBody(document);
  unpacking.push(performance.now() - start);
}
if (!served) throw new Error('The model carries no body.');
const handles = SETUP.handles.map((vertex) => ({ vertex }));
/** @type {Record<string, number>} */
const result = { load: loaded, unpack: Math.min(...unpacking) };
for (const centers of [200, 300]) {
  const baking = await load();
  const start = performance.now();
  const body = await baking.bake(served.mesh, { centers });
  result[`bake ${centers}`] = performance.now() - start;
  result[`bytes to bake ${centers}`] = baking.memory;
  /** @type {number[]} */
  const ready = [];
  for (let round = 0; round < 3; round++) {
    const hb = await load();
    const make = () => hb.irbf(body).setHandles(handles);
    ready.push(milliseconds(make));
    result[`bytes ${centers}`] = hb.memory;
  }
  result[`ready ${centers}`] = ready.toSorted((a, b) => a - b)[1] ?? Number.NaN;
}
console.log(JSON.stringify(result));
