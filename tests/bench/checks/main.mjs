/**
 * `npm run bench -- checks`: the part of a call's time that meeting its arguments takes. Results go to results.json beside this file.
 */
import { writeFileSync } from 'node:fs';
import { cpus } from 'node:os';
import { at } from '../../../scripts/lib/paths.mjs';
import { mustRun } from '../../../scripts/lib/run.mjs';
import { measure, median } from '../support.mjs';

const ROUNDS = 5;
/** What is wanted at most, in percent. */
const MOST = {
  'a dragged frame of the dog': 2,
  'evaluating 1,000 queries of 100 points, typed': 2,
  'evaluating 1,000 queries of 100 points, plain': 2,
  'fitting 30 points': 5,
};

export async function benchChecks() {
  await mustRun(process.execPath, [at('scripts', 'build.mjs'), 'library']);
  const rounds = Array.from({ length: ROUNDS }, () => measure(process.execPath, [at('tests', 'bench', 'checks', 'side.mjs')]));
  const results = Object.fromEntries(
    Object.entries(MOST).map(([name, most]) => {
      const percent = Number((100 * median(rounds.map((round) => round[name] ?? Number.NaN))).toPrecision(2));
      console.log(`${name.padEnd(48)} ${percent} % (at most ${most} %)`);
      return [name, { percent, most }];
    }),
  );
  const record = {
    what: `the part of a call that meeting its arguments takes, by samples of V8's profiler; medians of ${ROUNDS} processes`,
    processor: cpus()[0]?.model,
    node: process.version,
    results,
  };
  writeFileSync(at('tests', 'bench', 'checks', 'results.json'), `${JSON.stringify(record, null, 2)}\n`);
}
