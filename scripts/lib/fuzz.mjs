// Fuzzing the C interface: libFuzzer with Clang's sanitizers natively, and the same inputs through wasm under Node.
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { aptInstall } from './apt.mjs';
import { cmakeBuild } from './cmake.mjs';
import { buildForNode, configureNative } from './native.mjs';
import { at } from './paths.mjs';
import { capture, run } from './run.mjs';

const SOURCES = at('tests', 'fuzz');
const PACKAGES = ['clang-14', 'libclang-rt-14-dev', 'llvm-14'];
const CLANG = 'clang++-14';
/** Longest input; with what a target makes of it, far below the sizes that it promises. */
const LONGEST = 512;
/** With sanitizers everything takes ten to twenty times as long, on a machine that may be busy: a second or two without them. */
const TIMEOUT = 60;

/** What `require` and sanitizers say at most, and how inputs of a target are kept. */
export class FuzzTarget {
  /** @param {string} name */
  constructor(name) {
    this.name = name;
    this.program = `${name}_fuzz`;
    /** The inputs that fuzzing has found so far, on this machine. */
    this.corpus = at('.cache', 'fuzz', name);
    /** Some of them, enough to reach what all reach: one in base64 a line. */
    this.seeds = path.join(SOURCES, 'seeds', `${name}.txt`);
    /** The smallest inputs that broke something once. */
    this.repro = at('tests', 'repro', 'fuzz', name);
  }

  /** All inputs that are committed, as files. */
  unpack() {
    const folder = at('build', 'fuzz-seeds', this.name);
    rmSync(folder, { recursive: true, force: true });
    mkdirSync(folder, { recursive: true });
    const lines = existsSync(this.seeds) ? readFileSync(this.seeds, 'utf8').split('\n').filter(Boolean) : [];
    for (const [k, line] of lines.entries())
      writeFileSync(path.join(folder, String(k).padStart(4, '0')), Buffer.from(line, 'base64'));
    const repro = existsSync(this.repro) ? readdirSync(this.repro) : [];
    for (const name of repro) writeFileSync(path.join(folder, `repro-${name}`), readFileSync(path.join(this.repro, name)));
    return folder;
  }

  /** Writes the seeds from a folder of inputs, the shortest first. @param {string} folder */
  pack(folder) {
    const inputs = readdirSync(folder).map((name) => readFileSync(path.join(folder, name)));
    inputs.sort((a, b) => a.length - b.length || Buffer.compare(a, b));
    mkdirSync(path.dirname(this.seeds), { recursive: true });
    writeFileSync(this.seeds, `${inputs.map((bytes) => bytes.toString('base64')).join('\n')}\n`);
    return inputs.length;
  }
}

/** The targets, by the names of their files. @returns {FuzzTarget[]} */
export function fuzzTargets() {
  const names = readdirSync(SOURCES).flatMap((file) => /^(\w+)_fuzz\.cpp$/.exec(file)?.[1] ?? []);
  return names.sort().map((name) => new FuzzTarget(name));
}

