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

  /** @type {Map<string, import('./lib/native.mjs').Counts | { notRun: string }>} */
  const results = new Map();
  // What is compiled, compiles and runs behind the others: a page that loads or rests leaves a core idle.
  const compiled = async () => {
    for (const [suite, prepare] of Object.entries({ native: prepareNativeSuite, wasm32: prepareWasm32Suite })) {
      if (!wanted(suite)) continue;
      const prepared = await prepare();
      results.set(suite, 'run' in prepared ? await prepared.run() : prepared);
    }
  };
  const others = async () => {
    if (wanted('ts')) results.set('ts', await runVitest('ts'));
    if (wanted('web') && hasWebTests()) results.set('web', await runWebSuite());
    if (wanted('consumers')) results.set('consumers', await runConsumers());
  };
  // To the end of both, whatever breaks off.
  const broken = (await Promise.allSettled([compiled(), others()])).find((side) => side.status === 'rejected');
  if (broken) throw broken.reason;

  /** @type {string[]} */
  const lines = [];
  const total = { passed: 0, failed: 0 };
  for (const suite of SUITES) {
    const result = results.get(suite);
    if (!result) continue;
    if ('notRun' in result) {
      lines.push(`${suite} suite: NOT RUN (${result.notRun})`);
      if (process.env[suite === 'consumers' ? 'REQUIRE_CONSUMERS' : 'REQUIRE_NATIVE'] === '1') total.failed += 1;
    } else {
      total.passed += result.passed;
      total.failed += result.failed;
      lines.push(`${suite} suite: ${result.passed} passed, ${result.failed} failed`);
    }
  }
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
