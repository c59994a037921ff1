import type { Rbf } from '../../../wasm/ts/runtime.ts';
import { range, type StateOf } from '../kit/channel.ts';
import { define } from '../kit/figure.ts';
import { linePlot } from '../kit/line-plot.ts';
import { dataOf, onALine, type PointSet } from '../kit/point-set.ts';
import { brief } from '../kit/words.ts';

/** A Gaussian about `center`, as high as its weight. */
const kernel = (center: number, weight: number, width: number) => ({
  evaluate: (xs: Float64Array, out: Float64Array) => {
    for (let i = 0; i < xs.length; i++) out[i] = weight * Math.exp(-((((xs[i] ?? 0) - center) / width) ** 2));
  },
});

/** The points at their places again, with the values of the sum of these kernels: what a dragged kernel changes. */
function valuesOf(points: PointSet, weights: ArrayLike<number>, width: number): PointSet {
  const values = points.places.map((x) =>
    points.places.reduce((sum, center, k) => sum + (weights[k] ?? 0) * Math.exp(-(((x - center) / width) ** 2)), 0),
  );
  return { ...points, values: values.map((value) => Number(value.toFixed(4))) };
}

interface Made {
  readonly rbf: Rbf;
  readonly weights: Float64Array;
  dispose(): void;
}

/** The numbers of the course's figure were not published: the points are made to show the same. */
const points = onALine([
  [1, 1.2],
  [2.2, 2.6],
  [3, 1.1],
  [4.6, 3.2],
  [6.6, 2.7],
  [7.4, 1],
  [9, 1.9],
]);
const parameters = { points, width: range('Width', { from: 0.2, to: 4, value: 1, scale: 'log' }) };

export default define({
  id: 'course-12',
  title: 'Weighted kernels, and their sum',
  parameters,
  presets: [
    {
      id: 'fig-12',
      name: 'Fig. 12',
      look: 'A kernel of one width stands at every point. The weights, found by solving a linear system, make the sum (dashed) pass through the points.',
      attempt: 'Drag a kernel by its top: its weight is its height, and the points follow the sum.',
      state: {},
    },
    {
      id: 'narrow',
      name: 'Narrow kernels',
      look: 'Each kernel holds its own point alone: its weight is the value.',
      state: { width: 0.3 },
    },
    { id: 'wide', name: 'Wide kernels', look: 'Neighbors share their work, with weights of both signs.', state: { width: 1.8 } },
  ],
  make: (hb, { points: set, width }): Made => {
    const rbf = hb.rbf({ ...dataOf(set), kernel: 'gaussian', width, degree: -1, onWarning: () => {} });
    return { rbf, weights: rbf.coefficients(), dispose: () => rbf.dispose() };
  },
  panels: {
    plot: linePlot<Made, StateOf<typeof parameters>>({
      label: 'Plot of the points, the kernels and their sum',
      frame: [0, 10, -2, 5],
      points: { points: 'points' },
      draw: (plot, { rbf, weights }, { points: set, width }, change) => {
        for (const [k, center] of set.places.entries()) plot.area(kernel(center, weights[k] ?? 0, width));
        plot.curve('Sum of kernels', rbf, { dashed: true });
        plot.handles(
          set.places.map((center, k) => ({
            name: `Kernel ${k}, weight ${brief(weights[k] ?? 0)}`,
            at: [center, weights[k] ?? 0],
            move: (_, height) => change({ points: valuesOf(set, weights.with(k, height), width) }),
          })),
        );
      },
    }),
  },
  told: ({ rbf, weights }, { points: set, width }) => {
    const sum = valuesOf(set, weights, width).values;
    return [
      ['largest weight', Math.max(...weights.map(Math.abs))],
      ['sum of kernels misses the points by', Math.max(...sum.map((value, i) => Math.abs(value - (set.values[i] ?? 0))))],
      ['weight of kernel 3', weights[3] ?? 0],
      ['condition', rbf.report().condition],
    ];
  },
});
