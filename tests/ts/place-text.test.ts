/** Places in a pose space as the element's attribute writes them. */
import { describe, expect, it } from 'vitest';
import { placeIn, readPlace } from '../../web/element/place-text.ts';

const dimensions = [{ name: 'valence' }, { name: 'arousal' }];

describe('a place as text', () => {
  it('is read by names, in any order; what is left out is 0', () => {
    expect(placeIn(dimensions, readPlace(' arousal = -0.4,valence=0.6 '))).toEqual([0.6, -0.4]);
    expect(placeIn(dimensions, readPlace('arousal=1e-1'))).toEqual([0, 0.1]);
    expect(placeIn(dimensions, readPlace(''))).toEqual([0, 0]);
  });

  it.each(['valence', '0.6 0.4', 'valence=', 'valence=x', '=1', 'valence=1=2', 'valence=Infinity'])(
    'that is none is quoted: %s',
    (text) => {
      expect(() => readPlace(text)).toThrow(`“${text}”`);
    },
  );

  it.each(['joy', 'toString', '__proto__'])('in a dimension that there is not names it: %s', (name) => {
    expect(() => placeIn(dimensions, readPlace(`${name}=1`))).toThrow(`“${name}”`);
  });
});
