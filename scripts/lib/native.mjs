// The native C++ build: the fast way to test and to lint the solver.
import path from 'node:path';
import { ensureNative } from '../toolchain.mjs';
import { cmakeBuild } from './cmake.mjs';
import { emscriptenEnvironment } from './emscripten.mjs';
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
  if ((await cmakeBuild(NATIVE_BUILD, { targets: ['handlebody_tests'] })) !== 0) {
    console.error('native suite: does not compile');
    return { run: async () => ({ passed: 0, failed: 1 }) };
  }
  return { run: () => runDoctest(path.join(NATIVE_BUILD, 'handlebody_tests'), []) };
}

/** @param {string} program @param {string[]} args @returns {Promise<Counts>} */
async function runDoctest(program, args) {
  let output = '';
  const status = await run(program, [...args, '--no-colors=1'], {
    behind: true,
    stdio: ['ignore', 'pipe', 'inherit'],
    onOutput: (text) => {
      output += text;
    },
  });
  // In one piece: another suite may be talking meanwhile.
  process.stdout.write(output);
  return readDoctest(output, status);
}

const WASM_TESTS_BUILD = at('build', 'wasm32');
/** Where there is fetch(), Emscripten 3.1.6 takes Node for a browser. */
export const FOR_EMSCRIPTEN = ['--no-experimental-fetch'];

/**
 * Builds what runs in wasm under Node: the native tests, and the fuzz targets that replay files.
 * @param {readonly string[]} targets
 * @returns {Promise<{ problem: string } | { failed: true } | { program(name: string): string }>} why it cannot be done, or where the programs are
 */
export async function buildForNode(targets) {
  if (!which('emcc') || !which('cmake')) return { problem: 'no Emscripten' };
  const problem = await ensureNative();
  if (problem) return { problem };
  const env = emscriptenEnvironment();
  const generator = which('ninja') ? ['-G', 'Ninja'] : [];
  const settings = ['-DCMAKE_BUILD_TYPE=Release', '-DHANDLEBODY_FOR_NODE=ON', '-DHANDLEBODY_FUZZ=replay'];
  const configure = ['cmake', '-S', at('wasm'), '-B', WASM_TESTS_BUILD, ...settings, ...generator];
  if ((await run('emcmake', configure, { env, stdio: ['ignore', 'ignore', 'inherit'] })) !== 0) return { failed: true };
  if ((await cmakeBuild(WASM_TESTS_BUILD, { targets, env })) !== 0) return { failed: true };
  return { program: (name) => path.join(WASM_TESTS_BUILD, `${name}.js`) };
}

/**
 * Builds the native tests for wasm: sizes and indices have 32 bits there, as they have in what ships.
 * @returns {Promise<{ run(): Promise<Counts> } | { notRun: string }>}
 */
export async function prepareWasm32Suite() {
  const built = await buildForNode(['handlebody_tests']);
  if ('problem' in built) return { notRun: built.problem };
  if ('failed' in built) return { run: async () => ({ passed: 0, failed: 1 }) };
  return { run: () => runDoctest(process.execPath, [...FOR_EMSCRIPTEN, built.program('handlebody_tests')]) };
}

/** The numbers of doctest's summary; a run that broke off without one is a failure. @param {string} output @param {number} status @returns {Counts} */
export function readDoctest(output, status) {
  const summary = output.match(/test cases:\s*\d+\s*\|\s*(\d+) passed\s*\|\s*(\d+) failed/);
  const counts = { passed: Number(summary?.[1] ?? 0), failed: Number(summary?.[2] ?? 0) };
  if ((status !== 0 || !summary) && counts.failed === 0) counts.failed = 1;
  return counts;
}
