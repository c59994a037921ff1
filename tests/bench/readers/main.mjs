/**
 * `npm run bench -- readers`: how the time of reading a model grows with its bytes, and beside three.js's loaders. Ten times the bytes should
 * take at most 13 times the time. three.js gives triangles of an STL that do not hang together, joins nothing and checks nothing.
 */
import { writeFileSync } from 'node:fs';
import { cpus } from 'node:os';
import { REVISION } from 'three';
import { at } from '../../../scripts/lib/paths.mjs';
import { mustRun } from '../../../scripts/lib/run.mjs';
import { measure } from '../support.mjs';
import { KINDS } from './files.mjs';
import { ROUNDS, SIZES } from './sizes.mjs';

const rounded = (/** @type {number} */ value) => Number(value.toPrecision(3));

export async function benchReaders() {
  await mustRun(process.execPath, [at('scripts', 'build.mjs'), 'library']);
  /** @type {Record<string, object>} */
  const results = {};
  for (const kind of KINDS) {
    const found = measure(process.execPath, [at('tests', 'bench', 'readers', 'side.mjs'), kind]);
    const of = (/** @type {string} */ what, /** @type {number} */ i) => found[`${what} ${SIZES[i]}`] ?? Number.NaN;
    /** Time over time, for ten times the bytes: files are a few hundredths smaller or larger than wanted. */
    const growth = (/** @type {number} */ i) => (of('ours', i) / of('ours', i - 1)) * ((10 * of('bytes', i - 1)) / of('bytes', i));
    const overThree = SIZES.map((_, i) => rounded(of('ours', i) / of('theirs', i)));
    results[kind] = {
      milliseconds: SIZES.map((_, i) => rounded(of('ours', i))),
      tenTimesTheBytes: [1, 2].map((i) => rounded(growth(i))),
      ...(overThree.every(Number.isFinite) && { overThree }),
    };
    console.log(`${kind.padEnd(20)} ${JSON.stringify(results[kind])}`);
  }
  const record = {
    what: `reading files of ${SIZES.map((size) => size / 1e6).join(', ')} MB; medians of ${ROUNDS} rounds`,
    processor: cpus()[0]?.model,
    node: process.version,
    peers: `three r${REVISION}`,
    results,
  };
  writeFileSync(at('tests', 'bench', 'readers', 'results.json'), `${JSON.stringify(record, null, 2)}\n`);
}
