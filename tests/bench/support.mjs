// What the benchmarks share: building the native side, running a side, and the middle of several rounds.
import { existsSync } from 'node:fs';
import path from 'node:path';
import { cmakeBuild } from '../../scripts/lib/cmake.mjs';
import { at } from '../../scripts/lib/paths.mjs';
import { capture, mustRun, which } from '../../scripts/lib/run.mjs';

/** @typedef {Record<string, number>} Times milliseconds by name */

/** @param {string} name @param {string[]} options @param {string} [target] @returns {Promise<string>} The benchmark's program. */
export async function buildNative(name, options, target = 'handlebody_bench') {
  const folder = at('build', `bench-${name}`);
  await mustRun('cmake', ['-S', at('tests', 'bench'), '-B', folder, '-DCMAKE_BUILD_TYPE=Release', ...options], {
    stdio: ['ignore', 'ignore', 'inherit'],
  });
  if ((await cmakeBuild(folder, { targets: [target] })) !== 0) throw new Error(`${target} does not compile.`);
  return path.join(folder, target);
}

/**
 * Installs Python packages into a folder, by name and version, unless the module that they are wanted for is there.
 * @param {string} folder @param {string} module @param {readonly string[]} packages
 * @returns {string | undefined} why it could not be had
 */
export function ensurePython(folder, module, packages) {
  if (existsSync(path.join(folder, module))) return undefined;
  const python = which('python3');
  if (!python) return 'there is no python3';
  console.log(`Installing ${packages.join(', ')} (pip) …`);
  const { status, stderr } = capture(python, ['-m', 'pip', 'install', '-q', '--target', folder, ...packages]);
  return status === 0 ? undefined : `pip could not install ${packages.join(', ')}: ${stderr.trim().split('\n').at(-1)}`;
}

/** Node 20 may wait for ever at its end for a compilation of JavaScript that waits for a collection (nodejs/node, issue 54918). */
const NODE_OPTIONS = ['--no-concurrent-recompilation'];

/** @param {string} program @param {string[]} args @param {NodeJS.ProcessEnv} [env] @returns {Times} */
export function measure(program, args, env = process.env) {
  const options = program === process.execPath ? NODE_OPTIONS : [];
  const { status, stdout, stderr } = capture(program, [...options, ...args], { env });
  if (status !== 0) throw new Error(`${path.basename(program)} failed: ${stderr}`);
  return JSON.parse(stdout);
}

/** @param {number[]} values */
export const median = (values) => values.toSorted((a, b) => a - b)[Math.floor(values.length / 2)] ?? Number.NaN;
