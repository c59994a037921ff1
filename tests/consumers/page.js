// @ts-nocheck: it is bundled as JavaScript, as a user would write it.
// What every consumer bundles: a capsule is baked in a worker, held, pulled, and a vertex read back.
import { load } from 'handlebody/runtime';
import { meshFromObject } from 'handlebody/three';
import { bakeInWorker } from 'handlebody/worker';
import { CapsuleGeometry, Mesh } from 'three';

const told = {};
try {
  const { mesh } = meshFromObject(new Mesh(new CapsuleGeometry(0.3, 1, 4, 12)));
  const onFallback = (reason) => {
    told.fellBack = String(reason);
  };
  const body = await bakeInWorker(mesh, { centers: 30, resolution: 24, spheres: 4, onFallback });
  const irbf = (await load()).irbf(body);
  irbf.setHandles([{ vertex: 0 }, { at: [0, 0, 0] }]);
  irbf.targets[0] += 0.2;
  irbf.solve();
  const out = new Float32Array(mesh.positions.length);
  irbf.deform(out);
  told.moved = out[0] - mesh.positions[0];
} catch (error) {
  told.error = String(error);
}
document.title = JSON.stringify(told);
