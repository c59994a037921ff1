/** `npm run bench -- figures`: a hundred rounds through all figures in one page. What the page holds must not grow. */
import { writeFileSync } from 'node:fs';
import { chromium } from 'playwright-core';
import { preview } from 'vite';
import { CHROMIUM_ARGS, findChromium } from '../../../scripts/chromium.mjs';
import { at } from '../../../scripts/lib/paths.mjs';
import { buildSite } from '../../../scripts/lib/site.mjs';
import { goRound, growth, INTERPRETED } from './rounds.mjs';

const ROUNDS = 100;

export async function benchFigures() {
  await buildSite();
  const configFile = at('vite.config.ts');
  const server = await preview({ configFile, logLevel: 'warn', preview: { port: 4199, host: '127.0.0.1' } });
  const browser = await chromium.launch({ executablePath: await findChromium(), args: [...CHROMIUM_ARGS, ...INTERPRETED] });
  try {
    const page = await browser.newPage({ viewport: { width: 900, height: 600 }, reducedMotion: 'reduce' });
    const address = `${server.resolvedUrls?.local[0]}learn/figures/`;
    const held = await goRound(page, address, ROUNDS, (round) => {
      if (round % 10 === 9) console.log(`${round + 1} of ${ROUNDS} rounds`);
    });
    const grown = growth(held);
    console.log('\nThe most that a count differs from what it was after the tenth round:');
    for (const [name, part] of Object.entries(grown)) console.log(`  ${name.padEnd(10)} ${(100 * part).toFixed(2)} %`);
    const record = { what: `${ROUNDS} rounds through all figures in one page`, tenth: held[9], last: held.at(-1), grown };
    writeFileSync(at('tests', 'bench', 'figures', 'results.json'), `${JSON.stringify(record, null, 2)}\n`);
  } finally {
    await browser.close();
    await server.close();
  }
}
