import { linePlot } from '../../kit/line-plot.ts';
import type { State } from './channels.ts';
import type { Fits } from './fits.ts';
import { weightedKernels } from './kernel-curves.ts';
import { POINTS } from './points.ts';

/** Points on a line, their interpolants as curves through them. */
export const linePanel = linePlot<Fits, State>({
  label: 'Plot of the points and their interpolants',
  shown: ({ d }) => d === 1,
  frame: (state) => state.in,
  points: POINTS,
  draw: (plot, fits, { show }) => {
    for (const fit of fits.seen) {
      const { label, model, interpolant, rbf, problem } = fit;
      const stale = problem !== undefined;
      if (interpolant)
        plot.curve(label.name, interpolant, { ...model, detail: label.detail, stale, dashed: show.kernels && !!rbf });
      const kernels = show.kernels && !stale && weightedKernels(fits.hb, fit, fits.data, plot.xs);
      for (let at = 0; kernels && at < kernels.length; at += plot.xs.length)
        plot.area({ evaluate: (xs, out) => out.set(kernels.subarray(at, at + xs.length)) });
    }
  },
});

/** The chosen point's weight along the line, for each interpolant: its cardinal function. */
export const weightPanel = linePlot<Fits, State>({
  label: 'Plot of the weight of the chosen point',
  title: ({ pick }) => `Weight of point ${pick}`,
  shown: ({ d, show, pick }) => d === 1 && show.cardinal && pick >= 0,
  frame: ({ in: [left, right] }) => [left, right, -0.5, 1.3],
  through: ({ p }) => p.places,
  low: true,
  draw: (plot, { seen }, { pick, p: { values } }) => {
    for (const { label, model, interpolant, problem } of seen) {
      if (!interpolant || problem !== undefined) continue;
      const weight = (xs: Float64Array, out: Float64Array) => {
        const all = interpolant.weights(xs);
        for (let i = 0; i < xs.length; i++) out[i] = all[i * values.length + pick] as number;
      };
      plot.curve(label.name, { evaluate: weight }, { ...model, detail: label.detail });
    }
  },
});
