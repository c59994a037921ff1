import { expect, inject, it, onTestFinished } from 'vitest';
import { goRound, growth, INTERPRETED } from '../bench/figures/rounds.mjs';
import { launch } from './support/studio.ts';

it('twelve rounds through all figures leave nothing behind', async () => {
  const browser = await launch(INTERPRETED);
  onTestFinished(() => browser.close());
  const page = await browser.newPage({ viewport: { width: 700, height: 500 }, reducedMotion: 'reduce' });
  const { heap, ...grown } = growth(await goRound(page, `${inject('site')}learn/figures/`, 12));
  expect(grown).toEqual({ nodes: 0, listeners: 0, solver: 0 });
  expect(heap).toBeLessThan(0.02);
  // A round takes some ten seconds of interpreted code on two cores: the limit is for what hangs.
}, 400_000);
