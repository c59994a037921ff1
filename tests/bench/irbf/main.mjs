/**
 * IRBF: the rows of the paper's Table 1 on stand-ins, beside the paper's totals; the deformation beside reading its matrix; wasm beside
 * our core compiled natively (SSE2); a frame and the bent bar beside libigl, which is installed into build/bench-peers by name and
 * version; loading beside baking. In turns in one run, as ratios. Results go to results.json beside this file. Absolute times are those of
 * a noisy machine: compare ratios only.
 */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { cpus, tmpdir } from 'node:os';
import path from 'node:path';
import { at } from '../../../scripts/lib/paths.mjs';
import { mustRun } from '../../../scripts/lib/run.mjs';
import { ensureNative } from '../../../scripts/toolchain.mjs';
import { buildNative, ensurePython, measure, median } from '../support.mjs';
import { caseFile, DEFORMED, makeBodies } from './bodies.mjs';
import { firstFrame } from './first-frame.mjs';
import { print } from './print.mjs';
import { deformation, frame, loading, quality, table1 } from './results.mjs';

const ROUNDS = 5;
const PEERS = at('build', 'bench-peers', 'irbf');
const PYTHON_PEERS = ['numpy==2.4.6', 'scipy==1.17.1', 'libigl==2.6.3'];

/** @typedef {import('../support.mjs').Times} Times */

/** Runs it, prints the tables and writes results.json. */
export async function benchIrbf() {
  await mustRun(process.execPath, [at('scripts', 'build.mjs')]);
  const here = (/** @type {string} */ name) => at('tests', 'bench', 'irbf', name);
  const [noPeer, noNative] = [ensurePython(PEERS, 'igl', PYTHON_PEERS), await ensureNative()];
  if (noPeer) console.log(`libigl: NOT RUN (${noPeer})`);
  if (noNative) console.log(`native side: NOT RUN (${noNative})`);
  const program = noNative ? undefined : await buildNative('sse2', []);
  const folder = mkdtempSync(path.join(tmpdir(), 'handlebody-bench-'));
  try {
    await makeBodies(folder);
    const [shared, bent] = [path.join(folder, 'frame.bin'), path.join(folder, 'bent.bin')];
    const dragged = caseFile(folder, 'welded dog');
    const node = (/** @type {string[]} */ ...args) => measure(process.execPath, args);
    const python = (/** @type {string[]} */ ...args) => measure('python3', args, { ...process.env, PYTHONPATH: PEERS });
    // What does not depend on time is made once.
    const bar = node(here('quality-side.mjs'), bent);
    node(here('frame-side.mjs'), dragged, shared);
    const arapBar = noPeer ? undefined : python(here('quality_side.py'), bent);
    const arap = noPeer ? undefined : python(here('frame_side.py'), shared, 'converge');

    /** @type {Record<string, () => Times>} */
    const sides = { table: () => node(here('table-side.mjs'), folder), frame: () => node(here('frame-side.mjs'), dragged) };
    if (!noPeer) sides.arap = () => python(here('frame_side.py'), shared, '9');
    for (const label of Object.keys(DEFORMED)) {
      const file = caseFile(folder, label);
      sides[`wasm, ${label}`] = () => node(here('deform-side.mjs'), file);
      if (program) sides[`native, ${label}`] = () => measure(program, [file.replace(/v8$/, 'bin')]);
    }
    sides.loading = () => node(here('loading-side.mjs'));
    /** @type {Record<string, Times[]>} */
    const taken = {};
    for (let round = 0; round < ROUNDS; round++)
      for (const [side, run] of Object.entries(sides)) taken[side] = [...(taken[side] ?? []), run()];

    const record = {
      what: 'IRBF: Table 1 on stand-ins, deformation beside reading its matrix once, wasm beside SSE2, a frame and a bent bar beside libigl',
      rounds: ROUNDS,
      processor: cpus()[0]?.model,
      node: process.version,
      peers: PYTHON_PEERS.join(', '),
      table1: table1(taken.table ?? []),
      deformation: deformation(taken),
      frame: frame(taken, arap),
      quality: quality(bar, arapBar),
      loading: loading(taken.loading ?? []),
      loadMilliseconds: Math.round(median((taken.loading ?? []).map((times) => times.load ?? Number.NaN))),
      unpackMilliseconds: Math.round(median((taken.loading ?? []).map((times) => times.unpack ?? Number.NaN))),
      firstFrame: await firstFrame(),
    };
    print(record);
    writeFileSync(here('results.json'), `${JSON.stringify(record, null, 2)}\n`);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
