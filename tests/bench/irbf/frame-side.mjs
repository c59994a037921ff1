/**
 * Our side of a frame of dragging, on the case in the file that the first argument names: from the converged pose before it, the handle goes
 * 1% of the diagonal on; iterations until the energy is within 10% of the converged one, and the deformation. With a second argument the mesh
 * and the handles are written there for libigl (frame_side.py). Prints one JSON object.
 */
import { writeFileSync } from 'node:fs';
import { load } from '../../../dist/wasm/ts/index.js';
import { readCase } from './bodies.mjs';
import { inTurns, pull } from './clock.mjs';

const [file = '', out] = process.argv.slice(2);
const hb = await load();
const where = readCase(file);
const { mesh, normalization } = where.body;
const irbf = hb.irbf(where.body);
irbf.setHandles(where.handles.map((vertex) => ({ vertex })));

const step = 0.01 / (Math.hypot(...where.shift) / normalization.diagonal);
/** Converged one step before the end, then one step on. */
const before = () => {
  pull(irbf, where, 1 - step);
  irbf.solve({ maxIterations: 1000, tolerance: 1e-8 });
  pull(irbf, where, 1);
};
before();
const converged = irbf.solve({ maxIterations: 3000, tolerance: 1e-10 }).energy;
before();
let iterations = 1;
while (irbf.solve({ maxIterations: 1, tolerance: 0 }).energy > 1.1 * converged) iterations++;

const positions = new Float32Array(3 * irbf.vertexCount);
let energy = 0;
const times = inTurns(40, 1, {
  before,
  frame: () => {
    energy = irbf.solve({ maxIterations: iterations, tolerance: 0 }).energy;
    irbf.deform(positions);
  },
});
if (!(energy <= 1.1 * converged)) throw new Error('The frame was not within 10%.');

if (out) {
  const targets = where.handles.flatMap((_, h) => [...irbf.targets.subarray(10 * h, 10 * h + 3)]);
  const [vertices, triangles] = [Float64Array.from(mesh.positions), Int32Array.from(mesh.triangles)];
  const counts = Int32Array.of(vertices.length / 3, triangles.length / 3, where.handles.length, 0);
  const parts = [counts, vertices, Float64Array.from(targets), triangles, Int32Array.from(where.handles)];
  writeFileSync(out, Buffer.concat(parts.map((part) => Buffer.from(part.buffer))));
}
console.log(JSON.stringify({ frame: times.frame, iterations, overConverged: energy / converged - 1 }));
