/** What an author says of a model as it is seen from its sides. */
import { describe, expect, it } from 'vitest';
import { describeView, readViews, sideOf } from '../../web/element/views-text.ts';

describe('views as text', () => {
  it('are read by their sides; words may hold colons', () => {
    expect(readViews(' front: It says: hello. |left:It looks away. |')).toEqual({
      front: 'It says: hello.',
      left: 'It looks away.',
    });
    expect(readViews('')).toEqual({});
  });

  it.each(['top: A head', 'front', 'front:', 'It looks at you', '__proto__: x'])('that are none are quoted: %s', (text) => {
    expect(() => readViews(text)).toThrow(`“${text}”`);
  });

  it('a camera is on one of six sides, front along +Z, at whatever distance', () => {
    const sides = [
      [[0, 0, 1], 'front'],
      [[0.5, 0.2, 1], 'front'],
      [[1, 0, 0], 'right'],
      [[0, 0, -2], 'back'],
      [[-0.1, 0, -2], 'back'],
      [[-3, 1, 0], 'left'],
      [[0, 5, 1], 'above'],
      [[0.1, -5, 0], 'below'],
    ] as const;
    for (const [[x, y, z], side] of sides) expect([x, y, z, sideOf({ x, y, z })]).toEqual([x, y, z, side]);
  });

  it('are told after the side', () => {
    expect(describeView('left', { left: 'It looks away.' })).toBe('Seen from the left. It looks away.');
    expect(describeView('above', {})).toBe('Seen from above.');
  });
});
