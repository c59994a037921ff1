import { type AnyFigure, checkFigure } from './kit/figure.ts';

const own = new Map<string, AnyFigure>();

/**
 * Lets `<handle-figure name="…">` show a figure of your own, by its `id`. Call it before the tag is there. A figure of the same `id` that
 * was there before is replaced.
 *
 * ```ts
 * import type { Shepard } from 'handlebody';
 * import { define, linePlot, onALine, registerFigure, type StateOf } from 'handlebody/figure';
 * const parameters = { points: onALine([[1, 2], [3, 1], [4, 3]]) };
 * const figure = define({
 *   id: 'my-figure',
 *   title: 'Through three points',
 *   parameters,
 *   presets: [{ id: 'first', name: 'As it begins', look: 'The curve passes through the points.', state: {} }],
 *   make: (hb, { points: set }) => hb.shepard({ dimension: 1, points: set.places, values: set.values }),
 *   panels: {
 *     plot: linePlot<Shepard, StateOf<typeof parameters>>({
 *       label: 'A curve through three points',
 *       frame: [0, 5, 0, 4],
 *       points: { points: 'points' },
 *       draw: (plot, f) => plot.curve('Shepard', f),
 *     }),
 *   },
 * });
 * registerFigure(figure); // <handle-figure name="my-figure" controls caption></handle-figure>
 * ```
 */
export function registerFigure(figure: AnyFigure): void {
  checkFigure(figure);
  own.set(figure.id, figure);
}

/** One that was registered. @internal */
export function registeredFigure(id: string): AnyFigure | undefined {
  return own.get(id);
}
