import type { DualQuaternion, LinearBlend } from '../../../wasm/ts/runtime.ts';
import { notFetched } from '../../ui/lazy.ts';
import type { SolidWeights, WeightsQuestion } from '../../worker/weigh.ts';
import { weighInWorker } from '../../worker/weigh-in-worker.ts';
import type { Channel } from '../kit/channel.ts';
import { choice, range, type StateOf, toggle, word } from '../kit/channel.ts';
import { define, type PartControl, type Work } from '../kit/figure.ts';
import { diagonalOf, volumeOf } from '../kit/mesh-measures.ts';
import { WEIGHTS_ORDERS } from '../kit/plane-weights.ts';
import { stagePlot } from '../kit/stage-plot.ts';
import { brief } from '../kit/words.ts';
import { type Pose, poseOf, posesOf, writeTransform } from './solid/pose.ts';
import { HANDLES, type Solid, type SolidName, solidOf } from './solid/solids.ts';

const handle: Channel<number> = {
  initial: 1,
  read: (text) => (/^[0-5]$/.test(text) ? Number(text) : undefined),
  write: String,
};
const parameters = {
  solid: word<SolidName>(['bar', 'dog']),
  method: choice(
    'Weights',
    [
      ['biharmonic', 'Biharmonic', 'Least ∫(Δw)²: smooth, out of bounds in places.'],
      ['harmonic', 'Harmonic', 'Least ∫|∇w|²: within 0 and 1, with spikes at points.'],
      ['bounded', 'Bounded', 'Least ∫(Δw)² among weights from 0 to 1, of all handles together.'],
      ['triharmonic', 'Triharmonic', 'Least ∫|∇Δw|²: smoother, farther out of bounds.'],
    ],
    { open: true },
  ),
  blend: choice(
    'Blending',
    [
      ['linear', 'Linear'],
      ['rigid', 'Rigid (dual quaternions)'],
    ],
    { open: true },
  ),
  colored: toggle('Color by the weight of the handle', true),
  handle,
  poses: posesOf(6),
};
type State = StateOf<typeof parameters>;

/** The dog has more handles than the bar. */
const heldBy = (state: State) => Math.min(state.handle, HANDLES[state.solid].length - 1);

const solids = choice('Solid', { bar: 'Bar', dog: 'Dog' }, { open: true });
const handles = Object.fromEntries(
  Object.entries(HANDLES).map(([name, words]) => [name, choice('Handle', Object.fromEntries(words.entries()), { open: true })]),
);

const parts: readonly PartControl<State>[] = [
  {
    parameter: () => solids,
    read: (state) => state.solid,
    write: (_, value: SolidName) => ({ solid: value, handle: value === 'bar' ? 1 : 0, poses: {} }),
  },
  {
    parameter: (state) => handles[state.solid] ?? solids,
    read: (state) => String(heldBy(state)),
    write: (_, value) => ({ handle: Number(value) }),
  },
  ...['Turn x', 'Turn y', 'Turn z', 'Move x', 'Move y', 'Move z'].map((label, axis): PartControl<State> => {
    const [most, step] = axis < 3 ? [180, 1] : [0.5, 0.005];
    const slider = range(label, { from: -most, to: most, value: 0, step });
    return {
      parameter: () => slider,
      read: (state) => poseOf(state.poses, heldBy(state))[axis],
      write: (state, value) => {
        const held = heldBy(state);
        return { poses: { ...state.poses, [held]: poseOf(state.poses, held).with(axis, value) as unknown as Pose } };
      },
    };
  }),
];

/** Weights from another thread; it says so where none may start, and where its script does not come. */
function weighed(question: WeightsQuestion, work: Work): Promise<SolidWeights> {
  work.progress(undefined, 'Computing weights…');
  const onFallback = (reason: unknown) => {
    if (reason instanceof Event) throw reason;
    work.alone();
  };
  return weighInWorker(question, { signal: work.signal, onProgress: work.progress, onFallback }).catch(async (error) => {
    throw error instanceof Event ? await notFetched('The part of this page that computes weights') : error;
  });
}

