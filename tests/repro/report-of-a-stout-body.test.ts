import { expect, it } from 'vitest';
import { load } from '../../wasm/ts/index.ts';
import { boxMesh } from '../ts/support/shapes.ts';

// Eight corners a voxel were reckoned with, where stout bodies have one: a bunny's deformation "might take 1148 MB" to measure.
it('measures a stout body: 262,144 voxels and 120 centers', async () => {
  const hb = await load();
  const body = await hb.bake(boxMesh([1, 1, 1], [6, 6, 6]), { centers: 120, resolution: 64, spheres: 10, distance: 'euclidean' });
  const irbf = hb.irbf(body);
  irbf.setHandles([{ vertex: 0 }, { at: [0.5, 0.5, 0.5] }]);
  irbf.solve();
  expect(irbf.report().tetrahedra).toBe(6 * 64 ** 3);
  irbf.dispose();
});
