import { expect, it } from 'vitest';

it('importing the elements where there is no page defines nothing and throws nothing', async () => {
  expect(globalThis.customElements).toBeUndefined();
  const { HandleBodyElement, HandleFigureElement } = await import('../../web/element/index.ts');
  expect([typeof HandleBodyElement, typeof HandleFigureElement]).toEqual(['function', 'function']);
});
