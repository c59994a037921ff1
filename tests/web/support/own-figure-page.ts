/** Run by Chromium: an application with a figure of its own; see own-figure.test.ts. */
import type { Shepard } from '../../../wasm/ts/runtime.ts';
import '../../../web/element/index.ts';
import { define, linePlot, onALine, registerFigure, type StateOf } from '../../../web/figures/index.ts';

// biome-ignore format: one place
const parameters = { points: onALine([[1, 2], [3, 4]]) };

registerFigure(
  define<typeof parameters, Shepard>({
    id: 'mine',
    title: 'Through two points',
    parameters,
    presets: [{ id: 'first', name: 'As it begins', look: 'The curve passes through the points.', state: {} }],
    make: (hb, { points: set }) => hb.shepard({ dimension: 1, points: set.places, values: set.values }),
    panels: {
      plot: linePlot<Shepard, StateOf<typeof parameters>>({
        label: 'A curve through two points',
        frame: [0, 4, 0, 5],
        points: { points: 'points' },
        draw: (plot, f) => plot.curve('Shepard', f),
      }),
    },
    told: (f) => [['in the middle', f.evaluate(Float64Array.of(2))[0] ?? Number.NaN]],
  }),
);
