/** Table 1 in wasm, through the public interface: prints one JSON object, for each row milliseconds and iterations. The folder of bodies is the first argument. */
import { load } from '../../../dist/wasm/ts/index.js';
import { caseFile, readCase } from './bodies.mjs';
import { inTurns, pull } from './clock.mjs';
import { TABLE_1 } from './table-1.mjs';

const [folder = '.', turns = '7'] = process.argv.slice(2);
/** @type {Record<string, Record<string, number>>} */
const result = {};
for (const row of TABLE_1) {
  const hb = await load();
  const where = readCase(caseFile(folder, row.model));
  const irbf = hb.irbf(where.body);
  irbf.setHandles(where.handles.map((vertex) => ({ vertex })));
  /** From rest: no rotation is left of what was before. */
  const rest = () => {
    pull(irbf, where, 0);
    irbf.solve({ maxIterations: 1 });
    pull(irbf, where, 1);
  };
  rest();
  const energy = irbf.solve({ maxIterations: 3000, tolerance: 1e-10 }).energy;
  rest();
  let enough = 1;
  while (irbf.solve({ maxIterations: 1, tolerance: 0 }).energy > 1.01 * energy && enough < 3000) enough++;

  const out = new Float32Array(3 * irbf.vertexCount);
  let iterations = 0;
  const solve = (/** @type {number} */ maxIterations) => {
    iterations = irbf.solve({ maxIterations, tolerance: 0 }).iterations;
  };
  const times = inTurns(Number(turns), 1, {
    rest,
    solve: () => solve(row.iterations),
    deform: () => irbf.deform(out),
    restAgain: rest,
    enough: () => solve(enough),
    deformAgain: () => irbf.deform(out),
  });
  if (iterations !== enough) throw new Error(`${row.model}: ${iterations} iterations instead of ${enough}.`);
  result[row.model] = {
    vertices: irbf.vertexCount,
    spheres: where.body.spheres.length / 4,
    centers: where.body.centers.length,
    handles: where.handles.length,
    solve: times.solve / row.iterations,
    deform: times.deform,
    total: times.solve + times.deform,
    iterationsToConverge: enough,
    totalToConverge: times.enough + times.deformAgain,
  };
  irbf.dispose();
}
console.log(JSON.stringify(result));
