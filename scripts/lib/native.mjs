// The native C++ build: the fast way to test and to lint the solver.
import path from 'node:path';
import { ensureNative } from '../toolchain.mjs';
import { cmakeBuild } from './cmake.mjs';
import { at } from './paths.mjs';
import { run, which } from './run.mjs';

const NATIVE_BUILD = at('build', 'native');

/** @typedef {{ passed: number, failed: number }} Counts */

/** What clang-tidy reads: how each source is compiled, without g++'s precompiled headers. Nothing is built there. */
export const TIDY_BUILD = at('build', 'tidy');

/**
 * Configures a native build, which also writes compile_commands.json.
 * @param {string} [folder] @param {string[]} [settings]
 * @returns {Promise<string | undefined>} why it could not be done
 */
export async function configureNative(folder = NATIVE_BUILD, settings = []) {
  const problem = await ensureNative();
  if (problem) return problem;
  const generator = which('ninja') ? ['-G', 'Ninja'] : [];
  const status = await run('cmake', ['-S', at('wasm'), '-B', folder, '-DCMAKE_BUILD_TYPE=Release', ...generator, ...settings], {
    stdio: ['ignore', 'ignore', 'inherit'],
  });
  if (status !== 0) throw new Error(`cmake could not configure ${path.relative(at(), folder)}.`);
  return undefined;
}

/** Builds the native tests. @returns {Promise<{ run(): Promise<Counts> } | { notRun: string }>} What runs them, on one core. */
export async function prepareNativeSuite() {
  const notRun = await configureNative();
  if (notRun) return { notRun };
  if ((await cmakeBuild(NATIVE_BUILD, { target: 'handlebody_tests' })) !== 0) {
    console.error('native suite: does not compile');
    return { run: async () => ({ passed: 0, failed: 1 }) };
  }
  return {
    async run() {
      let output = '';
      const status = await run(path.join(NATIVE_BUILD, 'handlebody_tests'), ['--no-colors=1'], {
        stdio: ['ignore', 'pipe', 'inherit'],
        onOutput: (text) => {
          output += text;
        },
      });
      // In one piece: another suite may be talking meanwhile.
      process.stdout.write(output);
      return readDoctest(output, status);
    },
  };
}

/** The numbers of doctest's summary; a run that broke off without one is a failure. @param {string} output @param {number} status @returns {Counts} */
export function readDoctest(output, status) {
  const summary = output.match(/test cases:\s*\d+\s*\|\s*(\d+) passed\s*\|\s*(\d+) failed/);
  const counts = { passed: Number(summary?.[1] ?? 0), failed: Number(summary?.[2] ?? 0) };
  if ((status !== 0 || !summary) && counts.failed === 0) counts.failed = 1;
  return counts;
}