/** Functions of the C interface that no target calls. @param {string} header @param {string[]} sources */
export function unfuzzed(header, sources) {
  const functions = [...header.matchAll(/^HB_(?:WHOLE_)?API .*?\b(hb_\w+)\(/gm)].map((found) => /** @type {string} */ (found[1]));
  return functions.filter((name) => !sources.some((source) => new RegExp(`\\b${name}\\b`).test(source)));
}

async function ensureClang() {
  const there = () => {
    const { status, stdout } = capture(CLANG, ['-print-resource-dir']);
    return status === 0 && existsSync(path.join(stdout.trim(), 'lib', 'linux', 'libclang_rt.fuzzer-x86_64.a'));
  };
  if (there() || ((await aptInstall(PACKAGES)) && there())) return;
  throw new Error(`Fuzzing needs Clang 14 with libFuzzer: on Debian, apt-get install ${PACKAGES.join(' ')}.`);
}

/**
 * Builds targets natively.
 * @param {'fuzz' | 'coverage'} kind @param {FuzzTarget[]} targets
 * @returns {Promise<string>} the folder of the programs
 */
export async function buildFuzz(kind, targets) {
  await ensureClang();
  const folder = at('build', kind);
  const problem = await configureNative(folder, [`-DHANDLEBODY_FUZZ=${kind}`, `-DCMAKE_CXX_COMPILER=${CLANG}`]);
  if (problem) throw new Error(`Fuzzing needs what the native tests need: ${problem}.`);
  if ((await cmakeBuild(folder, { targets: targets.map(({ program }) => program) })) !== 0)
    throw new Error('The targets of tests/fuzz do not compile.');
  return folder;
}

/** @typedef {{ name: string, executions: number, reached: number, failed: boolean }} FuzzResult */

/** @param {string} output @returns {{ executions: number, reached: number }} */
function readCounts(output) {
  const found = /fuzz: (\d+) executions, (\d+) of them/.exec(output);
  return { executions: Number(found?.[1] ?? 0), reached: Number(found?.[2] ?? 0) };
}

/** What sanitizers look for, and that memory which is not there is NULL and no end. */
const ENVIRONMENT = {
  ...process.env,
  ASAN_OPTIONS: 'allocator_may_return_null=1:detect_stack_use_after_return=0',
  UBSAN_OPTIONS: 'print_stacktrace=1',
};

/** @param {string} program @param {string[]} args @param {boolean} [quiet] */
async function runFuzzer(program, args, quiet = false) {
  let output = '';
  const status = await run(program, args, {
    env: ENVIRONMENT,
    stdio: ['ignore', 'ignore', 'pipe'],
    onError: (text) => {
      output += text;
      if (!quiet) process.stderr.write(text.replace(/^.*\b(NEW|REDUCE|RELOAD)\b.*\n/gm, ''));
    },
  });
  return { status, output };
}

/**
 * Fuzzes a target for so many seconds or executions; a crash is minimized into tests/repro/fuzz. With a seed it is from the committed inputs
 * alone, by the same changes every time.
 * @param {string} folder @param {FuzzTarget} target @param {{ seconds?: number | undefined, runs?: number | undefined, seed?: number | undefined }} limits
 * @returns {Promise<FuzzResult>}
 */
export async function fuzz(folder, target, { seconds, runs, seed }) {
  mkdirSync(target.corpus, { recursive: true });
  const corpus = seed === undefined ? target.corpus : mkdtempSync(at('build', 'fuzz-corpus-'));
  const seeds = target.unpack();
  const found = mkdtempSync(at('build', 'fuzz-found-'));
  const program = path.join(folder, target.program);
  const limits = [
    ...(seconds === undefined ? [] : [`-max_total_time=${seconds}`]),
    ...(runs === undefined ? [] : [`-runs=${runs}`]),
    ...(seed === undefined ? [] : [`-seed=${seed}`]),
  ];
  const common = [
    `-timeout=${TIMEOUT}`,
    `-report_slow_units=${TIMEOUT}`,
    '-rss_limit_mb=3000',
    `-max_len=${LONGEST}`,
    '-len_control=0',
    '-entropic=0',
    '-print_funcs=0',
  ];
  const { status, output } = await runFuzzer(
    program,
    [...common, ...limits, '-print_final_stats=0', `-artifact_prefix=${found}/`, corpus, seeds],
    true,
  );
  const counts = readCounts(output);
  const [crash] = readdirSync(found);
  if (crash !== undefined) await minimize(program, target, path.join(found, crash), common);
  if (status !== 0)
    process.stderr.write(
      output
        .split('\n')
        .filter((line) => !/\b(NEW|REDUCE|pulse|RELOAD)\b/.test(line))
        .slice(-80)
        .join('\n'),
    );
  rmSync(found, { recursive: true, force: true });
  if (corpus !== target.corpus) rmSync(corpus, { recursive: true, force: true });
  return { name: target.name, ...counts, failed: status !== 0 };
}

/** @param {string} program @param {FuzzTarget} target @param {string} crash @param {string[]} common */
async function minimize(program, target, crash, common) {
  const smaller = `${crash}.smaller`;
  await runFuzzer(program, [...common, '-minimize_crash=1', '-max_total_time=60', `-exact_artifact_path=${smaller}`, crash], true);
  const bytes = readFileSync(existsSync(smaller) ? smaller : crash);
  mkdirSync(target.repro, { recursive: true });
  const name = createHash('sha256').update(bytes).digest('hex').slice(0, 12);
  writeFileSync(path.join(target.repro, name), bytes);
  console.error(
    `${target.name}: a crash, ${bytes.length} bytes: tests/repro/fuzz/${target.name}/${name}. Mend it, and commit it with the mend.`,
  );
}

/** Keeps of the corpus what reaches all that it reaches, and writes it down as seeds. @param {string} folder @param {FuzzTarget} target */
export async function packSeeds(folder, target) {
  const merged = `${target.corpus}.merged`;
  rmSync(merged, { recursive: true, force: true });
  mkdirSync(merged, { recursive: true });
  mkdirSync(target.corpus, { recursive: true });
  const { status, output } = await runFuzzer(
    path.join(folder, target.program),
    ['-merge=1', `-timeout=${TIMEOUT}`, '-rss_limit_mb=3000', merged, target.unpack(), target.corpus],
    true,
  );
  if (status !== 0) throw new Error(`${target.name}: the corpus could not be merged.\n${output.slice(-2000)}`);
  const count = target.pack(merged);
  rmSync(target.corpus, { recursive: true, force: true });
  renameSync(merged, target.corpus);
  return count;
}

/**
 * Runs files once, each in its turn.
 * @param {FuzzTarget} target @param {string} inputs a folder of them
 * @param {(list: string) => [string, string[]]} command what runs the files of a list
 * @returns {Promise<FuzzResult & { files: number, slowest: number }>}
 */
export async function replay(target, inputs, command) {
  const files = readdirSync(inputs).map((name) => path.join(inputs, name));
  const list = at('build', `fuzz-${target.name}.list`);
  writeFileSync(list, files.map((file) => `${file}\n`).join(''));
  if (files.length === 0) return { name: target.name, executions: 0, reached: 0, failed: true, files: 0, slowest: 0 };
  const [program, args] = command(list);
  let last = '';
  let output = '';
  const status = await run(program, args, {
    env: ENVIRONMENT,
    stdio: ['ignore', 'pipe', 'pipe'],
    onOutput: (text) => {
      last = text.trimEnd().split('\n').at(-1) ?? last;
    },
    onError: (text) => {
      output += text;
    },
  });
  if (status !== 0) console.error(`${target.name}: ended with status ${status} at ${last}\n${output.slice(-6000)}`);
  const slowest = Number(/took ([\d.]+) s/.exec(output)?.[1] ?? 0);
  return { name: target.name, ...readCounts(output), failed: status !== 0, files: files.length, slowest };
}

/** Builds the targets for Node. @param {FuzzTarget[]} targets */
export async function buildReplays(targets) {
  const built = await buildForNode(targets.map(({ program }) => program));
  if ('problem' in built) throw new Error(`Running the inputs in wasm needs Emscripten: ${built.problem}.`);
  if ('failed' in built) throw new Error('The targets of tests/fuzz do not compile to wasm.');
  return (/** @type {FuzzTarget} */ target) => built.program(target.program);
}
