// `npm run lint`: formatting, linting, types and layering of everything that is ours. With --fix it formats first. Checks that need a
// tool of the C++ side are reported as not run where it is missing, and fail under REQUIRE_NATIVE=1. `npm run lint -- types layers` runs
// only these, and `npm run lint -- --except clang-tidy` all others.
import { readFileSync } from 'node:fs';
import { isCpp } from './lib/imports.mjs';
import { ensureInstalled } from './lib/install.mjs';
import { configureNative, TIDY_BUILD } from './lib/native.mjs';
import { at } from './lib/paths.mjs';
import { run, runMain, which } from './lib/run.mjs';
import { isLeftOver, sourceFiles } from './lib/sources.mjs';
import { tidy } from './lib/tidy.mjs';
import { findMachinePaths } from './lib/words.mjs';

const args = process.argv.slice(2);
const fix = args.includes('--fix');
const except = args.includes('--except');
const named = args.filter((arg) => arg !== '--fix' && arg !== '--except');
const tool = (/** @type {string[]} */ ...parts) => at('node_modules', ...parts);
const node = (/** @type {string[]} */ ...args) => run(process.execPath, args);

const sources = sourceFiles();
// The C interface keeps one function a line, however long: scripts/generate.mjs and CMake read it by lines.
const cpp = sources.filter((file) => isCpp(file) && /^(wasm|tests)\//.test(file) && file !== 'wasm/abi/handlebody.h');

/** A check ends with 0, with a failing status, or with the reason why it could not run. @type {[string, () => Promise<number | string>][]} */
const CHECKS = [
  ['biome', () => node(tool('@biomejs', 'biome', 'bin', 'biome'), 'check', '--error-on-warnings', ...(fix ? ['--write'] : []))],
  // The library first: what runs on dist/ is checked against its declarations.
  ['types', async () => (await node(at('scripts', 'build.mjs'), 'library')) || node(tool('typescript', 'bin', 'tsc'), '--noEmit')],
  ['layers', () => node(at('scripts', 'lint-layers.mjs'))],
  ['tests', () => node(at('scripts', 'lint-tests.mjs'))],
  ['exports', () => node(at('scripts', 'lint-exports.mjs'))],
  ['left-overs', lintLeftOvers],
  ['words', lintWords],
  ['clang-format', clangFormat],
  ['clang-tidy', clangTidy],
];

/** What a merge or a patch leaves behind is nobody's source. */
async function lintLeftOvers() {
  const found = sources.filter(isLeftOver);
  for (const file of found) console.error(`${file}: left over from a merge or a patch, delete it`);
  return found.length === 0 ? 0 : 1;
}

async function lintWords() {
  const found = sources
    .filter((file) => !/\.(png|jpe?g|webp|glb|wasm|ico|woff2)$/.test(file))
    .flatMap((file) =>
      findMachinePaths(readFileSync(at(file), 'utf8')).map(({ line, word }) => `${file}:${line}: a path of one machine: ${word}`),
    );
  for (const line of found) console.error(line);
  return found.length === 0 ? 0 : 1;
}

async function clangFormat() {
  if (!which('clang-format')) return 'clang-format is missing';
  return cpp.length === 0 ? 0 : run('clang-format', [...(fix ? ['-i'] : ['--dry-run', '-Werror']), ...cpp]);
}

/** Every source of the solver; only what was found is shown. */
async function clangTidy() {
  if (!which('clang-tidy')) return 'clang-tidy is missing';
  const problem = await configureNative(TIDY_BUILD, ['-DHANDLEBODY_PRECOMPILE=OFF']);
  if (problem) return problem;
  const files = cpp.filter((file) => /^wasm\/(core|abi)\/.*\.cpp$/.test(file));
  return (await tidy(TIDY_BUILD, files)) === 0 ? 0 : 1;
}

await runMain(async () => {
  const names = CHECKS.map(([name]) => name);
  const unknown = named.find((name) => !names.includes(name));
  if (unknown) throw new Error(`There is no check called "${unknown}": use ${names.join(', ')}, or none for all.`);
  await ensureInstalled();
  await import('./generate.mjs');
  const failed = [];
  for (const [name, check] of CHECKS) {
    if (named.length > 0 && named.includes(name) === except) continue;
    const start = performance.now();
    const result = await check();
    const seconds = `${((performance.now() - start) / 1000).toFixed(1)} s`;
    const bad = typeof result === 'string' ? process.env.REQUIRE_NATIVE === '1' : result !== 0;
    if (bad) failed.push(name);
    console.log(
      `${name}: ${typeof result === 'string' ? `not run (${result})` : `${result === 0 ? 'clean' : 'FAILED'} (${seconds})`}`,
    );
  }
  console.log(failed.length === 0 ? 'lint: clean' : `lint: FAILED (${failed.join(', ')})`);
  return failed.length === 0 ? 0 : 1;
});
