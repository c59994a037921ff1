import type { Rbf } from '../../../wasm/ts/runtime.ts';
import { choice, range, type StateOf } from '../kit/channel.ts';
import { fieldPlot } from '../kit/field-plot.ts';
import { define } from '../kit/figure.ts';
import { dataOf, inThePlane } from '../kit/point-set.ts';
import { brief } from '../kit/words.ts';

const points = inThePlane([
  [-1, -1, 0],
  [1, -1, 0],
  [1, 1, 0],
  [-1, 1, 0],
  [0, 0, 1],
]);
const decay = (label: string, value: number) => range(label, { from: 1e-10, to: 10, value, scale: 'log-zero' });
const parameters = {
  points,
  width: range('Width', { from: 0.2, to: 10, value: 2, scale: 'log' }),
  first: decay('λ, first map', 0),
  second: decay('λ, second map', 0.01),
  third: decay('λ, third map', 0.1),
  scale: choice('Colors', { one: 'one scale for all maps', own: 'a scale for each map, as in the course' }),
  section: choice('Section', { diagonal: 'along the diagonal', across: 'across the middle', off: 'none' }),
};

interface Made {
  /** One for each λ. */
  readonly fits: readonly (readonly [decay: number, rbf: Rbf])[];
  dispose(): void;
}

/** Least value of a function along the diagonal of the picture. */
function least(rbf: Rbf): number {
  const steps = 600;
  const diagonal = Float64Array.from({ length: 2 * steps }, (_, i) => -3 + (6 * Math.floor(i / 2)) / (steps - 1));
  return Math.min(...rbf.evaluate(diagonal));
}

export default define({
  id: 'course-20',
  title: 'Four corners and a peak, regularized',
  parameters,
  presets: [
    {
      id: 'fig-20',
      name: 'Fig. 20',
      look: 'Zero at the corners of a square, one in the middle, and a Gaussian that is too broad: beyond the corners it plunges below zero. Weight decay λ tames that, and misses the peak.',
      attempt: 'Add a point of another value close to the middle: without λ the field runs away.',
      state: {},
    },
    {
      id: 'own-scales',
      name: 'As in the course',
      look: 'Each map has colors of its own, so that depths cannot be compared.',
      state: { scale: 'own' },
    },
    { id: 'narrow', name: 'A narrower Gaussian', look: 'There is little to tame.', state: { width: 0.8 } },
  ],
  shown: ['scale', 'section'],
  make: (hb, { points: set, width, first, second, third }): Made => {
    const fits = [first, second, third].map((weightDecay) => {
      const rbf = hb.rbf({ ...dataOf(set), kernel: 'gaussian', width, degree: -1, weightDecay, onWarning: () => {} });
      return [weightDecay, rbf] as const;
    });
    return {
      fits,
      dispose: () => {
        for (const [, rbf] of fits) rbf.dispose();
      },
    };
  },
  panels: {
    maps: fieldPlot<Made, StateOf<typeof parameters>>({
      frame: [-3, 3, -3, 3],
      points: 'points',
      maps: ({ fits }) => fits.map(([lambda, source]) => ({ name: 'Gaussian', detail: `λ = ${brief(lambda)}`, source })),
      ownScales: ({ scale }) => scale === 'own',
      section: ({ section }) => section,
    }),
  },
  told: ({ fits }, { points: set }) =>
    fits.flatMap(([lambda, rbf]) => [
      [`least along the diagonal, λ = ${brief(lambda)}`, least(rbf)],
      [
        `misses the points by, λ = ${brief(lambda)}`,
        Math.max(...rbf.evaluate(set.places).map((value, i) => Math.abs(value - (set.values[i] ?? 0)))),
      ],
    ]),
});