interface Made {
  readonly shape: Solid;
  readonly diagonal: number;
  readonly volume: number;
  /** As they are now. */
  readonly positions: Float32Array;
  readonly weights?: SolidWeights;
  readonly skins?: Readonly<Record<'linear' | 'rigid', LinearBlend | DualQuaternion>>;
  dispose?(): void;
}

export default define<typeof parameters, Made>({
  id: 'solid',
  title: 'Weights of a solid',
  parameters,
  parts,
  former: { solid: 'from', m: 'method' },
  presets: [
    {
      id: 'bar',
      name: 'Bar',
      look: 'Each handle has a weight everywhere in the solid: 1 at the handle, 0 at the others, as smooth as can be in between. The colors show it, with a line for each tenth.',
      attempt: 'Choose a handle to see its weight; turn it and compare how the two ways of blending follow.',
      state: {},
    },
    {
      id: 'twist',
      name: 'Twist by 180°',
      look: 'Linear blending averages matrices: halfway between a turn and none is no turn but a collapse, the candy wrapper.',
      attempt: 'Blend rigidly: motions are averaged, and the thickness is kept.',
      state: { poses: { 1: [180, 0, 0, 0, 0, 0] } },
    },
    {
      id: 'dog',
      name: 'Dog',
      look: 'The solid is filled with tetrahedra, made from voxels; the surface takes its weights from there.',
      attempt: 'Choose a paw, and turn it.',
      state: { solid: 'dog', handle: 0 },
    },
    {
      id: 'paw',
      name: 'Lift the paw',
      look: 'One paw lifted forward: the weights say who follows.',
      state: { solid: 'dog', handle: 0, poses: { 0: [0, 0, 60, 0.12, 0.12, 0] } },
    },
  ],
  moving: ['poses', 'blend'],
  shown: ['handle', 'colored'],
  make: async (hb, { solid: name, method }, work) => {
    work.progress(undefined, 'Getting the solid…');
    const shape = await solidOf(name);
    work.signal.throwIfAborted();
    const { positions, triangles } = shape;
    const rest = { shape, diagonal: diagonalOf(positions), volume: volumeOf(positions, triangles), positions: positions.slice() };
    work.preview(rest);
    const question = { surface: shape, handles: shape.handles.map(({ holds }) => holds), resolution: shape.resolution };
    const weights = await weighed({ ...question, order: WEIGHTS_ORDERS[method], bounded: method === 'bounded' }, work);
    const options = { positions, weights: weights.weights };
    const skins = { linear: hb.linearBlend(options), rigid: hb.dualQuaternion(options) };
    return {
      ...rest,
      weights,
      skins,
      dispose: () => {
        skins.linear.dispose();
        skins.rigid.dispose();
      },
    };
  },
  move: ({ shape, diagonal, positions, skins }, { blend, poses }) => {
    const skin = skins?.[blend];
    if (!skin) return;
    shape.handles.forEach(({ center }, j) => {
      writeTransform(poseOf(poses, j), center, diagonal, skin.transforms, 12 * j);
    });
    skin.deform(positions);
  },
  panels: {
    solid: stagePlot<Made, State>({
      label: 'The solid',
      legend: 'Weight of the handle',
      view: ({ solid: name }) => (name === 'bar' ? { azimuth: 22, elevation: 24 } : { azimuth: 58, elevation: 14 }),
      draw: (stage, { shape, positions, weights }, state) => {
        stage.surface(shape, (surface) => {
          surface.positions.set(positions);
          surface.color(state.colored ? weights?.weights : undefined, shape.handles.length, heldBy(state));
        });
      },
    }),
  },
  told: ({ shape, positions, volume, weights }) => {
    if (!weights) return [];
    const { least, largest, sumError, holds, gradientJump } = weights.measures;
    return [
      ['volume, of that at rest', volumeOf(positions, shape.triangles) / volume],
      ['least weight', least],
      ['largest weight', largest],
      ['sum of weights, off 1 by', sumError],
      ['smooth', holds.smooth ? 'yes' : `no: slopes jump by ${brief(100 * gradientJump)} %`],
      ['tetrahedra', weights.tetrahedra],
      ['vertices of the tetrahedra', weights.vertices],
      ['vertices of the surface', shape.positions.length / 3],
    ];
  },
});
