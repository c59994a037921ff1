// @ts-nocheck: it runs in a project of its own, as a user would write it.
// Node: bakes a capsule and reads one that was baked before, compressed; both follow a handle.
import { readFileSync } from 'node:fs';
import { load } from 'handlebody';
import { createIo, readBody, readMesh } from 'handlebody/gltf-transform';

const document = await createIo().readBinary(new Uint8Array(readFileSync('capsule.baked.glb')));
const read = await readBody(document);
const { mesh } = readMesh(document);
const hb = await load();
const baked = await hb.bake(mesh, { centers: 30, resolution: 24, spheres: 4 });
const moved = [baked, read].map((body) => {
  const irbf = hb.irbf(body);
  irbf.setHandles([{ vertex: 0 }, { at: [0, 0, 0] }]);
  irbf.targets[0] += 0.2;
  irbf.solve();
  const out = new Float32Array(mesh.positions.length);
  irbf.deform(out);
  return out[0] - mesh.positions[0];
});
console.log(JSON.stringify({ moved }));
