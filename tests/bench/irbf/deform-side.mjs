/**
 * The wasm side of what is also measured natively (bench.cpp), on the case in the file that the first argument names: prints one JSON object
 * of milliseconds, and the largest errors of both frame kernels in diagonals.
 */
import { load } from '../../../dist/wasm/ts/index.js';
import { readCase } from './bodies.mjs';
import { inTurns, milliseconds, pull } from './clock.mjs';
import { weld } from './mesh.mjs';
import { reader } from './read-module.mjs';

const [file = '', turns = '9'] = process.argv.slice(2);
const hb = await load();
const where = readCase(file);
const { body } = where;
const handles = where.handles.map((vertex) => ({ vertex }));

let irbf = hb.irbf(body);
irbf.dispose();
const prepare = milliseconds(() => {
  irbf = hb.irbf(body);
});
const float = hb.irbf(body, { precision: 'float' });
for (const one of [irbf, float]) {
  one.setHandles(handles);
  pull(one, where, 1);
}
const { factor } = inTurns(5, 1, { factor: () => irbf.setHandles(handles) });
pull(irbf, where, 1);
const { solve } = inTurns(5, 2, { solve: () => irbf.solve({ maxIterations: 30, tolerance: 0 }) });
float.solve({ maxIterations: 30, tolerance: 0 });

// The kernel works on welded vertices.
const matrix = reader((weld(body.mesh).positions.length / 3) * body.centers.length);
if (matrix.read() !== matrix.expected) throw new Error('The matrix was not read as a whole.');
const size = body.mesh.positions.length;
const [fixedOut, floatOut, normals] = [new Float32Array(size), new Float32Array(size), new Float32Array(size)];
const times = inTurns(Number(turns), 3, {
  read: () => matrix.read(),
  deform: () => irbf.deform(fixedOut),
  deformFloat: () => float.deform(floatOut),
  deformNormals: () => irbf.deform(fixedOut, normals),
});
// In a row, what fits stays in the cache. Between two frames of a page there is more than that.
const other = reader(2 ** 25);
const swept = inTurns(Number(turns), 1, {
  sweep: () => other.read(),
  sweptRead: () => matrix.read(),
  sweepAgain: () => other.read(),
  sweptDeform: () => irbf.deform(fixedOut),
  sweepOnceMore: () => other.read(),
  sweptDeformFloat: () => float.deform(floatOut),
});

/** Against the double result, at 10,000 vertices or more. @param {Pick<import('../../../wasm/ts/index.ts').Irbf, 'evaluate'>} solver @param {Float32Array} out */
function largestError(solver, out) {
  const step = Math.max(1, Math.floor(size / 3 / 10_000));
  const chosen = Array.from({ length: Math.ceil(size / 3 / step) }, (_, i) => 3 * i * step);
  const exact = solver.evaluate(Float64Array.from(chosen.flatMap((at) => [...body.mesh.positions.subarray(at, at + 3)])));
  const miss = (/** @type {number} */ at, /** @type {number} */ i) =>
    Math.hypot(...[0, 1, 2].map((axis) => (out[at + axis] ?? Number.NaN) - (exact[3 * i + axis] ?? Number.NaN)));
  return chosen.reduce((worst, at, i) => Math.max(worst, miss(at, i)), 0) / body.normalization.diagonal;
}
const errors = { fixedError: largestError(irbf, fixedOut), floatError: largestError(float, floatOut) };
console.log(JSON.stringify({ prepare, factor, solve, ...times, ...swept, ...errors }));
