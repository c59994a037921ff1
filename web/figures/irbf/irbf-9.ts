import type { BodyData } from '../../../wasm/ts/types.ts';
import { baked } from '../kit/baked.ts';
import { boxSurface } from '../kit/box.ts';
import { autoRange, type StateOf } from '../kit/channel.ts';
import { define } from '../kit/figure.ts';
import { HeldBody } from '../kit/held-body.ts';
import { linePlot } from '../kit/line-plot.ts';
import { BAR, ENERGY } from '../kit/paper-energy.ts';
import { through } from '../kit/samples.ts';
import { inSpace } from '../kit/space-points.ts';
import { stagePlot } from '../kit/stage-plot.ts';

const box = boxSurface([10, 2, 2], [40, 8, 8]);
/** The left end is held; the last one is dragged. */
const ANCHORS = [-4.8, 0, 0, -4.8, 0.8, 0, -4.8, 0, 0.8, 4.8, 0, 0];
const NAMES = ['Left end', 'Left end, above', 'Left end, in front', 'Right end'];
const EXPONENTS = Array.from({ length: 19 }, (_, i) => i / 2 - 9);
/** Along the axis, from before the farthest large sphere to the end: beyond it nothing but smoothness holds the bar together. */
const BEYOND = Float64Array.from({ length: 300 }, (_, i) => (i % 3 === 0 ? 3.5 + (1.4 * i) / 297 : 0));

const parameters = {
  smoothness: autoRange('λ', { from: 1e-9, to: 1, value: 'auto', scale: 'log' }),
  places: inSpace([-4.8, 0, 0, -4.8, 0.8, 0, -4.8, 0, 0.8, 3.2, 3.2, 0]),
};
type State = StateOf<typeof parameters>;

/** For each exponent of λ, and what the solver would choose: the last ones of a body, which stay while λ is moved. */
const sweeps = new WeakMap<BodyData, { places: readonly number[]; automatic: number; jumps: number[]; strains: number[] }>();

interface Made {
  readonly held: HeldBody;
  readonly body: BodyData;
  hold(smoothness: number | 'auto', places: readonly number[]): HeldBody;
  dispose(): void;
}

export default define({
  id: 'irbf-9',
  title: 'λ, from far too small to far too large',
  parameters,
  presets: [
    {
      id: 'automatic',
      name: 'Automatic λ',
      look: 'A bar with only 7 spheres, held at its left end. λ balances the spheres, which want to stay as they are, and the smoothness of what lies between and beyond them.',
      attempt: 'Drag the right end; then move λ.',
      state: {},
    },
    {
      id: 'small',
      name: 'Far too small',
      look: 'The spheres are rigid, and beyond the farthest one the bar is torn: nothing keeps it smooth.',
      state: { smoothness: 1e-9 },
    },
    {
      id: 'large',
      name: 'Far too large',
      look: 'Smooth, but the spheres have no say: the bar is sheared instead of bent.',
      state: { smoothness: 1 },
    },
  ],
  moving: ['places'],
  make: async (hb, { smoothness, places }, work): Promise<Made> => {
    const body = await baked('bar-7', () => box, { ...BAR, spheres: 7 }, work);
    const hold: Made['hold'] = (lambda, at) => {
      const held = new HeldBody(hb, body, ANCHORS, { ...ENERGY, smoothness: lambda });
      held.pull(at);
      held.settle();
      return held;
    };
    const held = hold(smoothness, places);
    return { held, body, hold, dispose: () => held.dispose() };
  },
  move: ({ held }, { places }) => {
    held.pull(places);
    return held.follow();
  },
  settle: ({ body, hold }, { places }) => {
    if (sweeps.get(body)?.places === places) return;
    const all = [...EXPONENTS.map((exponent) => 10 ** exponent), 'auto' as const].map((smoothness) => hold(smoothness, places));
    const automatic = all.at(-1)?.irbf.report().smoothness ?? 0;
    sweeps.set(body, {
      places,
      automatic,
      jumps: all.map((held) => held.stretch(BEYOND)),
      strains: all.map(({ strain }) => strain),
    });
    for (const held of all) held.dispose();
  },
  panels: {
    bar: stagePlot<Made, State>({
      label: 'The bar and its spheres',
      view: () => ({ azimuth: 18, elevation: 20 }),
      draw: (stage, { held }) => {
        stage.surface(box, (surface) => {
          surface.positions.set(held.positions);
          surface.seeThrough(true);
        });
        stage.balls(held.ends).points('places', NAMES, ANCHORS);
      },
    }),
    balance: linePlot<Made, State>({
      label: 'Plot over the logarithm of λ',
      frame: [-9, 0, 0, 3],
      draw: (plot, { body }, state, change) => {
        const { automatic, jumps, strains } = sweeps.get(body) ?? { automatic: 1e-5, jumps: [], strains: [] };
        const exponent = Math.log10(state.smoothness === 'auto' ? automatic : state.smoothness);
        plot.curve('Jump', through(EXPONENTS, jumps), { detail: 'stretch at the far sphere' });
        plot.curve('Misfit', through(EXPONENTS, strains), { detail: 'strain of the spheres', dashed: true });
        plot.rule(Math.log10(automatic), 'automatic λ').handles([
          {
            name: `λ, 10 to the power ${exponent.toFixed(1)}`,
            at: [exponent, 0],
            move: (x) => change({ smoothness: Number((10 ** Math.min(Math.max(x, -9), 0)).toPrecision(2)) }),
          },
        ]);
      },
    }),
  },
  told: ({ held, body }) => [
    ['jump near the farthest sphere', held.stretch(BEYOND)],
    ['misfit of the spheres', held.strain],
    ['λ', held.irbf.report().smoothness],
    ['automatic λ', sweeps.get(body)?.automatic ?? 0],
    ['volume, of that at rest', held.irbf.report().volumeRatio],
  ],
});
