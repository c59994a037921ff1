/**
 * `node tests/fuzz/parsers/main.mjs [target …] [--runs N | --minutes M] [--seed S] [--record]`: readers of files and of options, fed with made
 * ones that are damaged a little, after what failed once. Prints executions, how many reached a result, the line coverage of the files behind
 * each, and the slowest; what fails is made small and put into tests/repro/parsers, which a test replays. With `--record` the figures go into
 * results.json beside this file.
 */
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { cpus } from 'node:os';
import { parseArgs } from 'node:util';
import { load } from '../../../dist/wasm/ts/index.js';
import * as assets from '../../../dist/web/assets/index.js';
import { parseHandles } from '../../../dist/web/cli/handles.js';
import { rounded } from '../../../scripts/lib/fuzz-results.mjs';
import { at } from '../../../scripts/lib/paths.mjs';
import { startCoverage } from './coverage.mjs';
import { faultOf } from './fault.mjs';
import { Random } from './random.mjs';
import { targetsOf } from './targets.mjs';

const MOST_MILLISECONDS = 1000;
const MOST_BYTES = 1 << 30;
/** In percent. */
const [LEAST_REACHED, LEAST_LINES] = [10, 80];
const RESULTS = at('tests', 'fuzz', 'parsers', 'results.json');
/** Built from the sources, whose types it has by name. */
const library = /** @type {any} */ ({ assets, parseHandles, load });
const TARGETS = await targetsOf(library);
const FOLDER = at('tests', 'repro', 'parsers');

/** What failed once, of a target. @param {string} name */
const kept = (name) => (existsSync(FOLDER) ? readdirSync(FOLDER).filter((file) => file.startsWith(`${name}-`)) : []);

/** How a reader ends, and what is wrong with that, if anything. @param {Pick<import('./targets.mjs').Target, 'read'>} target @param {Uint8Array} bytes @param {number} [tries] @returns {Promise<{ reached: boolean, time: number, failure: string | undefined }>} */
async function failureOf({ read }, bytes, tries = 3) {
  // Of the processor, and more than once: the machine may be busy with others.
  const start = process.cpuUsage();
  let reached = false;
  let failure;
  try {
    reached = (await read(bytes)) !== false;
  } catch (error) {
    failure = faultOf(error);
  }
  const { user, system } = process.cpuUsage(start);
  const time = (user + system) / 1000;
  if (failure) return { reached, time, failure };
  if (time > MOST_MILLISECONDS / 4 && tries > 1) {
    const again = await failureOf({ read }, bytes, tries - 1);
    return again.time < time ? again : { reached, time, failure: again.failure };
  }
  if (time > MOST_MILLISECONDS) failure = `${Math.round(time)} ms for ${bytes.length} bytes`;
  return { reached, time, failure };
}

/** Leaves out parts as long as it fails. @param {import('./targets.mjs').Target} target @param {Uint8Array} bytes */
async function minimize(target, bytes) {
  let small = bytes;
  for (let part = small.length >> 1; part > 0; part >>= 1)
    for (let from = 0; from < small.length; ) {
      const without = Buffer.concat([small.subarray(0, from), small.subarray(from + part)]);
      if ((await failureOf(target, without)).failure) small = new Uint8Array(without);
      else from += part;
    }
  return small;
}

/** @param {string} name @param {{ runs: number, minutes: number, seed: number }} limits */
async function fuzz(name, { runs, minutes, seed }) {
  const target = TARGETS[name];
  if (!target) throw new Error(`There is no target "${name}": use ${Object.keys(TARGETS).join(', ')}.`);
  const coverage = await startCoverage();
  const random = new Random(seed);
  const end = performance.now() + 60_000 * minutes;
  let [executions, reached, failures, slowest] = [0, 0, 0, 0];
  for (const file of kept(name)) {
    const { failure } = await failureOf(target, new Uint8Array(readFileSync(`${FOLDER}/${file}`)));
    if (!failure) continue;
    failures++;
    console.log(`${name}: again ${failure}: tests/repro/parsers/${file}`);
  }
  for (; executions < runs && performance.now() < end; executions++) {
    const made = target.make(random);
    const bytes = target.whole || random.below(3) === 0 ? made : random.bytes(made);
    const ended = await failureOf(target, bytes);
    if (ended.reached) reached++;
    slowest = Math.max(slowest, ended.time);
    if (executions % 1000 === 0 && process.memoryUsage.rss() > MOST_BYTES) ended.failure ??= 'memory beyond 1 GiB';
    if (!ended.failure) continue;
    if (failures++ > 20) break;
    const small = await minimize(target, bytes);
    mkdirSync(FOLDER, { recursive: true });
    const file = `${name}-${createHash('sha256').update(small).digest('hex').slice(0, 8)}.bin`;
    writeFileSync(`${FOLDER}/${file}`, small);
    console.log(`${name}: ${ended.failure}: tests/repro/parsers/${file}`);
  }
  const figures = {
    executions,
    reachedPercent: rounded((100 * reached) / executions),
    linesPercent: rounded(await coverage.stop(target.files)),
    slowestMilliseconds: rounded(slowest),
    failures,
  };
  console.log(`${name.padEnd(8)} ${JSON.stringify(figures)} (seed ${seed})`);
  return figures;
}

/** Beside the figures of other targets. @param {string} name @param {object} figures @param {number} seed */
function record(name, figures, seed) {
  const before = existsSync(RESULTS) ? JSON.parse(readFileSync(RESULTS, 'utf8')).results : {};
  const results = { ...before, [name]: { ...figures, seed } };
  const written = {
    what: 'readers of files and of options, fed with made ones that are damaged a little; processor time of the slowest',
    command: 'node tests/fuzz/parsers/main.mjs --record',
    processor: cpus()[0]?.model,
    node: process.version,
    results: Object.fromEntries(Object.keys(TARGETS).flatMap((key) => (results[key] ? [[key, results[key]]] : []))),
  };
  writeFileSync(RESULTS, `${JSON.stringify(written, null, 2)}\n`);
}

// Options that are damaged may have lost the listener that hears their warnings.
console.warn = () => {};
const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: { runs: { type: 'string' }, minutes: { type: 'string' }, seed: { type: 'string' }, record: { type: 'boolean' } },
});
const limits = {
  runs: Number(values.runs ?? (values.minutes ? Number.POSITIVE_INFINITY : 200_000)),
  minutes: Number(values.minutes ?? Number.POSITIVE_INFINITY),
  seed: Number(values.seed ?? 20261130),
};
for (const name of positionals.length > 0 ? positionals : Object.keys(TARGETS)) {
  const figures = await fuzz(name, limits);
  if (values.record) record(name, figures, limits.seed);
  const { failures, reachedPercent, linesPercent } = figures;
  if (failures > 0 || reachedPercent < LEAST_REACHED || linesPercent < LEAST_LINES) process.exitCode = 1;
}
