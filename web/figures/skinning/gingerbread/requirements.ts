import type { WeightMeasures } from '../../../../wasm/ts/index.ts';
import { WEIGHT_REQUIREMENTS } from '../../../../wasm/ts/weight-requirements.ts';
import { button, h } from '../../../ui/dom.ts';
import type { Panel } from '../../kit/figure.ts';
import { Leisure } from '../../kit/leisure.ts';
import { type Handle, restsOf } from '../../kit/plane-handles.ts';
import { type WeightsKind, weightHandle } from '../../kit/plane-weights.ts';
import type { Bent, State } from './bent.ts';
import { METHODS, type Method, methodOf, WEIGHTS_KINDS } from './methods.ts';

/** What the lecture asks of weights: the measure that decides on it, and that in words. */
const REQUIREMENTS: readonly (readonly [
  name: string,
  said: string,
  holds: keyof WeightMeasures['holds'],
  text: (measures: WeightMeasures) => string,
])[] = [
  [
    'Smooth',
    `the largest jump of the gradient between triangles, as a part of the largest gradient; at most ${WEIGHT_REQUIREMENTS.smooth}.`,
    'smooth',
    ({ gradientJump }) => gradientJump.toFixed(2),
  ],
  [
    'Local',
    `the largest weight where another handle is twice as near; at most ${WEIGHT_REQUIREMENTS.local}.`,
    'local',
    ({ farWeight }) => farWeight.toFixed(2),
  ],
  [
    'Shape-aware',
    `the largest weight of a handle that is near through the air only; at most ${WEIGHT_REQUIREMENTS.shapeAware}.`,
    'shapeAware',
    // A shape may have no place to measure it.
    ({ leakedWeight }) => (Number.isNaN(leakedWeight) ? '' : leakedWeight.toFixed(2)),
  ],
  ['Sums to 1', 'the largest difference of the sum from 1.', 'sumsToOne', ({ sumError }) => small(sumError)],
  [
    'Bounded',
    'the farthest that a weight leaves 0 to 1.',
    'bounded',
    ({ least, largest }) => {
      const beyond = Math.max(-least, largest - 1, 0);
      return beyond < 5e-4 ? small(beyond) : beyond.toFixed(2);
    },
  ],
];

/** The lecture's requirements, each kind of weights measured against them on this shape with these handles. */
export const requirements: Panel<Bent, State> = {
  place: 'below',
  open: (kit) => {
    const choose = (kind: WeightsKind) => {
      const { family } = methodOf(kit.state.m) as Method;
      kit.change({ m: `${family === 'rigid' ? 'rigid' : 'linear'}-${kind}` });
    };
    const columns = WEIGHTS_KINDS.map((kind) => {
      const name = METHODS.find((method) => method.kind === kind)?.name ?? kind;
      // A place to break a long name.
      const words = name.replace(/^(Bi|Tri)/, '$1\u00ad');
      const head = h(
        'th',
        { scope: 'col' },
        button(words, () => choose(kind), 'requirement-kind'),
      );
      return { kind, head, cells: REQUIREMENTS.map(() => h('td')) };
    });
    const rows = REQUIREMENTS.map(([name], i) =>
      h('tr', {}, h('th', { scope: 'row' }, name), ...columns.map(({ cells }) => cells[i] as HTMLElement)),
    );
    const element = h(
      'section',
      { 'aria-label': 'What weights should be', class: 'requirements stack' },
      h('h3', {}, 'What weights should be'),
      h('table', {}, h('thead', {}, h('tr', {}, h('td'), ...columns.map(({ head }) => head))), h('tbody', {}, ...rows)),
      h(
        'details',
        { class: 'soft' },
        h('summary', {}, 'What the numbers mean'),
        h('dl', {}, ...REQUIREMENTS.flatMap(([name, said]) => [h('dt', {}, name), h('dd', {}, said)])),
      ),
    );
    const leisure = new Leisure<(typeof columns)[number]>(element);
    /** The mesh and the handles at rest that were measured. */
    let [mesh, rests] = [undefined as unknown, ''];
    return {
      element,
      draw: (_, { m }) => {
        leisure.pause();
        const current = methodOf(m)?.kind;
        for (const { kind, head, cells } of columns)
          for (const cell of [head, ...cells]) cell.toggleAttribute('data-current', kind === current);
      },
      // With other handles or another mesh measures again, the slowest last.
      refine: (bent, state) => {
        const now = restsOf(bent.handles(state));
        const isSame = mesh === bent.mesh && rests === now;
        [mesh, rests] = [bent.mesh, now];
        const inOrder = [...columns].sort((a, b) => Number(a.kind === 'bounded') - Number(b.kind === 'bounded'));
        leisure.go(({ kind, cells }) => fill(cells, measured(bent, bent.handles(state), kind)), isSame ? undefined : inOrder);
      },
      dispose: () => leisure.pause(),
    };
  },
};

function measured({ deformer }: Bent, handles: readonly Handle[], kind: WeightsKind): WeightMeasures | undefined {
  if (!deformer || handles.length === 0) return undefined;
  try {
    const { hb, mesh } = deformer;
    return hb.measureWeights({ ...mesh, dimension: 2 }, handles.map(weightHandle), deformer.weights(kind).weights);
  } catch {
    // The method itself says why when it is chosen.
    return undefined;
  }
}

function fill(cells: readonly HTMLElement[], measures: WeightMeasures | undefined): void {
  REQUIREMENTS.forEach(([, , name, textOf], i) => {
    const [text, holds] = [measures && textOf(measures), measures?.holds[name] === true];
    const mark = h('span', { class: 'mark', 'aria-hidden': 'true' }, holds ? '✓' : '✗');
    const word = h('span', { class: 'unseen' }, holds ? 'holds, ' : 'broken, ');
    cells[i]?.replaceChildren(...(text ? [mark, word, text] : ['–']));
    cells[i]?.toggleAttribute('data-broken', !!text && !holds);
  });
}

/** 0, or a power of ten: digits say nothing where all is rounding. */
function small(value: number): string {
  return value === 0 ? '0' : value.toExponential(0).replace('e-', 'e−');
}
