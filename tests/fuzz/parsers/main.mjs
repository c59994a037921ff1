/**
 * `node tests/fuzz/parsers/main.mjs [target …] [--runs N | --minutes M] [--seed S]`: readers of files, fed with made files that are damaged a
 * little, after what failed once. Prints executions, how many reached a result, and the line coverage of the files behind each; what fails is made small and put
 * into tests/repro/parsers.
 */
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import { at } from '../../../scripts/lib/paths.mjs';
import { startCoverage } from './coverage.mjs';
import { Random } from './random.mjs';
import { TARGETS } from './targets.mjs';

const MOST_MILLISECONDS = 1000;
const MOST_BYTES = 1 << 30;
const FOLDER = at('tests', 'repro', 'parsers');

/** What failed once, of a target. @param {string} name */
const kept = (name) => (existsSync(FOLDER) ? readdirSync(FOLDER).filter((file) => file.startsWith(`${name}-`)) : []);

/** What is wrong with how a reader ends, if anything. @param {Pick<import('./targets.mjs').Target, 'read'>} target @param {Uint8Array} bytes @param {number} [tries] @returns {Promise<{ reached: boolean, failure: string | undefined }>} */
async function failureOf({ read }, bytes, tries = 3) {
  // Of the processor, and more than once: the machine may be busy with others.
  const start = process.cpuUsage();
  let reached = false;
  try {
    await read(bytes);
    reached = true;
  } catch (error) {
    const isTyped = error instanceof Error && error.name === 'HandlebodyError' && 'remedy' in error && error.remedy !== '';
    if (!isTyped || error.message.length > 2000) return { reached, failure: `${error}`.slice(0, 200) };
  }
  const { user, system } = process.cpuUsage(start);
  const time = (user + system) / 1000;
  if (time > MOST_MILLISECONDS && tries > 1) return failureOf({ read }, bytes, tries - 1);
  if (time > MOST_MILLISECONDS) return { reached, failure: `${Math.round(time)} ms for ${bytes.length} bytes` };
  return { reached, failure: undefined };
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
  let [executions, reached, failures] = [0, 0, 0];
  for (const file of kept(name)) {
    const { failure } = await failureOf(target, new Uint8Array(readFileSync(`${FOLDER}/${file}`)));
    if (!failure) continue;
    failures++;
    console.log(`${name}: again ${failure}: tests/repro/parsers/${file}`);
  }
  for (; executions < runs && performance.now() < end; executions++) {
    const bytes = random.below(3) === 0 ? target.make(random) : random.bytes(target.make(random));
    const ended = await failureOf(target, bytes);
    if (ended.reached) reached++;
    if (executions % 1000 === 0 && process.memoryUsage.rss() > MOST_BYTES) ended.failure ??= 'memory beyond 1 GiB';
    if (!ended.failure) continue;
    if (failures++ > 20) break;
    const small = await minimize(target, bytes);
    mkdirSync(FOLDER, { recursive: true });
    const file = `${name}-${createHash('sha256').update(small).digest('hex').slice(0, 8)}.bin`;
    writeFileSync(`${FOLDER}/${file}`, small);
    console.log(`${name}: ${ended.failure}: tests/repro/parsers/${file}`);
  }
  const lines = await coverage.stop(target.files);
  console.log(
    `${name.padEnd(8)} ${executions} executions, ${((100 * reached) / executions).toFixed(1)}% reached a result, lines ${lines.toFixed(1)}%, ${failures} failures (seed ${seed})`,
  );
  return failures + (10 * reached < executions ? 1 : 0);
}

if (import.meta.filename === process.argv[1]) {
  const { values, positionals } = parseArgs({
    allowPositionals: true,
    options: { runs: { type: 'string' }, minutes: { type: 'string' }, seed: { type: 'string' } },
  });
  const limits = {
    runs: Number(values.runs ?? (values.minutes ? Number.POSITIVE_INFINITY : 200_000)),
    minutes: Number(values.minutes ?? Number.POSITIVE_INFINITY),
    seed: Number(values.seed ?? 20261130),
  };
  let failed = 0;
  for (const name of positionals.length > 0 ? positionals : Object.keys(TARGETS)) failed += await fuzz(name, limits);
  process.exitCode = failed > 0 ? 1 : 0;
}
