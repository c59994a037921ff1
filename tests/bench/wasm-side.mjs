/** The wasm side of `npm run bench`, through the public interface: prints one JSON object of milliseconds, as bench.cpp does. */
import { readFileSync } from 'node:fs';
import { load } from '../../dist/wasm/ts/index.js';
import { readBody, readGlb } from '../../dist/web/assets/index.js';
import { SETUP } from './setup.mjs';

/** @param {number} repetitions @param {() => void} run */
function leastMilliseconds(repetitions, run) {
  let least = Number.POSITIVE_INFINITY;
  for (let i = 0; i < repetitions; i++) {
    const start = performance.now();
    run();
    least = Math.min(least, performance.now() - start);
  }
  return least;
}

const started = performance.now();
const hb = await load();
const loaded = performance.now() - started;
const body = await readBody(await readGlb(readFileSync(SETUP.model)));
if (!body) throw new Error('The model carries no body.');

let irbf = hb.irbf(body);
const prepare = leastMilliseconds(3, () => {
  irbf.dispose();
  irbf = hb.irbf(body);
});
const handles = SETUP.handles.map((vertex) => ({ vertex }));
const factor = leastMilliseconds(5, () => irbf.setHandles(handles));
for (const [axis, part] of SETUP.shift.entries())
  irbf.targets[axis] = (irbf.targets[axis] ?? 0) + part * body.normalization.diagonal;
const solve = leastMilliseconds(20, () => irbf.solve({ maxIterations: 30, tolerance: 0 }));
const [out, normals] = [new Float32Array(irbf.vertexCount * 3), new Float32Array(irbf.vertexCount * 3)];
const deform = leastMilliseconds(60, () => irbf.deform(out));
const deformNormals = leastMilliseconds(60, () => irbf.deform(out, normals));
console.log(JSON.stringify({ load: loaded, prepare, factor, solve, deform, deformNormals }));
