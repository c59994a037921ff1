/**
 * The dog in our wasm and in our core compiled natively (SSE2, and this machine's own instructions), taken in turns
 * in one run, as ratios. Results go to tests/bench/results.json. Absolute times are those of a noisy machine: compare ratios only.
 */
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { cpus, tmpdir } from 'node:os';
import path from 'node:path';
import { at } from '../../scripts/lib/paths.mjs';
import { mustRun } from '../../scripts/lib/run.mjs';
import { ensureNative } from '../../scripts/toolchain.mjs';
import { bodyFile } from './body-file.mjs';
import { firstFrame } from './first-frame.mjs';
import { SETUP } from './setup.mjs';
import { buildNative, measure, median } from './support.mjs';

const ROUNDS = 5;

/** @typedef {import('./support.mjs').Times} Times */

/** Runs it, prints the table and writes results.json. */
export async function benchIrbf() {
  await mustRun(process.execPath, [at('scripts', 'build.mjs')]);
  const { readBody, readGlb } = await import('../../dist/web/assets/index.js');
  const body = await readBody(await readGlb(readFileSync(SETUP.model)));
  if (!body) throw new Error('The model carries no body.');
  const folder = mkdtempSync(path.join(tmpdir(), 'handlebody-bench-'));
  try {
    const file = path.join(folder, 'dog.bin');
    const [x, y, z] = SETUP.shift.map((part) => part * body.normalization.diagonal);
    writeFileSync(file, bodyFile(body, SETUP.handles, [x ?? 0, y ?? 0, z ?? 0]));

    /** @type {Record<string, () => Times>} */
    const sides = { wasm: () => measure(process.execPath, [at('tests', 'bench', 'wasm-side.mjs')]) };
    const missing = await ensureNative();
    if (missing) {
      console.log(`native side: NOT RUN (${missing})`);
    } else {
      const sse2 = await buildNative('sse2', []);
      const own = await buildNative('own', ['-DHANDLEBODY_NATIVE_ARCH=ON']);
      sides.sse2 = () => measure(sse2, [file]);
      sides.own = () => measure(own, [file]);
    }
    /** @type {Record<string, Times[]>} */
    const taken = {};
    for (let round = 0; round < ROUNDS; round++) {
      for (const [side, run] of Object.entries(sides)) taken[side] = [...(taken[side] ?? []), run()];
    }
    const rows = ['prepare', 'factor', 'solve', 'deform', 'deformNormals'];
    /** @param {string} side @param {string} row */
    const time = (side, row) => median((taken[side] ?? []).map((times) => times[row] ?? Number.NaN));
    /** @param {string} side @param {string} row */
    const ratio = (side, row) =>
      median((taken.wasm ?? []).map((times, i) => (times[row] ?? Number.NaN) / (taken[side]?.[i]?.[row] ?? Number.NaN)));

    const counts = `${body.mesh.positions.length / 3} vertices, ${body.centers.length} centers, ${body.spheres.length / 4} spheres, ${SETUP.handles.length} handles`;
    console.log(`\nDog: ${counts}. Medians of ${ROUNDS} rounds, taken in turns; ${cpus()[0]?.model ?? 'unknown processor'}.\n`);
    console.log(
      ['', 'wasm ms', 'SSE2 ms', 'own ms', 'wasm/SSE2', 'wasm/own'].map((c, i) => (i ? c.padStart(10) : c.padEnd(22))).join(''),
    );
    const labels = {
      prepare: 'prepare the body',
      factor: 'factor (set handles)',
      solve: 'solve, 30 iterations',
      deform: 'deform',
      deformNormals: 'deform with normals',
    };
    /** @type {Record<string, unknown>} */
    const results = {};
    for (const row of rows) {
      const cells = [time('wasm', row), time('sse2', row), time('own', row), ratio('sse2', row), ratio('own', row)];
      results[row] = {
        wasmOverSse2: Number(cells[3]?.toFixed(2)),
        wasmOverOwn: Number(cells[4]?.toFixed(2)),
        wasmMilliseconds: Number(cells[0]?.toFixed(3)),
      };
      console.log(
        [labels[/** @type {keyof typeof labels} */ (row)].padEnd(22), ...cells.map((c) => c.toFixed(2).padStart(10))].join(''),
      );
    }
    const load = time('wasm', 'load');
    const frame = await firstFrame();
    console.log(
      `\nload() in Node: ${load.toFixed(0)} ms. Studio in headless Chromium (software rendering), from navigation: ${frame}`,
    );
    const record = {
      what: `dog: ${counts}`,
      rounds: ROUNDS,
      processor: cpus()[0]?.model,
      node: process.version,
      results,
      loadMilliseconds: Math.round(load),
      firstFrame: frame,
    };
    writeFileSync(at('tests', 'bench', 'results.json'), `${JSON.stringify(record, null, 2)}\n`);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
