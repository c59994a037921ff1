/**
 * Our side of the bent bar: a Kuhn grid of 45 × 9 × 9 cells, 100 centers, 9 spheres, held at its corners. Prints one JSON object of reports,
 * and writes the tetrahedra and our poses into the file that the first argument names, for quality_side.py.
 */
import { writeFileSync } from 'node:fs';
import { hashPositions } from '../../../dist/wasm/ts/hash.js';
import { load } from '../../../dist/wasm/ts/index.js';
import { weld } from './mesh.mjs';
import { kuhnGrid } from './shapes.mjs';

const [file] = process.argv.slice(2);
const hb = await load();
const grid = kuhnGrid([10, 2, 2], [45, 9, 9]);
// Centers sit on the surface, where the vertices of the grid are not all.
const surface = [...new Set(grid.triangles)].toSorted((a, b) => a - b);
const numbers = new Map(surface.map((v, i) => [v, i]));
const baked = await hb.bake(
  weld({
    positions: surface.flatMap((v) => [...grid.positions.subarray(3 * v, 3 * v + 3)]),
    triangles: grid.triangles.map((v) => numbers.get(v) ?? 0),
  }),
  { centers: 100, spheres: 9 },
);
const body = {
  ...baked,
  mesh: { positions: grid.positions, triangles: grid.triangles },
  positionsHash: hashPositions(grid.positions),
  centers: baked.centers.map((center) => surface[center] ?? 0),
};

const corners = surface.filter((v) => {
  const [x, y, z] = grid.positions.subarray(3 * v, 3 * v + 3);
  return (x === 0 || x === 10) && (y === 0 || y === 2) && (z === 0 || z === 2);
});
/** A quarter of a circle about (0, 1 + R) that is as long as the bar. */
const radius = 20 / Math.PI;
const targets = corners.flatMap((v) => {
  const [x = 0, y = 0, z = 0] = grid.positions.subarray(3 * v, 3 * v + 3);
  return x === 0 ? [x, y, z] : [radius - (y - 1), 1 + radius, z];
});

/** @type {Record<string, unknown>} */
const reports = {};
/** @type {Float64Array[]} */
const poses = [];
for (const [name, options] of /** @type {[string, import('../../../wasm/ts/index.ts').IrbfOptions][]} */ ([
  ['IRBF', {}],
  ['IRBF, relativeWidth 4', { relativeWidth: 4 }],
  ['IRBF, Gaussian, relativeWidth 4', { relativeWidth: 4, kernel: 'gaussian' }],
])) {
  const irbf = hb.irbf(body, options);
  irbf.setHandles(corners.map((vertex) => ({ vertex })));
  corners.forEach((_, i) => {
    irbf.targets.set(targets.slice(3 * i, 3 * i + 3), 10 * i);
  });
  irbf.solve({ maxIterations: 3000, tolerance: 1e-10 });
  const pose = new Float32Array(3 * irbf.vertexCount);
  irbf.deform(pose);
  poses.push(Float64Array.from(pose));
  const { volumeRatio, distortion, flips, tetrahedra } = irbf.report(grid.tetrahedra);
  reports[name] = { volume: volumeRatio, ...distortion, flips, tetrahedra };
}
if (file) {
  const counts = Int32Array.of(grid.positions.length / 3, grid.tetrahedra.length / 4, corners.length, poses.length);
  const parts = [
    counts,
    grid.positions,
    Float64Array.from(targets),
    ...poses,
    Int32Array.from(grid.tetrahedra),
    Int32Array.from(corners),
  ];
  writeFileSync(file, Buffer.concat(parts.map((part) => Buffer.from(part.buffer))));
}
console.log(JSON.stringify({ spheres: body.spheres.length / 4, centers: body.centers.length, reports }));
