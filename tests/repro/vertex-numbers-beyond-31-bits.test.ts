import { beforeAll, expect, it } from 'vitest';
import { type Handlebody, load } from '../../wasm/ts/index.ts';
import { errorOf } from '../ts/support/scattered.ts';
import { boxMesh } from '../ts/support/shapes.ts';

// Compared as signed 32-bit numbers, vertex numbers from 2³¹ on (−1 in a caller's list, glTF's primitive restart) were "below" the number of
// vertices and read far outside memory: the solver trapped.
let hb: Handlebody;
beforeAll(async () => {
  hb = await load();
});

const outside = [-1, 2 ** 31, 0xffffffff];

it.each(outside)('a mesh that uses vertex %s is refused by name', async (vertex) => {
  const { positions, triangles } = boxMesh([1, 1, 1], [2, 2, 2]);
  const wrong = { positions, triangles: Array.from(triangles).with(4, vertex) };
  const named = { code: 'mesh-index-out-of-range', culprit: { kind: 'triangle', index: 1 } };
  expect(errorOf(() => hb.biharmonicWeights(wrong, [{ vertex: 0 }]))).toMatchObject(named);
  expect(errorOf(() => hb.measureWeights(wrong, [{ vertex: 0 }], new Float64Array(positions.length / 3)))).toMatchObject(named);
  expect(errorOf(() => hb.tetrahedralize({ positions, triangles: Uint32Array.from(wrong.triangles) }))).toMatchObject(named);
  const body = hb.bake({ positions, triangles: Uint32Array.from(wrong.triangles) }, { resolution: 8 });
  await expect(body).rejects.toMatchObject(named);
});

it.each(outside)('a body whose mesh, centers or measured tetrahedra use vertex %s is refused', async (vertex) => {
  const body = await hb.bake(boxMesh([1, 1, 1], [2, 2, 2]), { centers: 4, resolution: 8, spheres: 1 });
  const mesh = { ...body.mesh, triangles: Uint32Array.from(body.mesh.triangles).with(4, vertex) };
  expect(errorOf(() => hb.irbf({ ...body, mesh })).code).toBe('mesh-index-out-of-range');
  expect(errorOf(() => hb.irbf({ ...body, centers: Uint32Array.from(body.centers).with(1, vertex) })).code).toBe('body-invalid');
  using irbf = hb.irbf(body);
  irbf.setHandles([{ vertex: 0 }]);
  irbf.solve();
  expect(errorOf(() => irbf.report([0, 1, 2, vertex])).code).toBe('mesh-index-out-of-range');
});
