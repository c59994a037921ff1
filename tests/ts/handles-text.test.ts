/** Handles as the element's attribute writes them. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type AskedHandle, readHandles, writeHandles } from '../../web/element/handles-text.ts';

const seed = 20131;
const coordinate = fc.double({ noNaN: true, noDefaultInfinity: true });
const name = fc.stringMatching(/^[A-Za-z][\w ]{0,10}\w$/);
const handle: fc.Arbitrary<AskedHandle> = fc.record(
  { at: fc.tuple(coordinate, coordinate, coordinate), name },
  { requiredKeys: ['at'] },
);
const vertex: fc.Arbitrary<AskedHandle> = fc.record({ vertex: fc.nat(), name }, { requiredKeys: ['vertex'] });

describe('handles as text', () => {
  it(`come back as they were written (seed ${seed})`, () => {
    fc.assert(
      fc.property(fc.array(fc.oneof(handle, vertex)), (handles) => {
        const back = readHandles(writeHandles(handles));
        // Minus zero is zero.
        expect(back).toEqual(handles.map((one) => ('at' in one ? { ...one, at: one.at.map((x) => x + 0) } : one)));
      }),
      { seed },
    );
  });

  it('are read with names and without, at vertices and places', () => {
    expect(readHandles(' Nose: 13637, Tip of it: 0 1 -2.5 ,42,')).toEqual([
      { name: 'Nose', vertex: 13637 },
      { name: 'Tip of it', at: [0, 1, -2.5] },
      { vertex: 42 },
    ]);
    expect(readHandles('')).toEqual([]);
  });

  it.each(['nose', '1 2', '1.5', '-3', 'a: b: 3', '1 2 x', '1 2 3 4', '1e999 0 0'])('that are none are quoted: %s', (text) => {
    expect(() => readHandles(text)).toThrow(`“${text}”`);
  });
});
