/** The side of npm's `rbf`, which has no batches: prints milliseconds as the others do. Its folder is the first argument. */
import { createRequire } from 'node:module';
import path from 'node:path';
import { COUNTS, DATA } from './setup.mjs';

const RBF = createRequire(path.join(process.argv[2] ?? '', 'package.json'))('rbf');
const rows = (/** @type {Float64Array} */ all) => Array.from({ length: all.length / 2 }, (_, i) => [all[2 * i], all[2 * i + 1]]);
const points = rows(DATA.points);
const queries = rows(DATA.queries);
/** @type {Record<string, number>} */
const times = {};
for (const kernel of ['thin-plate', 'gaussian', 'multiquadric']) {
  const start = performance.now();
  const rbf = RBF(points, [...DATA.values], kernel, 0.05);
  const made = performance.now();
  let sum = 0;
  for (const query of queries) sum += Number(rbf(query));
  const end = performance.now();
  if (!Number.isFinite(sum) || queries.length !== COUNTS.queries) throw new Error(`rbf gave no number for ${kernel}`);
  times[`${kernel} fit`] = made - start;
  times[`${kernel} evaluate`] = end - made;
}
console.log(JSON.stringify(times));
