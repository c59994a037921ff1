/**
 * `npm run test:consumers`: the packed library, installed and used by tools that know nothing of it, without configuration, and run in
 * Chromium; and the recipes of docs/recipes. Each page has to bake in a worker: a silent fallback to its own thread fails. What is found
 * is written to results.json beside this file.
 *
 *     npm run test:consumers -- [webpack] ["import map"] [recipes] … [--screenshots FOLDER]
 */
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { parseArgs } from 'node:util';
import { ensureInstalled } from '../../scripts/lib/install.mjs';
import { at } from '../../scripts/lib/paths.mjs';
import { runMain } from '../../scripts/lib/run.mjs';

const LOG = at('tests', 'consumers', 'results.json');

await runMain(async () => {
  await ensureInstalled();
  const { CONSUMERS } = await import('./consumers.mjs');
  const { RECIPES } = await import('./recipes.mjs');
  const { countResults, tryConsumers } = await import('./run.mjs');
  const all = { ...CONSUMERS, ...RECIPES };
  const { values, positionals } = parseArgs({ allowPositionals: true, options: { screenshots: { type: 'string' } } });
  const named = positionals.flatMap((name) => (name === 'recipes' ? Object.keys(RECIPES) : [name]));
  const unknown = named.find((name) => !(name in all));
  if (unknown) throw new Error(`There is no consumer "${unknown}": choose from recipes, ${Object.keys(all).join(', ')}.`);
  const chosen = Object.fromEntries(Object.entries(all).filter(([name]) => named.length === 0 || named.includes(name)));
  const results = await tryConsumers(chosen, { screenshots: values.screenshots && path.resolve(values.screenshots) });
  const found = Object.entries(results).filter(([, { notRun }]) => notRun === undefined);
  const known = { ...JSON.parse(readFileSync(LOG, 'utf8')), ...Object.fromEntries(found) };
  const log = Object.fromEntries(Object.keys(all).flatMap((name) => (known[name] ? [[name, known[name]]] : [])));
  // Rows of numbers on one line, as the formatter has them.
  const text = JSON.stringify(log, null, 2).replace(/\[[\d.,\s]+\]/g, (row) =>
    row.replace(/\s+/g, ' ').replace(/\[ | \]/g, (end) => end.trim()),
  );
  writeFileSync(LOG, `${text}\n`);
  const { passed, failed, notRun } = countResults(results);
  console.log(`${passed} passed, ${failed} failed${notRun > 0 ? `, ${notRun} not run` : ''}`);
  return failed === 0 ? 0 : 1;
});
