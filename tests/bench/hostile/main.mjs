/**
 * `npm run bench -- hostile`: how time and memory of reading the worst inputs that are known grow with their bytes. Ten times the bytes should
 * take at most 13 times the time; what is refused should be so early. What is over in less than a millisecond is too short to be compared, and
 * is measured at ten times the size.
 */
import { writeFileSync } from 'node:fs';
import { cpus } from 'node:os';
import { at } from '../../../scripts/lib/paths.mjs';
import { mustRun } from '../../../scripts/lib/run.mjs';
import { measure } from '../support.mjs';
import { KINDS } from './kinds.mjs';

const SIZES = [60_000, 600_000, 6_000_000];
const MOST = 13;
/** Milliseconds. */
const LEAST = 1;
const FLAGS = ['--expose-gc', '--single-threaded'];

const rounded = (/** @type {number} */ value) => Number(value.toPrecision(3));

export async function benchHostile() {
  await mustRun(process.execPath, [at('scripts', 'build.mjs'), 'library']);
  /** @type {Record<string, object>} */
  const results = {};
  const slow = [];
  for (const name of Object.keys(KINDS)) {
    /** @type {Record<string, unknown>[]} */
    const found = [];
    for (const size of SIZES) {
      found.push(measure(process.execPath, [...FLAGS, at('tests', 'bench', 'hostile', 'side.mjs'), name, String(size)]));
      if (found.length > 1 && Number(found.at(-2)?.milliseconds) >= LEAST) break;
    }
    const [small, large] = found.slice(-2);
    if (!small || !large) continue;
    const of = (/** @type {Record<string, unknown>} */ side, /** @type {string} */ what) => Number(side[what]);
    const growth = (of(large, 'milliseconds') / of(small, 'milliseconds')) * ((10 * of(small, 'bytes')) / of(large, 'bytes'));
    if (growth > MOST && of(large, 'milliseconds') >= LEAST) slow.push(name);
    results[name] = {
      megabytes: [small, large].map((side) => rounded(of(side, 'bytes') / 1e6)),
      milliseconds: [small, large].map((side) => rounded(of(side, 'milliseconds'))),
      tenTimesTheBytes: rounded(growth),
      peakBytesPerByte: rounded(of(large, 'peak') / of(large, 'bytes')),
      ends: [small, large].map(({ end }) => end),
    };
    console.log(`${name.padEnd(48)} ${JSON.stringify(results[name])}`);
  }
  const record = {
    what: 'reading hostile files and ten times as large ones; medians of five rounds, of the time of the processor',
    processor: cpus()[0]?.model,
    node: process.version,
    slowerThanTheirBytes: slow,
    results,
  };
  writeFileSync(at('tests', 'bench', 'hostile', 'results.json'), `${JSON.stringify(record, null, 2)}\n`);
}
