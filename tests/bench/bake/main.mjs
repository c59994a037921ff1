/**
 * Baking beside scikit-fmm, which is installed into build/bench-peers by name and version, in turns in one run, as ratios: the dog's 400
 * centers at 96 voxels. Results go to results.json beside this file. Absolute times are those of a noisy machine: compare ratios only.
 */
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { cpus, tmpdir } from 'node:os';
import path from 'node:path';
import { at } from '../../../scripts/lib/paths.mjs';
import { capture, mustRun } from '../../../scripts/lib/run.mjs';
import { ensureNative } from '../../../scripts/toolchain.mjs';
import { buildNative, ensurePython, measure, median } from '../support.mjs';

const ROUNDS = 7;
const PEERS = at('build', 'bench-peers', 'bake');
const PYTHON_PEERS = ['numpy==2.4.6', 'scikit-fmm==2025.6.23'];

/** @typedef {import('../support.mjs').Times} Times */

/** The served dog's mesh as bench.cpp reads it. @param {string} file */
async function writeDog(file) {
  const { readBody, readGlb } = await import(at('dist', 'web', 'assets', 'index.js'));
  const { positions, triangles } = (await readBody(await readGlb(readFileSync(at('public', 'models', 'dog.glb'))))).mesh;
  const parts = [
    Uint32Array.of(positions.length / 3, triangles.length / 3),
    Float64Array.from(positions),
    Uint32Array.from(triangles),
  ];
  writeFileSync(file, Buffer.concat(parts.map((part) => Buffer.from(part.buffer))));
}

/** Runs it, prints the table and writes results.json. */
export async function benchBake() {
  await mustRun(process.execPath, [at('scripts', 'build.mjs'), 'library']);
  const problem = ensurePython(PEERS, 'skfmm', PYTHON_PEERS) ?? (await ensureNative());
  if (problem) {
    console.log(`bake: NOT RUN (${problem})`);
    return;
  }
  const python = { ...process.env, PYTHONPATH: PEERS };
  const here = (/** @type {string} */ name) => at('tests', 'bench', 'bake', name);
  const program = await buildNative('sse2', [], 'handlebody_bench_bake');
  const folder = mkdtempSync(path.join(tmpdir(), 'handlebody-bench-'));
  try {
    const [mesh, domain] = [path.join(folder, 'mesh.bin'), path.join(folder, 'domain.json')];
    await writeDog(mesh);
    const { status, stdout, stderr } = capture(process.execPath, [here('wasm-side.mjs'), mesh, 'domain']);
    if (status !== 0) throw new Error(`wasm-side.mjs failed: ${stderr}`);
    writeFileSync(domain, stdout);
    /** @type {Record<string, () => Times>} */
    const sides = {
      peer: () => measure('python3', [here('skfmm_side.py'), domain], python),
      wasm: () => measure(process.execPath, [here('wasm-side.mjs'), mesh]),
      native: () => measure(program, [mesh]),
    };
    /** @type {Record<string, Times[]>} */
    const taken = {};
    for (let round = 0; round < ROUNDS; round++)
      for (const [side, run] of Object.entries(sides)) taken[side] = [...(taken[side] ?? []), run()];

    /** Median over rounds of one number over another of the same round. @param {string} a @param {string} stepA @param {string} b @param {string} stepB */
    const ratio = (a, stepA, b, stepB) =>
      median((taken[a] ?? []).map((round, i) => (round[stepA] ?? Number.NaN) / (taken[b]?.[i]?.[stepB] ?? Number.NaN)));
    const last = (/** @type {string} */ side, /** @type {string} */ name) => taken[side]?.at(-1)?.[name] ?? Number.NaN;
    const results = {
      'a center: scikit-fmm / wasm': ratio('peer', 'center', 'wasm', 'center'),
      'a center: scikit-fmm / native': ratio('peer', 'center', 'native', 'center'),
      'whole bake, in scikit-fmm runs, wasm': ratio('wasm', 'whole', 'peer', 'run'),
      'the first of a page, in scikit-fmm runs, wasm': ratio('wasm', 'first', 'peer', 'run'),
      'whole bake, in scikit-fmm runs, native': ratio('native', 'whole', 'peer', 'run'),
      'whole bake, wasm / native': ratio('wasm', 'whole', 'native', 'whole'),
      'memory of the wasm instance, MB': last('wasm', 'megabytes'),
      'voxels inside': last('wasm', 'voxels'),
      'scikit-fmm, ms': median((taken.peer ?? []).map((round) => round.center ?? Number.NaN)),
    };
    console.log(
      `\nThe dog, 400 centers at 96 voxels. Medians of ${ROUNDS} rounds, taken in turns; ${cpus()[0]?.model ?? 'unknown processor'}.\n`,
    );
    for (const [name, value] of Object.entries(results))
      console.log(`${name.padEnd(46)}${String(Number(value.toPrecision(3))).padStart(10)}`);
    const record = {
      what: 'the dog, 400 centers at 96 voxels: a center is its distances to all voxels, their codes and the choice of the next one',
      rounds: ROUNDS,
      processor: cpus()[0]?.model,
      node: process.version,
      peers: PYTHON_PEERS.join(', '),
      results: Object.fromEntries(Object.entries(results).map(([name, value]) => [name, Number(value.toPrecision(3))])),
    };
    writeFileSync(here('results.json'), `${JSON.stringify(record, null, 2)}\n`);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
