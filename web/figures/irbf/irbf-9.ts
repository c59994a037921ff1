import type { HandlebodyRuntime } from '../../../wasm/ts/runtime.ts';
import type { BodyData } from '../../../wasm/ts/types.ts';
import { baked } from '../kit/baked.ts';
import { boxSurface } from '../kit/box.ts';
import { autoRange, type StateOf } from '../kit/channel.ts';
import { define } from '../kit/figure.ts';
import { HeldBody, rows } from '../kit/held-body.ts';
import { linePlot } from '../kit/line-plot.ts';
import { inSpace, placed } from '../kit/space-points.ts';
import { stagePlot } from '../kit/stage-plot.ts';

const box = boxSurface([10, 2, 2], [40, 8, 8]);
/** The left end is held; the last one is dragged. */
const ANCHORS = [-4.8, 0, 0, -4.8, 0.8, 0, -4.8, 0, 0.8, 4.8, 0, 0];
const NAMES = ['Left end', 'Left end, above', 'Left end, in front', 'Right end'];
const EXPONENTS = Array.from({ length: 19 }, (_, i) => i / 2 - 9);
/** Along the bar's axis, from before the farthest large sphere to the end. */
const BEYOND = Float64Array.from({ length: 300 }, (_, i) => (i % 3 === 0 ? 3.5 + (1.4 * i) / 297 : 0));

const parameters = {
  smoothness: autoRange('λ', { from: 1e-9, to: 1, value: 'auto', scale: 'log' }),
  places: inSpace([-4.8, 0, 0, -4.8, 0.8, 0, -4.8, 0, 0.8, 3.2, 3.2, 0]),
};
type State = StateOf<typeof parameters>;

/** The largest stretch of the axis near the farthest sphere: beyond it nothing but smoothness holds the bar together. */
function jump({ irbf }: HeldBody): number {
  const image = irbf.evaluate(BEYOND);
  let most = 0;
  for (let i = 3; i < image.length; i += 3) {
    const step = Math.hypot(...[0, 1, 2].map((k) => (image[i + k] ?? 0) - (image[i - 3 + k] ?? 0)));
    most = Math.max(most, step / ((BEYOND[i] ?? 0) - (BEYOND[i - 3] ?? 0)));
  }
  return most;
}

interface Curves {
  readonly places: readonly number[];
  readonly jump: Float64Array;
  readonly strain: Float64Array;
}

/** The last ones, which stay while λ is moved. */
const sweeps = new WeakMap<BodyData, Curves>();

class Made {
  readonly held: HeldBody;
  /** λ, as given or as chosen. */
  readonly smoothness: number;
  /** What the solver would choose. */
  readonly automatic: number;
  curves: Curves;
  readonly #hb: HandlebodyRuntime;
  readonly #body: BodyData;

  constructor(hb: HandlebodyRuntime, body: BodyData, { smoothness, places }: State) {
    [this.#hb, this.#body] = [hb, body];
    const free = new HeldBody(hb, body, ANCHORS, {});
    this.automatic = free.irbf.report().smoothness;
    free.dispose();
    this.smoothness = smoothness === 'auto' ? this.automatic : smoothness;
    this.held = new HeldBody(hb, body, ANCHORS, { smoothness: this.smoothness });
    this.held.pull(places);
    this.held.settle();
    const none = new Float64Array(EXPONENTS.length);
    this.curves = sweeps.get(body) ?? { places: [], jump: none, strain: none };
  }

  /** From far too small to far too large a λ, for the handles as they are. */
  sweep(places: readonly number[]): void {
    if (places === this.curves.places) return;
    const [jumps, strains] = [new Float64Array(EXPONENTS.length), new Float64Array(EXPONENTS.length)];
    EXPONENTS.forEach((exponent, i) => {
      const held = new HeldBody(this.#hb, this.#body, ANCHORS, { smoothness: 10 ** exponent });
      held.pull(places);
      held.settle();
      jumps[i] = jump(held);
      strains[i] = held.strain;
      held.dispose();
    });
    this.curves = { places, jump: jumps, strain: strains };
    sweeps.set(this.#body, this.curves);
  }

  dispose(): void {
    this.held.dispose();
  }
}

/** A function through values at the exponents, straight between them. */
const through = (values: Float64Array) => ({
  evaluate: (xs: Float64Array, out: Float64Array) => {
    for (let i = 0; i < xs.length; i++) {
      const at = Math.min(Math.max(2 * ((xs[i] ?? 0) + 9), 0), values.length - 1);
      const k = Math.min(Math.floor(at), values.length - 2);
      out[i] = (values[k] ?? 0) + (at - k) * ((values[k + 1] ?? 0) - (values[k] ?? 0));
    }
  },
});

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
  make: async (hb, state, work) =>
    new Made(hb, await baked('bar-7', () => box, { centers: 100, spheres: 7, resolution: 48 }, work), state),
  move: ({ held }, { places }) => {
    held.pull(places);
    return held.follow();
  },
  settle: (made, { places }) => made.sweep(places),
  panels: {
    bar: stagePlot<Made, State>({
      label: 'The bar and its spheres',
      view: () => ({ azimuth: 18, elevation: 20 }),
      draw: (stage, { held }, { places }, change) => {
        stage.surface(box, (surface) => {
          surface.positions.set(held.positions);
          surface.seeThrough(true);
        });
        stage.balls(held.ends);
        const handle = (at: [number, number, number], i: number) => ({
          name: NAMES[i] ?? '',
          at,
          move: (...to: [number, number, number]) => change({ places: placed(places, i, to) }),
          reset: () => change({ places: placed(places, i, ANCHORS.slice(3 * i, 3 * i + 3)) }),
        });
        stage.handles(rows(places).map(handle));
      },
    }),
    balance: linePlot<Made, State>({
      label: 'Plot over the logarithm of λ',
      frame: [-9, 0, 0, 3],
      draw: (plot, { curves, smoothness, automatic }, _, change) => {
        plot.curve('Jump', through(curves.jump), { detail: 'stretch near the farthest sphere' });
        plot.curve('Misfit', through(curves.strain), { detail: 'strain of the spheres', dashed: true });
        plot.rule(Math.log10(automatic), 'automatic λ');
        plot.handles([
          {
            name: `λ, 10 to the power ${Math.log10(smoothness).toFixed(1)}`,
            at: [Math.log10(smoothness), 0],
            move: (x) => change({ smoothness: Number((10 ** Math.min(Math.max(x, -9), 0)).toPrecision(2)) }),
          },
        ]);
      },
    }),
  },
  told: ({ held, smoothness, automatic }) => [
    ['jump near the farthest sphere', jump(held)],
    ['misfit of the spheres', held.strain],
    ['λ', smoothness],
    ['automatic λ', automatic],
    ['volume, of that at rest', held.irbf.report().volumeRatio],
  ],
});
