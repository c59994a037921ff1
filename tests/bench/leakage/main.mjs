/**
 * Leakage: how far the tips of other limbs move when one is dragged, under all defaults, beside libigl's surface ARAP with the same mesh and
 * pins; with it volume, misses, what a file changes, and sizes. Models are the served dog and Spot, the hand of the WebXR input profiles
 * (installed into build/bench-peers like libigl), and made animals (web/models/creatures.ts). Defaults were chosen on those called tuned;
 * the others are reported apart. Results go to results.json beside this file.
 */
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { npm } from '../../../scripts/lib/install.mjs';
import { at } from '../../../scripts/lib/paths.mjs';
import { mustRun } from '../../../scripts/lib/run.mjs';
import { weld } from '../irbf/mesh.mjs';
import { ensurePython, measure } from '../support.mjs';

const PEERS = at('build', 'bench-peers', 'irbf');
const PYTHON_PEERS = ['numpy==2.4.6', 'scipy==1.17.1', 'libigl==2.6.3'];
const HAND = '@webxr-input-profiles/assets@1.0.20';
const VERTICES = 3000;
/** Files and how many tips to look for; made animals know theirs. @type {Record<string, number>} */
const FILES = { dog: 8, spot: 8, hand: 6 };
const TUNED = ['dog', 'spot', 'hand', 'octopus', 'giraffe', 'brontosaurus', 'elephant', 'hippo', 'lizard', 'bird'];
const KEPT_OUT = ['acrobat', 'crane fly', 'flamingo', 'starfish'];

/** @typedef {{ tip: number, leak: number, arap: number, volume: number, readBack: number, anchorError: number, iterations: number, converged: boolean }} Drag */
/** @typedef {{ vertices: number, bytes: number, centers: number, spheres: number, branches: number, voxels: number, relativeWidth: number, smoothness: number, drags: Drag[] }} Row */

/** A drag that leaks more than this is too much. @param {Drag} drag */
const limit = ({ arap }) => Math.max(1.5 * arap, 0.03);

/** Runs it, prints the table and writes results.json. */
export async function benchLeakage() {
  await mustRun(process.execPath, [at('scripts', 'build.mjs'), 'library']);
  const problem = ensurePython(PEERS, 'igl', PYTHON_PEERS);
  if (problem) {
    console.log(`leakage: NOT RUN (${problem})`);
    return;
  }
  const folder = mkdtempSync(path.join(tmpdir(), 'handlebody-bench-'));
  const here = (/** @type {string} */ name) => at('tests', 'bench', 'leakage', name);
  const named = process.env.LEAKAGE_MODELS?.split(',');
  /** @type {Record<string, Row>} */
  const rows = {};
  try {
    for (const name of [...TUNED, ...KEPT_OUT].filter((each) => !named || named.includes(each))) {
      const [mesh, drags] = [path.join(folder, 'mesh.json'), path.join(folder, 'drags.json')];
      await writeMesh(name, mesh);
      const arap = /** @type {any} */ (measure('python3', [here('arap_side.py'), mesh], { ...process.env, PYTHONPATH: PEERS }));
      writeFileSync(drags, JSON.stringify(arap));
      const row = /** @type {Row} */ (
        /** @type {unknown} */ (measure(process.execPath, [here('our-side.mjs'), mesh, drags, process.env.LEAKAGE_OPTIONS ?? '{}']))
      );
      row.drags.forEach((drag, d) => {
        drag.arap = arap.leaks[d];
      });
      rows[name] = row;
      console.log(line(name, row));
    }
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
  const all = (/** @type {string[]} */ names) => names.flatMap((name) => rows[name]?.drags ?? []);
  for (const [what, names] of Object.entries({ tuned: TUNED, 'kept out': KEPT_OUT })) {
    const drags = all(names);
    if (drags.length > 0)
      console.log(`${what}: sum ${sum(drags).toFixed(2)} of ARAP's, ${over(drags)} of ${drags.length} drags too much`);
  }
  if (named || process.env.LEAKAGE_OPTIONS) return;
  const record = {
    what: 'leakage beside libigl’s surface ARAP',
    peers: [...PYTHON_PEERS, HAND].join(', '),
    tuned: TUNED,
    keptOut: KEPT_OUT,
    rows,
  };
  const rounded = JSON.stringify(record, (_, value) => (typeof value === 'number' ? Number(value.toPrecision(4)) : value), 1);
  writeFileSync(here('results.json'), `${rounded}\n`);
}

/** @param {string} name @param {string} file */
async function writeMesh(name, file) {
  const tips = FILES[name];
  if (tips === undefined) {
    await mustRun(process.execPath, [at('scripts', 'assets', 'creatures.mjs'), name, '--vertices', `${VERTICES}`, '-o', file], {
      stdio: ['ignore', 'ignore', 'inherit'],
    });
    const mesh = JSON.parse(readFileSync(file, 'utf8'));
    writeFileSync(file, JSON.stringify({ ...mesh, tips: Object.values(mesh.tips) }));
    return;
  }
  const { readGlb, readMesh, detachBody } = await import('../../../dist/web/assets/index.js');
  const document = await readGlb(readFileSync(name === 'hand' ? await handFile() : at('public', 'models', `${name}.glb`)));
  detachBody(document);
  const { positions, triangles } = weld(readMesh(document).mesh);
  writeFileSync(file, JSON.stringify({ positions: [...positions], triangles: [...triangles], tips }));
}

async function handFile() {
  const folder = at('build', 'bench-peers', 'hand');
  mkdirSync(folder, { recursive: true });
  await npm(['install', '--no-audit', '--no-fund', '--no-save', '--loglevel=error', '--prefix', folder, HAND]);
  return path.join(folder, 'node_modules', '@webxr-input-profiles', 'assets', 'dist', 'profiles', 'generic-hand', 'left.glb');
}

const sum = (/** @type {Drag[]} */ drags) =>
  drags.reduce((all, { leak }) => all + leak, 0) / drags.reduce((all, { arap }) => all + arap, 0);
const over = (/** @type {Drag[]} */ drags) => drags.filter((drag) => drag.leak > limit(drag)).length;
const most = (/** @type {number[]} */ values) => Math.max(...values.map(Math.abs));

/** @param {string} name @param {Row} row */
function line(name, { drags, ...row }) {
  const volumes = drags.map(({ volume }) => Math.abs(volume));
  const percent = (/** @type {number} */ part) => `${(100 * part).toFixed(1)}%`;
  return [
    name.padEnd(14),
    `leaks ${sum(drags).toFixed(2)} × ARAP's, ${over(drags)} of ${drags.length} too much`,
    `volume ${percent(volumes.reduce((a, b) => a + b, 0) / volumes.length)} mean, ${percent(most(volumes))} most`,
    `missed ${most(drags.map(({ anchorError }) => anchorError)).toExponential(0)}`,
    `read back ${most(drags.map(({ readBack }) => readBack)).toExponential(0)}`,
    `${(drags.reduce((all, { iterations }) => all + iterations, 0) / drags.length).toFixed(0)} iterations`,
    `${row.vertices} vertices, ${row.branches} branches, ${row.spheres} spheres, ${row.centers} centers, ${row.voxels} voxels`,
    `width ${row.relativeWidth.toFixed(1)}, ${(row.bytes / 1e6).toFixed(2)} MB`,
  ].join(' · ');
}
