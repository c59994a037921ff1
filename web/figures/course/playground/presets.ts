import type { PointSet } from '../../kit/point-set.ts';
import type { Frame } from '../../kit/samples.ts';
import { colorRange } from '../../kit/scale.ts';
import type { Preset } from '../../kit/state-text.ts';
import { parameters, type State } from './channels.ts';
import { PLAIN, type Show } from './experiment.ts';

/** The course does not publish the numbers of its figures; these are made to show the same. Figures 9 to 16 share their points. */
const SEVEN = { points: [1, 2.2, 3, 4.6, 6.6, 7.4, 9], values: [1.2, 2.6, 1.1, 3.2, 2.7, 1, 1.9] };
const STEPS = { points: [0.5, 2, 3.2, 5, 6.2, 8, 9.5], values: [0.6, 0.7, 3.3, 3.4, 1.1, 1.2, 0.9] };
const BELL = {
  points: [1, 1.7, 2.4, 3.2, 3.9, 4.6, 5.4, 6.1, 6.9, 7.6, 8.4, 9],
  values: [1, 1.46, 1.7, 2.26, 2.42, 2.7, 2.58, 2.62, 2.2, 2.02, 1.44, 1.2],
};
const WAVE = {
  points: [0.8, 1.6, 2.4, 3.2, 4, 4.8, 5.6, 6.4, 7.2, 8, 8.8],
  values: [1.4, 1.9, 2.3, 2.5, 2.4, 4, 1.9, 1.6, 1.5, 1.6, 1.8],
};
const RAMP = {
  points: [0.8, 1.7, 2.5, 3.3, 4.2, 5, 5.9, 6.7, 7.5, 8.4, 9.2],
  values: [0.6, 0.8, 1.1, 1.5, 1.9, 2.3, 2.6, 0.9, 3, 3.1, 3.1],
};
const SQUARE = { points: [-1, -1, 1, -1, 1, 1, -1, 1, 0, 0], values: [0, 0, 0, 0, 1] };
const HILLS = {
  points: [-0.9, -0.7, -0.2, -0.95, 0.75, -0.8, -1, 0.15, -0.35, -0.1, 0.35, 0.1, 0.95, 0.3, -0.6, 0.85, 0.15, 0.75, 0.85, 0.95],
  values: [0.2, 0.5, 0.1, 0.6, 1, 0.3, 0.7, 0.2, 0.8, 0.4],
};

const LINE: Frame = [0, 10, -0.6, 4.4];
const PLANE: Frame = [-1.4, 1.4, -1.4, 1.4];

/** What a preset begins with: points, interpolants as links name them, and what is drawn besides them. */
function made(
  dimension: 1 | 2,
  { points, values }: { readonly points: readonly number[]; readonly values: readonly number[] },
  interpolants: string,
  show: Partial<Show> = {},
  frame: Frame = dimension === 1 ? LINE : PLANE,
): Partial<State> {
  const p: PointSet = { dimension, places: points, values };
  const left: string[] = [];
  const m = parameters.m.read(interpolants, left, { d: dimension }) ?? [];
  if (left.length > 0) throw new Error(`A preset asks for what there is not: ${left}.`);
  return { d: dimension, p, m, in: frame, range: colorRange(values), show: { ...PLAIN, ...show } };
}

