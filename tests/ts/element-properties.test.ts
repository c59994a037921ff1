/** Properties of the elements before a model has come: read from attributes that cannot be read, and set to what they cannot be. */
import { expect, it } from 'vitest';
import { fakePage } from './support/fake-page.ts';

// The elements extend the page's.
fakePage();
const { HandleBodyElement, HandleFigureElement, PoseSpaceElement } = await import('../../web/element/index.ts');

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

const place = [0, 1, 0] as const;
const body = (properties: object) => [new HandleBodyElement(), properties] as const;
const pose = (properties: object) => [new PoseSpaceElement(), properties] as const;

it.each([
  ['alt', body({ alt: 3 })],
  ['src', body({ src: { href: 'dog.glb' } })],
  ['controls', body({ controls: 'false' })],
  ['handles', body({ handles: null })],
  ['handles[1]', body({ handles: [{ vertex: 1 }, { vertex: -1 }] })],
  ['handles[0]', body({ handles: [{ at: [0, 1, Number.NaN] }] })],
  ['handles[0]', body({ handles: [{ name: 3, vertex: 1 }] })],
  ['targets', body({ targets: [place, [0, 1]] })],
  ['at', pose({ at: [0.6, 0.4] })],
  ['at.valence', pose({ at: { valence: Number.NaN } })],
  ['at.arousal', pose({ at: { valence: 0.5, arousal: '0.4' } })],
  ['state', [new HandleFigureElement(), { state: null }] as const],
])('a wrong %s is told with its name, and what was there stays', (name, [element, properties]) => {
  const [key] = Object.keys(properties) as [keyof typeof element];
  const before = element[key];
  const told: unknown[] = [];
  element.addEventListener('error', (event) => told.push((event as CustomEvent).detail));
  Object.assign(element, properties);
  expect(told).toEqual([
    {
      code: 'invalid-option',
      message: expect.stringContaining(`The property ${name} is `),
      remedy: expect.stringMatching(/^Give /),
    },
  ]);
  expect(element[key]).toEqual(before);
});

it('undefined is as without the attribute', () => {
  const element = new HandleBodyElement();
  Object.assign(element, { alt: 'A dog', controls: true, handles: [{ name: 'Nose', vertex: 5 }, { at: place }] });
  expect([element.alt, element.controls]).toEqual(['A dog', true]);
  expect(element.getAttribute('handles')).toBe('Nose: 5, 0 1 0');
  Object.assign(element, { alt: undefined, controls: undefined, handles: undefined });
  expect([element.alt, element.controls, element.handles, element.getAttribute('alt')]).toEqual(['', false, [], null]);
});
