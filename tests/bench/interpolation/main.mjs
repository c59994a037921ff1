/**
 * Scattered interpolation beside the peers that a user would pick, in turns in one run, as ratios: our wasm and our core compiled natively,
 * SciPy's RBFInterpolator and npm's `rbf`, which are installed into build/bench-peers by name and version. Results go to results.json
 * beside this file. Absolute times are those of a noisy machine: compare ratios only.
 */
import { existsSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { cpus, tmpdir } from 'node:os';
import path from 'node:path';
import { npm } from '../../../scripts/lib/install.mjs';
import { at } from '../../../scripts/lib/paths.mjs';
import { mustRun } from '../../../scripts/lib/run.mjs';
import { ensureNative } from '../../../scripts/toolchain.mjs';
import { buildNative, ensurePython, measure, median } from '../support.mjs';
import { COUNTS, writeData } from './setup.mjs';

const ROUNDS = 7;
const PEERS = at('build', 'bench-peers');
const PYTHON_PEERS = ['numpy==2.4.6', 'scipy==1.17.1'];
const KERNELS = ['thin-plate', 'gaussian', 'multiquadric'];

/** @typedef {import('../support.mjs').Times} Times */

/** Installs npm's rbf. @returns {Promise<string | undefined>} why it could not be had */
async function ensureNpmRbf() {
  if (existsSync(path.join(PEERS, 'node_modules', 'rbf'))) return undefined;
  mkdirSync(PEERS, { recursive: true });
  writeFileSync(path.join(PEERS, 'package.json'), '{ "private": true }\n');
  try {
    await npm(['install', '--prefix', PEERS, '--no-audit', '--no-fund', '--loglevel=error', 'rbf@1.1.5']);
    return undefined;
  } catch {
    return 'npm could not install rbf';
  }
}

/** Settings of one machine for NumPy's BLAS are not what a user has. */
function scipyEnvironment() {
  const own = Object.entries(process.env).filter(([name]) => !name.startsWith('OPENBLAS_'));
  return { ...Object.fromEntries(own), PYTHONPATH: path.join(PEERS, 'python') };
}

/** Runs it, prints the table and writes results.json. */
export async function benchInterpolation() {
  await mustRun(process.execPath, [at('scripts', 'build.mjs'), 'library']);
  const folder = mkdtempSync(path.join(tmpdir(), 'handlebody-bench-'));
  try {
    const file = path.join(folder, 'data.bin');
    writeData(file);
    const here = (/** @type {string} */ name) => at('tests', 'bench', 'interpolation', name);
    /** @type {Record<string, () => Times>} */
    const sides = { wasm: () => measure(process.execPath, [here('wasm-side.mjs')]) };
    const add = (/** @type {string} */ name, /** @type {string | undefined} */ problem, /** @type {() => Times} */ run) => {
      if (problem) console.log(`${name}: NOT RUN (${problem})`);
      else sides[name] = run;
    };
    const problem = await ensureNative();
    const native = problem ? '' : await buildNative('sse2', [], 'handlebody_bench_interpolation');
    add('native', problem, () => measure(native, [file]));
    add('scipy', ensurePython(path.join(PEERS, 'python'), 'scipy', PYTHON_PEERS), () =>
      measure('python3', [here('scipy_side.py'), file], scipyEnvironment()),
    );
    add('npm', await ensureNpmRbf(), () => measure(process.execPath, [here('npm-rbf-side.mjs'), PEERS]));

    /** @type {Record<string, Times[]>} */
    const taken = {};
    for (let round = 0; round < ROUNDS; round++)
      for (const [side, run] of Object.entries(sides)) taken[side] = [...(taken[side] ?? []), run()];

    /** Of a sum of steps. @param {string} side @param {string[]} steps */
    const times = (side, steps) =>
      (taken[side] ?? []).map((round) => steps.reduce((sum, step) => sum + (round[step] ?? Number.NaN), 0));
    /** @param {string} a @param {string[]} stepsA @param {string} b @param {string[]} [stepsB] */
    const ratio = (a, stepsA, b, stepsB = stepsA) => {
      const [above, below] = [times(a, stepsA), times(b, stepsB)];
      return below.length ? median(above.map((time, i) => time / (below[i] ?? Number.NaN))) : Number.NaN;
    };
    /** @type {[string, Record<string, number>][]} */
    const rows = KERNELS.flatMap((kernel) => {
      const both = [`${kernel} fit`, `${kernel} evaluate`];
      return [
        [`${kernel}: fit and evaluate`, both],
        [`${kernel}: fit`, both.slice(0, 1)],
        [`${kernel}: evaluate`, both.slice(1)],
      ].map(([label, steps]) => {
        const list = /** @type {string[]} */ (steps);
        return /** @type {[string, Record<string, number>]} */ ([
          label,
          {
            milliseconds: median(times('wasm', list)),
            overNative: ratio('wasm', list, 'native'),
            overScipy: ratio('wasm', list, 'scipy'),
            npmOverOurs: ratio('npm', list, 'wasm'),
          },
        ]);
      });
    });
    const poses = {
      milliseconds: median(times('wasm', ['poses'])),
      overNative: ratio('wasm', ['poses'], 'native'),
      overBareProductsInJavaScript: ratio('wasm', ['poses'], 'wasm', ['products']),
      overNativeBareProducts: ratio('wasm', ['poses'], 'native', ['products']),
      nativeOverNativeBareProducts: ratio('native', ['poses'], 'native', ['products']),
      oneByOneOverBareProductsInJavaScript: ratio('wasm', ['poses one by one'], 'wasm', ['products']),
    };
    print(rows, poses);
    const rounded = (/** @type {Record<string, number>} */ row) =>
      Object.fromEntries(Object.entries(row).map(([name, value]) => [name, Number(value.toPrecision(3))]));
    const record = {
      what: `${COUNTS.points} points in 2D, ${COUNTS.queries} evaluations, a linear tail; ${COUNTS.poses} poses of ${COUNTS.outputs} outputs from ${COUNTS.examples} examples`,
      rounds: ROUNDS,
      processor: cpus()[0]?.model,
      node: process.version,
      peers: [...PYTHON_PEERS, 'rbf@1.1.5'].join(', '),
      results: Object.fromEntries(rows.map(([label, row]) => [label, rounded(row)])),
      poses: rounded(poses),
    };
    writeFileSync(here('results.json'), `${JSON.stringify(record, null, 2)}\n`);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

/** @param {[string, Record<string, number>][]} rows @param {Record<string, number>} poses */
function print(rows, poses) {
  console.log(
    `\n${COUNTS.points} points in 2D, ${COUNTS.queries} evaluations. Medians of ${ROUNDS} rounds, taken in turns; ${cpus()[0]?.model ?? 'unknown processor'}.\n`,
  );
  const line = (/** @type {string} */ label, /** @type {string[]} */ cells) =>
    console.log([label.padEnd(32), ...cells.map((cell) => cell.padStart(14))].join(''));
  line('', ['wasm ms', 'wasm/native', 'wasm/SciPy', 'npm rbf/wasm']);
  for (const [label, row] of rows)
    line(
      label,
      Object.values(row).map((value) => value.toFixed(2)),
    );
  console.log(`\n${COUNTS.poses} poses of ${COUNTS.outputs} outputs from ${COUNTS.examples} examples:`);
  for (const [name, value] of Object.entries(poses)) line(`  ${name}`, [value.toFixed(2)]);
}