export const PRESETS: readonly Preset<typeof parameters>[] = [
  {
    id: 'line',
    name: 'All at once',
    title: 'One set of points, six ways through it',
    look: 'Every curve passes through every point; between the points they disagree. Watch who overshoots, who goes flat at the points, and what becomes of each beyond the last point.',
    attempt: 'Drag one point far up. Which curves move only nearby, and which everywhere?',
    state: made(1, SEVEN, 'shepard:power=2~mls:degree=1~linear~tension:beta=3~rbf:kernel=gaussian~rbf:kernel=cubic'),
  },
  {
    id: 'fig-9',
    name: 'Fig. 9',
    title: 'Shepard’s method, p = 2',
    look: 'The curve is smooth, yet it rests at every point: its slope there is zero, so it climbs in uneven steps. Far away it tends to the average of all values.',
    attempt: 'Raise p: the steps get harder. Raise ε a little: the curve no longer reaches its points.',
    state: made(1, SEVEN, 'shepard:power=2'),
  },
  {
    id: 'fig-10',
    name: 'Fig. 10',
    title: 'Shepard’s method, p = 1',
    look: 'With p = 1 the flat spots turn into cusps, and between points the curve leans toward the average.',
    attempt: 'Move p slowly from 1 to 2 and watch one point: the tip opens into a flat shelf.',
    state: made(1, SEVEN, 'shepard:power=1'),
  },
  {
    id: 'fig-11',
    name: 'Fig. 11',
    title: 'A cubic spline, and one with tension',
    look: 'Both curves leave their ends with zero slope. The cubic spline is the smoother one and swings beyond the points; tension pulls it straight, as one pulls a string.',
    attempt: 'Move β: toward 0 the curves agree, toward 1000 the second becomes a zigzag of straight lines.',
    state: made(1, STEPS, 'tension:beta=0:ends=zero-slope~tension:beta=20:ends=zero-slope'),
  },
  {
    id: 'fig-12',
    name: 'Fig. 12',
    title: 'Weighted kernels, and their sum',
    look: 'A kernel of one width stands at every point. The weights, found by solving a linear system, make the sum (dashed) pass through the points; one may well be negative.',
    attempt: 'Drag a point below its neighbors and watch the weights of all of them change.',
    state: made(1, SEVEN, 'rbf:fit=own:width=1', { kernels: true }),
  },
  {
    id: 'fig-13',
    name: 'Fig. 13',
    title: 'A Gaussian of a fitting width',
    look: 'A width near the spacing of the points gives a smooth curve. Beyond the last point it comes back to zero: nothing there holds it up.',
    attempt: 'Move the point on the right toward the edge and see how soon the curve lets go between it and the others.',
    state: made(1, SEVEN, 'rbf:fit=own:width=1.2'),
  },
  {
    id: 'fig-14',
    name: 'Fig. 14',
    title: 'The same Gaussian, wider',
    look: 'Half as wide again, the curve is rounder and swings farther out where points are sparse. Its condition number has grown.',
    attempt: 'Widen on, step by step: the curve hardly changes any more, the condition number explodes.',
    state: made(1, SEVEN, 'rbf:fit=own:width=1.9'),
  },
  {
    id: 'fig-15',
    name: 'Fig. 15',
    title: 'The same Gaussian, too narrow',
    look: 'Each kernel reaches no further than its own point, so the curve falls to zero between them: it interpolates, and is of no use.',
    attempt: 'Press the button beside the warning, or add points until the spikes join.',
    state: made(1, SEVEN, 'rbf:fit=own:width=0.25'),
  },
  {
    id: 'fig-16',
    name: 'Fig. 16',
    title: 'The natural cubic spline',
    look: 'The kernel r³ with a straight line added: of all curves through the points, the one that bends least. Beyond them it goes on as a straight line, for ever.',
    attempt: 'Drag the last point and watch where the straight part points to. Then compare a Gaussian.',
    state: made(1, SEVEN, 'rbf:kernel=cubic'),
  },
  {
    id: 'fig-17',
    name: 'Fig. 17',
    title: 'A clamped plate beside a Gaussian',
    look: 'Both fall to zero away from the points. The clamped plate bends less on its way, the Gaussian is smoother by the count of its derivatives: two ideas of smoothness.',
    attempt: 'Widen the Gaussian until it looks as calm, and see what it does at the sides.',
    state: made(
      1,
      { points: [2.4, 3.4, 4.2, 5.4, 6.2, 7.4], values: [1.1, 1.5, 2.7, 2.2, 2.9, 1] },
      'rbf:kernel=clamped-plate:fit=own:width=4.4~rbf:fit=own:width=0.8',
    ),
  },
  {
    id: 'fig-18',
    name: 'Fig. 18',
    title: 'The cubic spline, regularized',
    look: 'Smoothing lets the curve miss its points for the sake of bending less. It approximates now: the rings are no longer on the line.',
    attempt: 'Raise the smoothing to its end: only the straight line of least squares is left.',
    state: made(1, SEVEN, 'rbf:kernel=cubic~rbf:kernel=cubic:smoothing=1'),
  },
  {
    id: 'fig-19',
    name: 'Fig. 19',
    title: 'Too broad, and cured',
    look: 'Kernels much broader than the spacing make rows of the matrix nearly alike. Then small bumps of the data swing far between the points and out of the picture beside them. A smoothing of 1e−5 tames the curve, which misses its points by less than a tenth.',
    attempt: 'Compare the condition numbers, and the weights: huge numbers that cancel. Then drag one point a little.',
    state: made(1, BELL, 'rbf:fit=own:width=5~rbf:fit=own:width=5:smoothing=1e-5'),
  },
  {
    id: 'fig-20',
    name: 'Fig. 20',
    title: 'Four corners and a peak',
    look: 'Zero at the corners of a square, one in the middle, and a Gaussian that is too broad: beyond the corners it plunges below zero, by half the height of the peak. Weight decay of 0.01 and 0.1 tames that, and misses the peak.',
    attempt:
      'Add a point of another value close to the middle: without regularization the field runs away, with it nothing much happens.',
    state: made(
      2,
      SQUARE,
      'rbf:fit=own:width=2~rbf:fit=own:width=2:decay=0.01~rbf:fit=own:width=2:decay=0.1',
      { section: 'diagonal' },
      [-3, 3, -3, 3],
    ),
  },
  {
    id: 'fig-21',
    name: 'Fig. 21',
    title: 'An outlier, found by the norm',
    look: 'The star marks the point that the curve bends for: without it the norm of the function, a measure of all bending, falls most.',
    attempt: 'Drag the marked point back among the others until its star goes out.',
    state: made(1, WAVE, 'rbf:kernel=cubic', { outliers: 'leave-one-out' }),
  },
  {
    id: 'fig-21b',
    name: 'Fig. 21 (2)',
    title: 'An outlier in a ramp',
    look: 'One value was saved at a wrong place. Here the simpler idea finds it: smooth the curve, then take the point that is farthest from it.',
    attempt: 'Make a second bad point: they are found one after another, each time without those found before.',
    state: made(1, RAMP, 'rbf:kernel=cubic', { outliers: 'residual' }),
  },
  {
    id: 'plane',
    name: 'In the plane',
    title: 'The same methods in the plane',
    look: 'One picture for each method, all in the same colors. Look for ridges, for flat spots around the points, and at the corners, where there are no points.',
    attempt: 'Drag a point, give it another value with the slider on the legend, or look at the surfaces.',
    state: made(2, HILLS, 'shepard:power=2~mls:degree=1~linear~natural~rbf:kernel=gaussian~rbf:kernel=thin-plate'),
  },
];
