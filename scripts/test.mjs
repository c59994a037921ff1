// `npm test`: installs what it needs, then runs every suite: native C++, the same in wasm, whose sizes have 32 bits, TypeScript on the real
// wasm, a real browser on the built site, and two consumers of the packed library. The last line is always "N passed, N failed".
// REQUIRE_NATIVE=1 and REQUIRE_CONSUMERS=1 make a suite that cannot run a failure. `npm test -- ts` (native, wasm32, ts, web, consumers) runs
// only the suites that are named.
import { existsSync, readdirSync } from 'node:fs';
import { ensureInstalled } from './lib/install.mjs';
import { prepareNativeSuite, prepareWasm32Suite } from './lib/native.mjs';
import { at } from './lib/paths.mjs';
import { runMain } from './lib/run.mjs';
import { buildSite, hasPages } from './lib/site.mjs';
import { runVitest } from './lib/vitest.mjs';

const SUITES = ['native', 'wasm32', 'ts', 'web', 'consumers'];
/** One that makes a single script of everything, and one that bundles nothing: all others are `npm run test:consumers`. */
const CONSUMERS = ['esbuild', 'import map'];
const named = process.argv.slice(2);
const wanted = (/** @type {string} */ suite) => named.length === 0 || named.includes(suite);

await runMain(async () => {
  const unknown = named.find((name) => !SUITES.includes(name));
  if (unknown) throw new Error(`There is no suite called "${unknown}": use ${SUITES.join(', ')}, or none for all.`);
  await ensureInstalled();
  await import('./generate.mjs');

  /** @type {string[]} */
  const lines = [];
  const total = { passed: 0, failed: 0 };
  const add = (/** @type {string} */ suite, /** @type {import('./lib/native.mjs').Counts} */ { passed, failed }) => {
    total.passed += passed;
    total.failed += failed;
    lines.push(`${suite} suite: ${passed} passed, ${failed} failed`);
  };

  const native = wanted('native') ? await prepareNativeSuite() : undefined;
  const wasm32 = wanted('wasm32') ? await prepareWasm32Suite() : undefined;
  for (const [suite, prepared] of Object.entries({ native, wasm32 })) {
    if (!prepared || !('notRun' in prepared)) continue;
    lines.push(`${suite} suite: NOT RUN (${prepared.notRun})`);
    if (process.env.REQUIRE_NATIVE === '1') total.failed += 1;
  }
  // Each side keeps about one core busy.
  const compiled = async () => {
    if (native && 'run' in native) add('native', await native.run());
    if (wasm32 && 'run' in wasm32) add('wasm32', await wasm32.run());
  };
  const [, ts] = await Promise.all([compiled(), wanted('ts') && runVitest('ts')]);
  if (ts) add('ts', ts);
  if (wanted('web') && hasWebTests()) add('web', await runWebSuite());
  const consumers = wanted('consumers') ? await runConsumers() : undefined;
  if (consumers && 'notRun' in consumers) {
    lines.push(`consumers suite: NOT RUN (${consumers.notRun})`);
    if (process.env.REQUIRE_CONSUMERS === '1') total.failed += 1;
  } else if (consumers) add('consumers', consumers);

  console.log(`\n${lines.join('\n')}\n${total.passed} passed, ${total.failed} failed`);
  return total.failed === 0 ? 0 : 1;
});

function hasWebTests() {
  return (
    existsSync(at('tests', 'web')) &&
    readdirSync(at('tests', 'web'), { recursive: true, encoding: 'utf8' }).some((f) => f.endsWith('.test.ts'))
  );
}

/** A site that does not build, or a browser that is not there, is a failed suite and not the end of the run. */
async function runWebSuite() {
  try {
    if (hasPages()) await buildSite();
    const { findChromium } = await import('./chromium.mjs');
    process.env.CHROMIUM = await findChromium();
    return await runVitest('web');
  } catch (error) {
    console.error(error instanceof Error ? error.message : error);
    return { passed: 0, failed: 1 };
  }
}

/**
 * What has to be installed comes from npm's registry; without it nothing is said of the library.
 * @returns {Promise<import('./lib/native.mjs').Counts | { notRun: string }>}
 */
async function runConsumers() {
  try {
    const [all, { countResults, tryConsumers }] = await Promise.all([
      import('../tests/consumers/consumers.mjs'),
      import('../tests/consumers/run.mjs'),
    ]);
    const chosen = Object.fromEntries(Object.entries(all.CONSUMERS).filter(([name]) => CONSUMERS.includes(name)));
    const results = await tryConsumers(chosen);
    const { passed, failed } = countResults(results);
    const { notRun } = Object.values(results).find((one) => one.notRun !== undefined) ?? {};
    return notRun === undefined || failed > 0 ? { passed, failed } : { notRun };
  } catch (error) {
    console.error(error instanceof Error ? error.message : error);
    return { passed: 0, failed: 1 };
  }
}
