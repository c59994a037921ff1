import type { Handlebody } from '../../../wasm/ts/index.ts';
import { bar, gingerbreadMan, octopus, ring } from '../../models/outlines.ts';
import type { Shape } from '../../models/shape.ts';
import { choice, type StateOf, unsaid, word } from '../kit/channel.ts';
import { define, type PartControl } from '../kit/figure.ts';
import { outline } from '../kit/outline.ts';
import { ownShape } from '../kit/own-shape.ts';
import { bone, pickedHandle, planeHandles, point } from '../kit/plane-handles.ts';
import { shapePlot } from '../kit/shape-plot.ts';
import { WeighedShape } from '../kit/weighed-shape.ts';

const OUTLINES = { man: once(gingerbreadMan), bar: once(bar), ring: once(ring), octopus: once(octopus) };

/** Traced when it is first asked for, and the same one from then on. */
function once(trace: () => Shape): () => Shape {
  let traced: Shape | undefined;
  return () => {
    traced ??= trace();
    return traced;
  };
}

const parameters = {
  o: outline,
  shape: word(['man', 'bar', 'ring', 'octopus']),
  kind: choice('Weights', { biharmonic: 'Biharmonic', harmonic: 'Harmonic', triharmonic: 'Triharmonic', bounded: 'Bounded' }),
  h: planeHandles('auto'),
  pick: pickedHandle(0),
  draw: unsaid(false),
};
type State = StateOf<typeof parameters>;

const shapes = choice('Outline', { man: 'Man', bar: 'Bar', ring: 'Ring', octopus: 'Octopus', own: 'Your own' }, { open: true });
const parts: readonly PartControl<State>[] = [
  {
    parameter: () => shapes,
    read: ({ shape, o, draw }) => (draw || o ? 'own' : shape),
    write: (_, value: State['shape'] | 'own') =>
      value === 'own' ? { draw: true } : { shape: value, o: undefined, h: 'auto', pick: 0, draw: false },
  },
];

export default define<typeof parameters, WeighedShape>({
  id: 'skinning-1',
  title: 'Handles and their weights',
  parameters,
  parts,
  presets: [
    {
      id: 'points',
      name: 'Points',
      look: 'The color is the weight of the picked handle: 1 there, 0 at the others, smooth between them.',
      attempt: 'Drag a handle, or add one: every weight makes room for it.',
      state: {
        h: [point(0, 0.62), point(-0.72, 0.16), point(0.72, 0.16), point(-0.36, -0.82), point(0.36, -0.82), point(0, -0.1)],
        pick: 2,
      },
    },
    {
      id: 'bones',
      name: 'Bones',
      look: 'The weight of a bone is 1 all along it.',
      attempt: 'Drag one end of a bone, then the other.',
      state: { shape: 'bar', h: [bone([-1, 0], [-0.35, 0]), bone([0.35, 0], [1, 0])], pick: 0 },
    },
    {
      id: 'around',
      name: 'Around a hole',
      look: 'A weight goes around the hole by both sides: near is what is near inside the shape.',
      attempt: 'Drag the handle at the top into the hole: what is outside cannot be held.',
      state: { shape: 'ring', h: [point(0, 0.73), point(-0.73, 0), point(0.73, 0), point(0, -0.73)], pick: 0 },
    },
  ],
  shown: ['pick', 'draw'],
  whole: true,
  make: (hb, { o, shape, h, kind }, work, last) =>
    WeighedShape.make(hb as Handlebody, { outline: o ?? OUTLINES[shape](), vertices: 1200, handles: h, kind }, work, last),
  panels: {
    shape: shapePlot<WeighedShape, State>({
      label: 'The shape, colored by the weight of the picked handle',
      draw: ({ outline, mesh, handles, weights }, { pick }, change) => ({
        ...{ outline, mesh, handles, weights, shown: handles, picked: pick, positions: mesh.positions, places: true },
        change: (h, picked) => change(h === handles ? { pick: picked } : { h, pick: picked }),
      }),
    }),
    own: ownShape<WeighedShape, State>((o) => ({ o, h: 'auto', pick: 0 })),
  },
  told: ({ mesh, handles, measures }, { pick }) => [
    ['vertices', mesh.positions.length / 2],
    ['handles', handles.length],
    ['least weight', measures?.least ?? 0],
    ['largest weight', measures?.largest ?? 0],
    ['sums to 1, but for', measures?.sumError ?? 0],
    ['part that the picked handle moves', measures?.support[pick] ?? 0],
  ],
});
