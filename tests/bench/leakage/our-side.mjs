/**
 * Our side of the table of leakage: bakes the mesh in the JSON file that the first argument names, writes the body and reads it back, and
 * drags every tip as the second file, arap_side.py's answer, says. `{ bake, irbf }` as JSON in a third argument are options besides.
 */
import { readFileSync } from 'node:fs';
import { load } from '../../../dist/wasm/ts/index.js';
import { attachBody, meshDocument, readBody, readGlb, readMesh, writeGlb } from '../../../dist/web/assets/index.js';

const [meshFile = '', dragsFile = '', given = '{}'] = process.argv.slice(2);
const mesh = JSON.parse(readFileSync(meshFile, 'utf8'));
/** @type {{ tips: number[], targets: [number, number, number][][] }} */
const { tips, targets } = JSON.parse(readFileSync(dragsFile, 'utf8'));
const options = JSON.parse(given);
const hb = await load();
const document = meshDocument({ positions: Float32Array.from(mesh.positions), triangles: Uint32Array.from(mesh.triangles) });
const read = readMesh(document).mesh;
const start = performance.now();
const baked = await hb.bake(read, { ...options.bake, onWarning: () => {} });
const bakeSeconds = (performance.now() - start) / 1000;
await attachBody(document, baked);
const bytes = await writeGlb(document);
const stored = await readBody(await readGlb(bytes));
if (!stored) throw new Error('The body did not come back.');

const positions = Float64Array.from(read.positions);
const at = (/** @type {ArrayLike<number>} */ list, /** @type {number} */ v) =>
  /** @type {[number, number, number]} */ ([list[3 * v] ?? 0, list[3 * v + 1] ?? 0, list[3 * v + 2] ?? 0]);
const apart = (/** @type {number[]} */ a, /** @type {number[]} */ b) => Math.hypot(...a.map((x, axis) => x - (b[axis] ?? 0)));
const { diagonal } = baked.normalization;
const vertices = Array.from({ length: positions.length / 3 }, (_, v) => v);
const regions = tips.map((tip) => vertices.filter((v) => apart(at(positions, v), at(positions, tip)) < 0.05 * diagonal));

/** @param {ArrayLike<number>} points */
function volume(points) {
  let sum = 0;
  for (let t = 0; t < read.triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((corner) => at(points, read.triangles[t + corner] ?? 0));
    if (a && b && c)
      sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}

/** @param {import('../../../dist/wasm/ts/index.js').BodyData} body */
function drag(body) {
  const irbf = hb.irbf(body, options.irbf);
  const handles = tips.map((vertex) => ({ vertex }));
  const poses = targets.map((to) => {
    const one = irbf.share(); // from rest
    one.setHandles(handles);
    to.forEach((place, k) => {
      one.targets.set(place, 10 * k);
    });
    const { anchorError, iterations, converged } = one.solve();
    const pose = new Float32Array(positions.length);
    one.deform(pose);
    one.dispose();
    return { pose, anchorError: anchorError / diagonal, iterations, converged };
  });
  const { smoothness, relativeWidth, condition } = irbf.report();
  irbf.dispose();
  return { poses, smoothness, relativeWidth, condition };
}

const [ours, back] = [drag(baked), drag(stored)];
const rest = volume(positions);
const drags = back.poses.map(({ pose, ...report }, d) => {
  const moved = Math.floor((d * tips.length) / targets.length);
  const motion = regions.map((region) => region.reduce((sum, v) => sum + apart(at(pose, v), at(positions, v)), 0) / region.length);
  const leak = Math.max(...motion.filter((_, k) => k !== moved)) / (motion[moved] ?? Number.NaN);
  const other = /** @type {Float32Array} */ (ours.poses[d]?.pose);
  const readBack = Math.max(...vertices.map((v) => apart(at(pose, v), at(other, v)))) / diagonal;
  return { tip: tips[moved], leak, volume: volume(pose) / rest - 1, readBack, ...report };
});
console.log(
  JSON.stringify({
    vertices: vertices.length,
    bytes: bytes.length,
    bakeSeconds,
    centers: baked.centers.length,
    spheres: baked.spheres.length / 4,
    branches: baked.skeleton?.lengths.length ?? 0,
    voxels: baked.voxels.length,
    smoothness: back.smoothness,
    relativeWidth: back.relativeWidth,
    drags,
  }),
);
