/** Properties of the elements that are read before a model has come, from attributes that cannot be read. */
import { expect, it } from 'vitest';
import { HandleBodyElement, PoseSpaceElement } from '../../web/element/index.ts';

/** One of a page's whose attributes all say this. */
const saying = (text: string | null) => ({ getAttribute: { value: () => text } });

it.each([
  ['nose', []],
  ['Nose: 5', [{ name: 'Nose', vertex: 5 }]],
  [null, []],
])('handles of %j', (text, handles) => {
  expect(Object.create(HandleBodyElement.prototype, saying(text)).handles).toEqual(handles);
});

it.each([
  ['valence', {}],
  ['valence=0.6', { valence: 0.6 }],
  [null, {}],
])('at of %j', (text, at) => {
  expect(Object.create(PoseSpaceElement.prototype, saying(text)).at).toEqual(at);
});
