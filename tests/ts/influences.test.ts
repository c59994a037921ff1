import { describe, expect, it } from 'vitest';
import { rangesOf, setInfluences } from '../../web/three/influences.ts';

describe('the influences of morph targets', () => {
  const examples = [
    [0, 1, 0.5, 0],
    [1, 0, -0.25, 1.5],
  ];
  const ranges = rangesOf(examples);

  it('are what they were at the examples', () => {
    for (const shape of examples) {
      const influences = [9, 9, 9, 9];
      setInfluences(influences, Float64Array.from(shape), ranges);
      expect(influences).toEqual(shape);
    }
  });

  it('stay within 0 and 1, or within what the examples ask for', () => {
    const influences = [0, 0, 0, 0, 7];
    setInfluences(influences, [-0.06, 1.04, -0.3, 1.6], ranges);
    expect(influences).toEqual([0, 1, -0.25, 1.5, 7]);
  });

  it('stay as they are where no example moves them, and go where a mesh has them', () => {
    const [few, other] = [
      [3, 4, 5, 6],
      [3, 4, 5],
    ];
    const used = rangesOf([
      [0, 0, 1],
      [0, 0, 0.5],
    ]);
    setInfluences(few, [0.4, 0.5, 0.6], used);
    expect(few).toEqual([3, 4, 0.6, 6]);
    setInfluences(other, [0.4, 0.5, 0.6], used, [undefined, 2, 0]);
    expect(other).toEqual([0.6, 4, 5]);
  });

  it('need no example', () => {
    expect(rangesOf([])).toEqual([]);
  });
});
