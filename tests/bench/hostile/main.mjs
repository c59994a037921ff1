/**
 * `npm run bench -- hostile`: how time and memory of reading the worst inputs that are known grow with their bytes. Ten times the bytes should
 * take at most 13 times the time; what is refused should be so early.
 */
import { writeFileSync } from 'node:fs';
import { cpus } from 'node:os';
import { at } from '../../../scripts/lib/paths.mjs';
import { mustRun } from '../../../scripts/lib/run.mjs';
import { measure } from '../support.mjs';
import { KINDS } from './kinds.mjs';

const SIZES = [60_000, 600_000];
const MOST = 13;

const rounded = (/** @type {number} */ value) => Number(value.toPrecision(3));

export async function benchHostile() {
  await mustRun(process.execPath, [at('scripts', 'build.mjs'), 'library']);
  /** @type {Record<string, object>} */
  const results = {};
  const slow = [];
  for (const name of Object.keys(KINDS)) {
    const [small, large] = SIZES.map((size) =>
      measure(process.execPath, ['--expose-gc', at('tests', 'bench', 'hostile', 'side.mjs'), name, String(size)]),
    );
    if (!small || !large) continue;
    const of = (/** @type {Record<string, unknown>} */ found, /** @type {string} */ what) => Number(found[what]);
    const growth = (of(large, 'milliseconds') / of(small, 'milliseconds')) * ((10 * of(small, 'bytes')) / of(large, 'bytes'));
    if (growth > MOST) slow.push(name);
    results[name] = {
      milliseconds: [small, large].map((found) => rounded(of(found, 'milliseconds'))),
      tenTimesTheBytes: rounded(growth),
      peakBytesPerByte: rounded(of(large, 'peak') / of(large, 'bytes')),
      ends: [small, large].map(({ end }) => end),
    };
    console.log(`${name.padEnd(48)} ${JSON.stringify(results[name])}`);
  }
  const record = {
    what: `reading hostile files of ${SIZES.map((size) => size / 1e6).join(' and ')} MB; medians of five rounds`,
    processor: cpus()[0]?.model,
    node: process.version,
    slowerThanTheirBytes: slow,
    results,
  };
  writeFileSync(at('tests', 'bench', 'hostile', 'results.json'), `${JSON.stringify(record, null, 2)}\n`);
}
