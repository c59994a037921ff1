// The bodies that are measured, baked here and put into files: with v8's format for the wasm sides, with body-file.mjs's for the native one.
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { deserialize, serialize } from 'node:v8';
import { at } from '../../../scripts/lib/paths.mjs';
import { bodyFile } from './body-file.mjs';
import { splitLongest, weld } from './mesh.mjs';
import { SETUP } from './setup.mjs';
import { STAND_INS, TABLE_1 } from './table-1.mjs';

/** @typedef {import('../../../wasm/ts/index.ts').BodyData} BodyData */
/** A body, and where it is held: vertices, of which the first moves by `shift`, model units. @typedef {{ body: BodyData, handles: number[], shift: [number, number, number] }} Case */

/** What the deformation is measured on: vertices as they are or to be made, and centers. */
export const DEFORMED = {
  'dog, 200 centers': { centers: 200 },
  'dog, 400 centers': { centers: 400 },
  '40,000 × 241': { vertices: 40_000, centers: 241 },
  '173,000 × 404': { vertices: 173_000, centers: 404 },
};

/** @param {string} folder @param {string} name */
export const caseFile = (folder, name) => path.join(folder, `${name.replaceAll(/[^\w]+/g, '-')}.v8`);
/** @param {string} file @returns {Case} */
export const readCase = (file) => deserialize(readFileSync(file));

/**
 * Bakes them and writes the files.
 * @param {string} folder
 * @returns {Promise<void>}
 */
export async function makeBodies(folder) {
  const { load } = await import('../../../dist/wasm/ts/index.js');
  const { hashPositions } = await import('../../../dist/wasm/ts/hash.js');
  const { readBody, readGlb } = await import('../../../dist/web/assets/index.js');
  const served = async (/** @type {string} */ name) => {
    const body = await readBody(await readGlb(readFileSync(at('public', 'models', name))));
    if (!body) throw new Error(`${name} carries no body.`);
    return body.mesh;
  };
  /** @param {string} name @param {Case} made */
  const keep = (name, made) => writeFileSync(caseFile(folder, name), serialize(made));
  /** The same surface with more vertices, fewer centers and fewer spheres. @param {BodyData} body @param {import('./mesh.mjs').Mesh} mesh @param {number} centers @param {number} spheres @returns {BodyData} */
  const part = (body, mesh, centers, spheres) => ({
    ...body,
    mesh,
    positionsHash: hashPositions(mesh.positions),
    centers: body.centers.slice(0, centers),
    distances: body.distances.slice(0, centers * body.voxels.length),
    spheres: body.spheres.slice(0, 4 * spheres),
  });

  for (const [name, { shape, centers, resolution, packing }] of Object.entries(STAND_INS)) {
    const hb = await load();
    const mesh = typeof shape === 'string' ? await served(shape) : shape();
    const baked = await hb.bake(mesh, { centers, resolution });
    // What a sphere is does not depend on the grid of the distances.
    const { spheres } = await hb.bake(mesh, { centers: 1, resolution: packing, spheres: 300 });
    const { diagonal } = baked.normalization;
    const shift = /** @type {[number, number, number]} */ (SETUP.shift.map((x) => x * diagonal));
    if (name === 'dog') {
      for (const [label, size] of Object.entries(DEFORMED)) {
        if ('vertices' in size) continue;
        const body = part({ ...baked, spheres }, /** @type {import('./mesh.mjs').Mesh} */ (mesh), size.centers, 112);
        keep(label, { body, handles: SETUP.handles, shift });
      }
    }
    const { to, ...welded } = weld(mesh);
    const body = { ...baked, spheres, centers: baked.centers.map((v) => to[v] ?? 0) };
    // Centers are sampled farthest first, so the first of them are extremities.
    const handles = Array.from(body.centers.subarray(0, 6));
    for (const row of TABLE_1) {
      if (row.standIn !== name) continue;
      if (spheres.length < 4 * row.spheres) throw new Error(`${row.model}: the packing has ${spheres.length / 4} spheres only.`);
      const refined = splitLongest(welded, row.vertices);
      keep(row.model, { body: part(body, refined, row.centers, row.spheres), handles, shift });
    }
    if (name === 'dog') {
      keep('welded dog', { body: part(body, welded, 200, 112), handles: SETUP.handles.map((v) => to[v] ?? 0), shift });
      for (const [label, size] of Object.entries(DEFORMED))
        if ('vertices' in size)
          keep(label, { body: part(body, splitLongest(welded, size.vertices), size.centers, 79), handles, shift });
    }
  }
  for (const label of Object.keys(DEFORMED)) {
    const file = caseFile(folder, label);
    const { body, handles, shift } = readCase(file);
    writeFileSync(file.replace(/v8$/, 'bin'), bodyFile(body, handles, shift));
  }
}
