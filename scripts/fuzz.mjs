// `npm run fuzz`: looks for inputs of the C interface that crash, hang, or break what its header promises, by Clang's libFuzzer and
// sanitizers. tests/fuzz holds the targets, one for each group of functions; a crash is minimized into tests/repro/fuzz. What is written in
// TypeScript, readers of files and of options, is fuzzed by tests/fuzz/parsers, into tests/repro/parsers.
//
//   npm run fuzz                              all targets, a minute each
//   npm run fuzz -- irbf glb --seconds 600    these two, ten minutes each; or --runs 200000
//   npm run fuzz -- readers                   those in TypeScript; `interface` is those of the C interface
//   npm run fuzz -- --check                   what CI does: all that is committed once, natively and in wasm, then the same seconds of fuzzing
//   npm run fuzz -- --coverage                lines of the files behind each target that its inputs reach
//   npm run fuzz -- … --record                with --runs, --seconds or --coverage: puts the figures into tests/fuzz/results.json
//   npm run fuzz -- --seeds                   writes the seeds that are committed, from what fuzzing has found so far
import { readdirSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { sideBySide } from './lib/cmake.mjs';
import { buildFuzz, buildReplays, fuzz, fuzzTargets, packSeeds, replay, unfuzzed } from './lib/fuzz.mjs';
import { coverTarget } from './lib/fuzz-coverage.mjs';
import { recordFuzz, rounded } from './lib/fuzz-results.mjs';
import { FOR_EMSCRIPTEN } from './lib/native.mjs';
import { at } from './lib/paths.mjs';
import { run, runMain } from './lib/run.mjs';

const CHECK_SECONDS = 4;
const CHECK_RUNS = 3000;
/** A check that finds something another time only would blame whoever comes along: new inputs are for `npm run fuzz`. */
const CHECK_SEED = 20261130;
const MODES = ['--check', '--coverage', '--seeds', '--record'];
const GROUPS = ['interface', 'readers'];
const READERS = ['obj', 'ply', 'stl', 'off', 'glb', 'gltf', 'body', 'handles', 'options'];

/** @param {string[]} args */
function readArguments(args) {
  /** @type {{ named: string[], seconds?: number, runs?: number, modes: Set<string> }} */
  const options = { named: [], modes: new Set() };
  for (let k = 0; k < args.length; ++k) {
    const arg = /** @type {string} */ (args[k]);
    if (arg === '--seconds' || arg === '--runs') {
      const value = Number(args[++k]);
      if (!Number.isInteger(value) || value < 1) throw new Error(`${arg} wants a whole number from 1 on.`);
      options[arg === '--runs' ? 'runs' : 'seconds'] = value;
    } else if (MODES.includes(arg)) options.modes.add(arg);
    else if (arg.startsWith('--')) throw new Error(`There is no ${arg}: use --seconds, --runs, ${MODES.join(', ')}.`);
    else options.named.push(arg);
  }
  return options;
}

/** @param {import('./lib/fuzz.mjs').FuzzResult} result */
function say({ name, executions, reached, failed }) {
  const part = executions > 0 ? ((100 * reached) / executions).toFixed(0) : '0';
  console.log(`${name}: ${executions} executions, ${reached} (${part} %) reached the algorithm${failed ? ': FAILED' : ''}`);
}

/** Each function of the header is in a target; otherwise the check says which is not. */
function checkCalls() {
  const folder = at('tests', 'fuzz');
  const sources = readdirSync(folder).filter((file) => /\.(cpp|hpp)$/.test(file));
  const missing = unfuzzed(
    readFileSync(at('wasm', 'abi', 'handlebody.h'), 'utf8'),
    sources.map((file) => readFileSync(path.join(folder, file), 'utf8')),
  );
  for (const name of missing) console.error(`${name} is in no target of tests/fuzz.`);
  return missing.length === 0;
}

/**
 * Fuzzes readers, each for so long; whether nothing failed.
 * @param {string[]} readers @param {{ seconds?: number | undefined, runs?: number | undefined }} limits
 */
async function fuzzReaders(readers, { seconds, runs }) {
  if (readers.length === 0) return true;
  const program = at('tests', 'fuzz', 'parsers', 'main.mjs');
  const limit = runs ? ['--runs', `${runs}`] : ['--minutes', `${(seconds ?? 60) / 60}`];
  if ((await run(process.execPath, [at('scripts', 'build.mjs'), 'library'])) !== 0) return false;
  return (await run(process.execPath, [program, ...readers, ...limit])) === 0;
}

await runMain(async () => {
  const { named, seconds, runs, modes } = readArguments(process.argv.slice(2));
  const all = fuzzTargets();
  const names = [...all.map(({ name }) => name), ...READERS, ...GROUPS];
  const unknown = named.find((name) => !names.includes(name));
  if (unknown) throw new Error(`There is no target called "${unknown}": use ${names.join(', ')}.`);
  const isWanted = (/** @type {string} */ name, /** @type {string} */ group) =>
    named.length === 0 || named.includes(name) || named.includes(group);
  const targets = all.filter(({ name }) => isWanted(name, 'interface'));
  const readers = modes.has('--seeds') ? [] : READERS.filter((name) => isWanted(name, 'readers'));
  const isBrief = modes.has('--check') || modes.has('--coverage');
  let sound = await fuzzReaders(readers, isBrief ? { runs: CHECK_RUNS } : { seconds, runs });
  if (targets.length === 0) return sound ? 0 : 1;
  sound = checkCalls() && sound;

  if (modes.has('--coverage')) {
    const folder = await buildFuzz('coverage', targets);
    for (const target of targets) {
      const { enough, figures } = await coverTarget(folder, target);
      if (figures && modes.has('--record')) recordFuzz(target.name, figures);
      sound &&= enough;
    }
    return sound ? 0 : 1;
  }
  const folder = await buildFuzz('fuzz', targets);
  if (modes.has('--seeds')) {
    for (const target of targets) console.log(`${target.name}: ${await packSeeds(folder, target)} seeds`);
    return sound ? 0 : 1;
  }
  if (modes.has('--check')) {
    const program = await buildReplays(targets);
    await sideBySide(targets, async (target) => {
      const result = await replay(target, target.unpack(), (list) => [
        process.execPath,
        [...FOR_EMSCRIPTEN, program(target), list],
      ]);
      console.log(
        `${target.name}, in wasm: ${result.files} inputs, the slowest in ${result.slowest} s${result.failed ? ': FAILED' : ''}`,
      );
      sound &&= !result.failed;
    });
  }
  const limits = modes.has('--check')
    ? { seconds: seconds ?? CHECK_SECONDS, seed: CHECK_SEED }
    : { ...(runs ? { runs } : { seconds: seconds ?? 60 }) };
  await sideBySide(targets, async (target) => {
    const result = await fuzz(folder, target, limits);
    say(result);
    const { executions, reached } = result;
    if (modes.has('--record') && !result.failed)
      recordFuzz(target.name, { executions, reachedPercent: rounded((100 * reached) / executions) });
    sound &&= !result.failed;
  });
  return sound ? 0 : 1;
});
