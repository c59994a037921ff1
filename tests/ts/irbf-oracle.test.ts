import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { type BodyData, hashPositions, load } from '../../wasm/ts/index.ts';

/**
 * tests/oracles/irbf.py solves paper 001's equations directly. The two agree to 1e-4 of the diagonal, not to rounding: interior distances
 * are stored in 16 bits, and are read back through stencils that may exceed them by a few codes.
 */
it('deforms as the equations of paper 001 do when they are solved directly', async () => {
  const oracle = JSON.parse(readFileSync(new URL('../oracles/irbf.json', import.meta.url), 'utf8'));
  const { grid, normalization } = oracle;
  const positions = Float64Array.from(oracle.positions);
  const [nx, ny, nz] = grid.dimensions as [number, number, number];
  const voxels = Uint32Array.from({ length: nx * ny * nz }, (_, i) => i);
  const distances = new Uint16Array(oracle.centers.length * voxels.length);
  for (const [c, vertex] of (oracle.centers as number[]).entries()) {
    for (const v of voxels) {
      const index = [v % nx, Math.floor(v / nx) % ny, Math.floor(v / (nx * ny))];
      const offsets = index.map(
        (i, axis) =>
          grid.origin[axis] +
          grid.spacing * i -
          ((positions[3 * vertex + axis] ?? 0) - normalization.center[axis]) / normalization.diagonal,
      );
      distances[c * voxels.length + v] = Math.floor(Math.hypot(...offsets) / oracle.distanceScale);
    }
  }
  const body: BodyData = {
    version: 1,
    distance: 'euclidean',
    mesh: { positions, triangles: Uint32Array.from(oracle.triangles) },
    positionsHash: hashPositions(positions),
    normalization,
    grid,
    voxels,
    centers: Uint32Array.from(oracle.centers),
    distances,
    distanceScale: oracle.distanceScale,
    spheres: Float64Array.from(oracle.spheres),
  };

  const irbf = (await load()).irbf(body, { ...oracle.options, poissonRatio: 0 });
  irbf.setHandles((oracle.handles as number[]).map((vertex) => ({ vertex })));
  for (let k = 0; k < irbf.handleCount; k++) irbf.targets.set(oracle.targets.slice(3 * k, 3 * k + 3), 10 * k);
  const report = irbf.solve({ maxIterations: 20_000, tolerance: 1e-12 });
  const out = irbf.evaluate(positions);
  const worst = out.reduce((most, x, i) => Math.max(most, Math.abs(x - oracle.deformed[i])), 0) / normalization.diagonal;
  expect(worst).toBeLessThan(1e-4);
  expect(Math.abs(report.energy / oracle.energy - 1)).toBeLessThan(1e-3);
});
