import { expect, it } from 'vitest';
import { ease } from '../../web/ui/motion.ts';

it('easing goes from 0 to 1, slow at both ends and never back', () => {
  expect([ease(0), ease(0.5), ease(1)]).toEqual([0, 0.5, 1]);
  const steps = Array.from({ length: 100 }, (_, i) => ease((i + 1) / 100) - ease(i / 100));
  expect(Math.min(...steps)).toBeGreaterThan(0);
  expect(steps[0]).toBeLessThan(0.001);
  expect(steps[99]).toBeLessThan(0.001);
  expect(Math.max(...steps)).toBeCloseTo(0.015, 4);
});

it('easing rests before its beginning and after its end', () => {
  expect([ease(-1), ease(2), ease(Number.POSITIVE_INFINITY)]).toEqual([0, 1, 1]);
});
