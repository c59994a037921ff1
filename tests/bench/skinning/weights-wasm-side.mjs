/** Our wasm's side of the skinning weights' benchmark, on the mesh in the file that the first argument names: prints medians in milliseconds. */
import { readFileSync } from 'node:fs';
import { load } from '../../../dist/wasm/ts/index.js';
import { median } from '../support.mjs';

const [file = '', rounds = '5'] = process.argv.slice(2);
const numbers = readFileSync(file, 'utf8').trim().split(/\s+/).map(Number);
const [n = 0, dimension = 2, m = 0, corners = 3, held = 0] = numbers;
const positions = numbers.slice(6, 6 + n * dimension);
const triangles = numbers.slice(6 + n * dimension, 6 + n * dimension + m * corners);
const mesh = { positions, triangles, dimension: /** @type {2} */ (dimension) };
const handles = Array.from({ length: held }, (_, k) => ({ vertex: numbers[6 + n * dimension + m * corners + 2 * k] ?? 0 }));
const others = Array.from({ length: n }, (_, vertex) => vertex).filter((v) => handles.every(({ vertex }) => vertex !== v));

const hb = await load();
/** @type {Record<string, number[]>} */
const taken = {};
/** @template T @param {string} name @param {() => T} run */
function time(name, run) {
  const start = performance.now();
  const result = run();
  taken[name] ??= [];
  taken[name].push(performance.now() - start);
  return result;
}

let factored = 0;
/** @type {Record<string, number>} */
let report = {};
for (let round = 0; round < Number(rounds); round++) {
  time('harmonic', () => hb.biharmonicWeights(mesh, handles, { order: 1 })).dispose();
  const weights = time('biharmonic', () => hb.biharmonicWeights(mesh, handles));
  const another = { vertex: others[(round * 997) % others.length] ?? 0 };
  time('add', () => weights.setHandles([...handles, another]));
  factored += Number(weights.factored);
  time('move', () => weights.setHandles([...handles.slice(1), another]));
  factored += Number(weights.factored);
  weights.dispose();
  const bounded = time('bounded', () => hb.biharmonicWeights(mesh, handles, { bounded: true }));
  const rows = Array.from({ length: n }, (_, v) =>
    bounded.weights.subarray(v * held, (v + 1) * held).reduce((sum, w) => sum + w, 0),
  );
  report = {
    energy: bounded.boundedReport?.energy ?? Number.NaN,
    'rows off 1': Math.max(...rows.map((sum) => Math.abs(sum - 1))),
    outside: Math.max(-Math.min(...bounded.weights), Math.max(...bounded.weights) - 1),
  };
  bounded.dispose();
}
console.log(
  JSON.stringify({ ...Object.fromEntries(Object.entries(taken).map(([name, list]) => [name, median(list)])), factored, ...report }),
);
