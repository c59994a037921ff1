/**
 * Skinning beside libigl, which is installed into build/bench-peers by name and version, in turns in one run, as ratios: weights of a made
 * gingerbread man of 2,250 vertices and 6 handles, and a frame of 20,000 vertices and 10 handles beside a copy of the bytes that it touches.
 * Results go to results.json beside this file. Absolute times are those of a noisy machine: compare ratios only.
 */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { cpus, tmpdir } from 'node:os';
import path from 'node:path';
import { at } from '../../../scripts/lib/paths.mjs';
import { capture, mustRun } from '../../../scripts/lib/run.mjs';
import { ensureNative } from '../../../scripts/toolchain.mjs';
import { buildNative, ensurePython, measure, median } from '../support.mjs';

const ROUNDS = 5;
const VERTICES = 2250;
const PEERS = at('build', 'bench-peers', 'skinning');
const PYTHON_PEERS = ['numpy==2.4.6', 'scipy==1.17.1', 'libigl==2.6.3'];

/** @typedef {import('../support.mjs').Times} Times */

/** Runs it, prints the table and writes results.json. */
export async function benchSkinning() {
  await mustRun(process.execPath, [at('scripts', 'build.mjs'), 'library']);
  const problem = ensurePython(PEERS, 'igl', PYTHON_PEERS) ?? (await ensureNative());
  if (problem) {
    console.log(`skinning: NOT RUN (${problem})`);
    return;
  }
  const python = { ...process.env, PYTHONPATH: PEERS };
  const here = (/** @type {string} */ name) => at('tests', 'bench', 'skinning', name);
  const weightsProgram = await buildNative('sse2', [], 'handlebody_bench_weights');
  const skinProgram = await buildNative('sse2', [], 'handlebody_bench_skinning');
  const folder = mkdtempSync(path.join(tmpdir(), 'handlebody-bench-'));
  try {
    const mesh = path.join(folder, 'mesh.txt');
    const { status, stderr } = capture('python3', [here('gingerbread.py'), String(VERTICES), mesh], { env: python });
    if (status !== 0) throw new Error(`gingerbread.py failed: ${stderr}`);
    /** @type {Record<string, () => Times>} */
    const sides = {
      wasm: () => measure(process.execPath, [here('weights-wasm-side.mjs'), mesh, '9']),
      native: () => measure(weightsProgram, [mesh, '9']),
      libigl: () => measure('python3', [here('libigl_side.py'), mesh, '1'], python),
      skinWasm: () => measure(process.execPath, [here('wasm-side.mjs')]),
      skinNative: () => measure(skinProgram, []),
    };
    /** @type {Record<string, Times[]>} */
    const taken = {};
    for (let round = 0; round < ROUNDS; round++)
      for (const [side, run] of Object.entries(sides)) taken[side] = [...(taken[side] ?? []), run()];

    /** Median over rounds of one number over another of the same round. @param {string} a @param {string} stepA @param {string} b @param {string} [stepB] */
    const ratio = (a, stepA, b, stepB = stepA) =>
      median((taken[a] ?? []).map((round, i) => (round[stepA] ?? Number.NaN) / (taken[b]?.[i]?.[stepB] ?? Number.NaN)));
    const last = (/** @type {string} */ side, /** @type {string} */ name) => taken[side]?.at(-1)?.[name] ?? Number.NaN;
    const weights = {
      'harmonic, wasm / libigl': ratio('wasm', 'harmonic', 'libigl'),
      'biharmonic, wasm / libigl': ratio('wasm', 'biharmonic', 'libigl'),
      'biharmonic, wasm / native': ratio('wasm', 'biharmonic', 'native'),
      'a handle more, part of the first solve': ratio('wasm', 'add', 'wasm', 'biharmonic'),
      'a handle moved, part of the first solve': ratio('wasm', 'move', 'wasm', 'biharmonic'),
      'factorizations for these': last('wasm', 'factored'),
      'bounded, wasm / libigl': ratio('wasm', 'bounded', 'libigl', 'bbw'),
      'bounded, wasm / libigl of 8 active sets': ratio('wasm', 'bounded', 'libigl', 'bbw 8'),
      'bounded, wasm / native': ratio('wasm', 'bounded', 'native'),
      "bounded energy / libigl's, rows normalized": last('wasm', 'energy') / last('libigl', 'bbw energy'),
      'bounded, rows off 1': last('wasm', 'rows off 1'),
      "libigl's rows off 1 before": last('libigl', 'bbw rows off 1'),
      'bounded, outside [0, 1]': last('wasm', 'outside'),
    };
    /** @type {Record<string, Record<string, number>>} */
    const skins = {};
    for (const form of ['direct 2D', 'compiled 2D', 'dual quaternion 2D', 'direct 3D', 'compiled 3D', 'dual quaternion 3D']) {
      const copy = form.replace(/ (?=\dD)/, ' copy ');
      skins[form] = {
        wasmOverCopy: ratio('skinWasm', form, 'skinWasm', copy),
        wasmWithoutTheWayOut: median(
          (taken.skinWasm ?? []).map((round) => {
            const of = (/** @type {string} */ step) => round[step] ?? Number.NaN;
            return (of(form) - of(form.replace(/ (?=\dD)/, ' out '))) / of(copy);
          }),
        ),
        nativeOverCopy: ratio('skinNative', form, 'skinNative', copy),
        wasmOverNative: ratio('skinWasm', form, 'skinNative'),
        overDirect: ratio('skinWasm', form, 'skinWasm', form.endsWith('2D') ? 'direct 2D' : 'direct 3D'),
      };
    }
    print(weights, skins);
    const rounded = (/** @type {Record<string, number>} */ row) =>
      Object.fromEntries(Object.entries(row).map(([name, value]) => [name, Number(value.toPrecision(3))]));
    const record = {
      what: `weights: ${VERTICES} vertices, 6 handles; skinning: 20,000 vertices, 10 handles, beside a copy of the bytes to touch`,
      rounds: ROUNDS,
      processor: cpus()[0]?.model,
      node: process.version,
      peers: PYTHON_PEERS.join(', '),
      weights: rounded(weights),
      skinning: Object.fromEntries(Object.entries(skins).map(([form, row]) => [form, rounded(row)])),
    };
    writeFileSync(here('results.json'), `${JSON.stringify(record, null, 2)}\n`);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

/** @param {Record<string, number>} weights @param {Record<string, Record<string, number>>} skins */
function print(weights, skins) {
  console.log(
    `\nWeights of ${VERTICES} vertices and 6 handles. Medians of ${ROUNDS} rounds, taken in turns; ${cpus()[0]?.model ?? 'unknown processor'}.\n`,
  );
  for (const [name, value] of Object.entries(weights)) console.log(`${name.padEnd(46)}${value.toPrecision(3).padStart(10)}`);
  console.log(
    '\nA frame of 20,000 vertices and 10 handles, over a copy of the bytes that it touches; itself: less the way into the array of the caller:\n',
  );
  console.log(
    `${''.padEnd(22)}${['wasm', 'wasm, itself', 'native', 'wasm/native', 'over direct'].map((cell) => cell.padStart(13)).join('')}`,
  );
  for (const [form, row] of Object.entries(skins))
    console.log(
      form.padEnd(22) +
        Object.values(row)
          .map((value) => value.toFixed(2).padStart(13))
          .join(''),
    );
}
