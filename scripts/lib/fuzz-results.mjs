// The figures of fuzzing the C interface, which tests/fuzz/results.json keeps: one entry for each target.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { cpus } from 'node:os';
import { at } from './paths.mjs';

const RESULTS = at('tests', 'fuzz', 'results.json');

/** Puts figures beside those that the target has. @param {string} name @param {Record<string, number>} figures */
export function recordFuzz(name, figures) {
  const before = existsSync(RESULTS) ? JSON.parse(readFileSync(RESULTS, 'utf8')).results : {};
  const results = { ...before, [name]: { ...before[name], ...figures } };
  const written = {
    what: 'functions of the C interface under Clang’s sanitizers; the slowest input of those kept, without sanitizers',
    command: 'npm run fuzz -- NAME --runs 300000 --record; npm run fuzz -- NAME --coverage --record',
    processor: cpus()[0]?.model,
    results: Object.fromEntries(Object.entries(results).sort(([a], [b]) => (a < b ? -1 : 1))),
  };
  writeFileSync(RESULTS, `${JSON.stringify(written, null, 2)}\n`);
}

/** To three digits. @param {number} value */
export const rounded = (value) => Number(value.toPrecision(3));
