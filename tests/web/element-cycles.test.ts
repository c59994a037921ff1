/** Elements that come and go: the short form of `npm run bench -- elements`. */
import { expect, it, onTestFinished } from 'vitest';
import { comeAndGo, countAsked } from '../bench/elements/cycles.mjs';
import { growth, INTERPRETED } from '../bench/figures/rounds.mjs';
import { launch } from './support/studio.ts';
import { tagPage } from './support/tag-page.ts';

it('twelve times a cow, a face and a figure leave nothing behind, on the page, in the solver or on the graphics card', async () => {
  const browser = await launch(INTERPRETED);
  onTestFinished(() => browser.close());
  const { page } = await tagPage(browser, '', { before: countAsked });
  const size = 'style="display: block; width: 16rem; aspect-ratio: 4 / 3"';
  const tags = `<handle-body src="spot.glb" alt="A cow" ${size}></handle-body>
    <pose-space src="face.glb" alt="A face" ${size}></pose-space><handle-figure name="course-12"></handle-figure>`;
  const held = await comeAndGo(page, tags, 12);
  expect(held[9]?.programs).toBeGreaterThan(0);
  const { heap, ...grown } = growth(held);
  expect(grown).toEqual({ nodes: 0, listeners: 0, solver: 0, buffers: 0, textures: 0, programs: 0 });
  expect(heap).toBeLessThan(0.02);
});
