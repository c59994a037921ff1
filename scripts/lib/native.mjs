// The native C++ build: the fast way to test and to lint the solver.
import path from 'node:path';
import { ensureNative } from '../toolchain.mjs';
import { at } from './paths.mjs';
import { run, which } from './run.mjs';

export const NATIVE_BUILD = at('build', 'native');

/** @typedef {{ passed: number, failed: number }} Counts */
/** @typedef {{ counts: Counts } | { notRun: string }} SuiteResult */

/** Configures build/native, which also writes compile_commands.json. @returns {Promise<string | undefined>} why it could not be done */
export async function configureNative() {
  const problem = await ensureNative();
  if (problem) return problem;
  const generator = which('ninja') ? ['-G', 'Ninja'] : [];
  const status = await run('cmake', ['-S', at('wasm'), '-B', NATIVE_BUILD, '-DCMAKE_BUILD_TYPE=Release', ...generator], {
    stdio: ['ignore', 'ignore', 'inherit'],
  });
  if (status !== 0) throw new Error('cmake could not configure build/native.');
  return undefined;
}

/** Builds and runs the native tests. @returns {Promise<SuiteResult>} */
export async function runNativeSuite() {
  const notRun = await configureNative();
  if (notRun) return { notRun };
  if ((await run('cmake', ['--build', NATIVE_BUILD, '--parallel', '--target', 'handlebody_tests'])) !== 0) {
    console.error('native suite: does not compile');
    return { counts: { passed: 0, failed: 1 } };
  }
  let output = '';
  const status = await run(path.join(NATIVE_BUILD, 'handlebody_tests'), ['--no-colors=1'], {
    stdio: ['ignore', 'pipe', 'inherit'],
    onOutput: (text) => {
      output += text;
      process.stdout.write(text);
    },
  });
  return { counts: readDoctest(output, status) };
}

/** The numbers of doctest's summary; a run that broke off without one is a failure. @param {string} output @param {number} status @returns {Counts} */
export function readDoctest(output, status) {
  const summary = output.match(/test cases:\s*\d+\s*\|\s*(\d+) passed\s*\|\s*(\d+) failed/);
  const counts = { passed: Number(summary?.[1] ?? 0), failed: Number(summary?.[2] ?? 0) };
  if ((status !== 0 || !summary) && counts.failed === 0) counts.failed = 1;
  return counts;
}
