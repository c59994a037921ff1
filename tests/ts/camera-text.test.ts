/** From where a model is seen, as the element's attribute writes it. */
import { expect, it } from 'vitest';
import { readCamera } from '../../web/element/camera-text.ts';

it.each([
  ['58deg 14deg', [58, 14]],
  [' -30 ', [-30]],
  ['1e1deg', [10]],
  ['', []],
])('a camera is read: “%s”', (text, angles) => expect(readCamera(text)).toEqual(angles));

it.each(['left', '58rad', '58deg 14deg 2m', 'deg', 'NaN', '58,14', 'Infinity'])('one that is none is quoted: %s', (text) => {
  expect(() => readCamera(text)).toThrow(`“${text}”`);
});
