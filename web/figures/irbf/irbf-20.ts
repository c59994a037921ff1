import type { BodyData } from '../../../wasm/ts/types.ts';
import { baked } from '../kit/baked.ts';
import { boxSurface } from '../kit/box.ts';
import { range, type StateOf } from '../kit/channel.ts';
import { define } from '../kit/figure.ts';
import { HeldBody } from '../kit/held-body.ts';
import { BAR, ENERGY } from '../kit/paper-energy.ts';
import { inSpace, rows } from '../kit/space-points.ts';
import { stagePlot } from '../kit/stage-plot.ts';

const box = boxSurface([10, 2, 2], [40, 8, 8]);
const COUNTS = [50, 35, 20, 10] as const;
const ANCHORS = [-4.8, 0, 0, -4.8, 0.8, 0, -4.8, 0, 0.8, 4.8, 0, 0, 4.8, 0.8, 0];
const NAMES = ['Left end', 'Left end, above', 'Left end, in front', 'Right end', 'Right end, above'];
const BENT = [-4.8, 0, 0, -4.8, 0.8, 0, -4.8, 0, 0.8, 3, 3.6, 0, 2.4, 4, 0];

const parameters = {
  width: range('Width h, parts of the bar’s length', { from: 0.05, to: 1, value: 0.18, scale: 'log' }),
  smoothness: range('λ', { from: 1e-8, to: 1e-2, value: 1e-6, scale: 'log' }),
  places: inSpace(BENT),
};
type State = StateOf<typeof parameters>;

/** The mean distance of a center to the nearest other one. The bar is convex at rest, so distances inside it are straight. */
function spacingOf({ centers, mesh: { positions } }: BodyData): number {
  const points = rows([...centers].flatMap((v) => [...Array.from(positions).slice(3 * v, 3 * v + 3)]));
  const nearest = points.map((p) =>
    Math.min(...points.filter((q) => q !== p).map((q) => Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]))),
  );
  return nearest.reduce((sum, distance) => sum + distance, 0) / nearest.length;
}

interface One {
  readonly held: HeldBody;
  readonly body: BodyData;
}

interface Made {
  /** One for each number of centers. */
  readonly bars: readonly One[];
  dispose(): void;
}

const panelOf = (count: number, k: number) =>
  stagePlot<Made, State>({
    label: `The bar with ${count} centers`,
    title: `${count} centers`,
    view: () => ({ azimuth: 18, elevation: 20 }),
    draw: (stage, { bars }) => {
      const { held, body } = bars[k] as One;
      stage.surface(box, (surface) => surface.positions.set(held.positions));
      stage.dots(body.centers).points('places', NAMES, ANCHORS);
    },
  });

export default define({
  id: 'irbf-20',
  title: '50, 35, 20 and 10 centers',
  parameters,
  presets: [
    {
      id: 'fig-20',
      name: 'Bent',
      look: 'The same bar with fewer and fewer centers (dots), under the same width, λ and handles: fewer centers leave fewer ways to deform, so that the least energy grows.',
      attempt: 'Drag a handle in any of the four.',
      state: {},
    },
    {
      id: 'wide',
      name: 'A wide kernel',
      look: 'Wide kernels are alike: a few centers do nearly as well.',
      state: { width: 0.6, smoothness: 1e-8 },
    },
    { id: 'rest', name: 'At rest', look: 'Nothing is bent, whatever the number of centers.', state: { places: ANCHORS } },
  ],
  moving: ['places'],
  make: async (hb, { width, smoothness, places }, work): Promise<Made> => {
    const bars: One[] = [];
    for (const count of COUNTS) {
      const body = await baked(`bar-${count}-centers`, () => box, { ...BAR, centers: count, spheres: 30 }, work);
      work.signal.throwIfAborted();
      const held = new HeldBody(hb, body, ANCHORS, {
        ...ENERGY,
        smoothness,
        relativeWidth: (10 * width) / spacingOf(body),
      });
      held.pull(places);
      held.settle();
      bars.push({ held, body });
    }
    return {
      bars,
      dispose: () => {
        for (const { held } of bars) held.dispose();
      },
    };
  },
  move: ({ bars }, { places }) => {
    let moves = false;
    for (const { held } of bars) {
      held.pull(places);
      moves = held.follow() || moves;
    }
    return moves;
  },
  panels: { fifty: panelOf(50, 0), thirtyFive: panelOf(35, 1), twenty: panelOf(20, 2), ten: panelOf(10, 3) },
  told: ({ bars }) => bars.map(({ held }, k) => [`least energy, ${COUNTS[k]} centers`, held.settle().energy] as const),
});
