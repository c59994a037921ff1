import type { Handlebody } from '../../../wasm/ts/index.ts';
import { countFlips } from '../../models/mesh-shape.ts';
import { lazy } from '../../ui/lazy.ts';
import { choice, type Parameter, range, toggle } from '../kit/channel.ts';
import { define, type PartControl, type Told, type Work } from '../kit/figure.ts';
import { ownShape } from '../kit/own-shape.ts';
import { describe, struck } from '../kit/plane-handles.ts';
import { shapePlot } from '../kit/shape-plot.ts';
import { Bent, parameters, type State, VERTICES } from './gingerbread/bent.ts';
import { handlePanel } from './gingerbread/handle-panel.ts';
import type { DistanceKind, Family, Method, MethodId } from './gingerbread/methods.ts';
import { FAMILIES, METHODS, methodOf, saidOf, weightsOf } from './gingerbread/methods.ts';
import { requirements } from './gingerbread/requirements.ts';
import { SHAPES } from './gingerbread/shapes.ts';
import { strip } from './gingerbread/strip.ts';

const slabPart = lazy(() => import('./gingerbread/interior.ts'), 'The part of this page that measures distances');

/** A shape of one's own comes with handles of its own. */
const { h, v, pick, show } = parameters;
const asBefore = { h: h.initial, v: v.initial, pick: pick.initial, show: show.initial };

const open = { open: true };
const methodFor = ({ m }: State) => methodOf(m) as Method;
const shapes = choice('Shape', [...SHAPES.map(({ id, short }) => [id, short] as const), ['own', 'Your own'] as const], open);
const families = choice(
  'Method',
  FAMILIES.map(({ id, name, said }) => [id, name, said] as const),
  open,
);
const kinds = Object.fromEntries(
  FAMILIES.map(({ id }) => {
    const of = METHODS.filter(({ family }) => family === id);
    return [id, choice('Kind', of.map((method) => [method.id, method.name, saidOf(method)] as const), open)]; // biome-ignore format: one list
  }),
);
const vertices = range('Vertices, about', { from: VERTICES.low, to: VERTICES.high, value: VERTICES.initial, step: 50 });
const [weight, triangles] = [toggle('Weight of the picked handle'), toggle('Triangles')];

/** What was chosen of each family last. */
const last = new Map<Family, MethodId>();

/** To another family, with the same kind of weights where it has them. */
function methodIn(family: Family, { m }: State): MethodId {
  const now = methodOf(m) as Method;
  last.set(now.family, m);
  const of = METHODS.filter((method) => method.family === family);
  return of.find(({ kind }) => kind === now.kind)?.id ?? last.get(family) ?? (of[0] as Method).id;
}

const parts: readonly PartControl<State>[] = [
  {
    parameter: () => shapes,
    read: ({ shape, o, draw }) => (draw || o ? 'own' : shape),
    write: (_, value: string) => (value === 'own' ? { draw: true } : value),
  },
  {
    parameter: () => families,
    read: (state) => methodFor(state).family,
    write: (state, family: Family) => ({ m: methodIn(family, state) }),
  },
  { parameter: (state) => kinds[methodFor(state).family] as Parameter, read: ({ m }) => m, write: (_, m: MethodId) => ({ m }) },
  {
    parameter: () => weight,
    when: (state) => weightsOf(methodFor(state)) !== undefined,
    read: ({ show }) => show.weight,
    write: ({ show, pick }, value: boolean) => ({ show: { ...show, weight: value }, pick: value ? Math.max(pick, 0) : pick }),
  },
  {
    parameter: () => triangles,
    read: ({ show }) => show.mesh,
    write: ({ show }, value: boolean) => ({ show: { ...show, mesh: value } }),
  },
  { parameter: () => vertices, read: ({ v }) => v, write: (_, v: number) => ({ v }) },
];

/** Measures distances on another thread, for interior radial basis functions. */
async function withSlab(hb: Handlebody, bent: Bent, kind: DistanceKind, work: Work, before?: Bent): Promise<Bent> {
  work.progress(0, kind === 'interior' ? 'Measuring distances through the inside…' : 'Measuring distances…');
  try {
    const { bakeSlab } = await slabPart(work.address);
    const listener = { signal: work.signal, onProgress: work.progress, onFallback: work.alone };
    bent.start(hb).setSlab(kind, await bakeSlab(hb, bent.mesh, kind, listener));
    return bent;
  } catch (error) {
    if (bent !== before) bent.dispose();
    throw error;
  }
}

function islands({ deformer }: Bent, method: Method): readonly Told[] {
  const kind = weightsOf(method);
  const found = kind && deformer?.isReady(method) ? deformer.weights(kind).islands : [];
  return found.map(({ count, first, handle }) => [
    'without a handle',
    `A piece of ${count} vertices (${first} is its first) holds no handle: all of it follows handle ${handle}, the nearest.`,
  ]);
}

export default define<typeof parameters, Bent>({
  id: 'gingerbread',
  title: 'Bend a gingerbread man',
  titleOf: ({ o }) => o && 'Your own shape',
  parameters,
  parts,
  former: { shape: 'from' },
  presets: SHAPES.flatMap(({ id: shape, name: title, poses }) =>
    poses.map(({ id, name, look = '', handles, method }, i) => {
      const h = i === 0 ? 'auto' : handles();
      if (h !== 'auto') struck.add(h);
      return { id, name, title, look, state: { shape, h, ...(method && { m: method }) } };
    }),
  ),
  kept: ['m'],
  moving: ['h'],
  shown: ['pick', 'show', 'draw'],
  whole: true,
  sketch: (state) => new Bent(state),
  make: (hb, state, work, before) => {
    const bent = before?.isOf(state) ? before : new Bent(state, before);
    const { family, kind } = methodFor(state);
    const solver = hb as Handlebody;
    if (family !== 'irbf' || bent.start(solver).hasSlab(kind as DistanceKind)) {
      bent.start(solver);
      return bent;
    }
    return withSlab(solver, bent, kind as DistanceKind, work, before);
  },
  move: (bent, state, wait) => bent.move(state, wait),
  panels: {
    shape: shapePlot<Bent, State>({
      label: 'The shape, deformed by its handles',
      draw: (bent, state, change) => {
        const handles = bent.handles(state);
        return {
          ...bent,
          handles,
          picked: state.pick,
          weights: state.show.weight ? bent.weights(state) : undefined,
          lines: state.show.mesh,
          change: (h, pick) => change(h === handles ? { pick } : { h, pick }),
        };
      },
    }),
    own: ownShape<Bent, State>((o, painted) => ({ o, painted, ...asBefore })),
    strip,
    requirements,
    handle: handlePanel,
  },
  told: (bent, state) => {
    const { positions, smallestAngle, triangles: corners } = bent.mesh;
    const method = methodFor(state);
    const held = bent.handles(state)[state.pick];
    return [
      ['method', method.title],
      ['vertices', (positions.length / 2).toLocaleString('en')],
      ['triangles', (corners.length / 3).toLocaleString('en')],
      ['smallest angle', `${smallestAngle.toFixed(1)}°`],
      ['triangles turned over', countFlips(bent.positions, corners)],
      ...(bent.handles(state).length > 0 ? islands(bent, method) : []),
      ...(held ? [['picked', describe(held, state.pick)] as const] : []),
    ];
  },
});
