import { h } from '../../../ui/dom.ts';
import type { Kit, OpenPanel, Panel } from '../../kit/figure.ts';
import { restsOf } from '../../kit/plane-handles.ts';
import type { WeightsKind } from '../../kit/plane-weights.ts';
import type { Bent, State } from './bent.ts';
import { METHODS, type Method, methodOf, WEIGHTS_KINDS } from './methods.ts';
import { type Measure, measureWeights, REQUIREMENTS } from './solver.ts';

/** A place to break a long name. */
const hyphened = (name: string) => name.replace(/^(Bi|Tri)/, '$1\u00ad');

/** The lecture's requirements, each kind of weights measured against them on this shape with these handles. */
export const requirements: Panel<Bent, State> = { place: 'below', open: (kit) => new Requirements(kit) };

class Requirements implements OpenPanel<Bent, State> {
  readonly element: HTMLElement;
  readonly #heads = new Map<WeightsKind, HTMLElement>();
  readonly #cells = new Map<WeightsKind, HTMLElement[]>();
  #queue: WeightsKind[] = [];
  #timer: ReturnType<typeof setTimeout> | undefined;
  /** The mesh and the handles at rest that were measured. */
  #of: readonly [unknown, string] = [undefined, ''];

  constructor(kit: Kit<State>) {
    const choose = (kind: WeightsKind) => {
      const { family } = methodOf(kit.state.m) as Method;
      kit.change({ m: `${family === 'rigid' ? 'rigid' : 'linear'}-${kind}` });
    };
    const names = new Map(METHODS.map(({ kind, name }) => [kind, name]));
    for (const kind of WEIGHTS_KINDS) {
      const button = h(
        'button',
        { type: 'button', class: 'requirement-kind', onclick: () => choose(kind) },
        hyphened(names.get(kind) ?? kind),
      );
      this.#heads.set(kind, h('th', { scope: 'col' }, button));
      this.#cells.set(
        kind,
        REQUIREMENTS.map(() => h('td')),
      );
    }
    const rows = REQUIREMENTS.map(({ name }, i) =>
      h(
        'tr',
        {},
        h('th', { scope: 'row' }, name),
        ...WEIGHTS_KINDS.map((kind) => (this.#cells.get(kind) as HTMLElement[])[i] as HTMLElement),
      ),
    );
    this.element = h(
      'section',
      { 'aria-labelledby': 'requirements-title', class: 'requirements' },
      h('h3', { id: 'requirements-title' }, 'What weights should be'),
      h(
        'table',
        {},
        h('thead', {}, h('tr', {}, h('td'), ...WEIGHTS_KINDS.map((kind) => this.#heads.get(kind) as HTMLElement))),
        h('tbody', {}, ...rows),
      ),
      h(
        'details',
        { class: 'soft' },
        h('summary', {}, 'What the numbers mean'),
        h('dl', {}, ...REQUIREMENTS.flatMap(({ name, said }) => [h('dt', {}, name), h('dd', {}, said)])),
      ),
    );
  }

  /** Marks the weights in use. The rest has to wait while somebody does something. */
  draw(_: Bent, { m }: State): void {
    clearTimeout(this.#timer);
    for (const [kind, head] of this.#heads) {
      const current = kind === methodOf(m)?.kind;
      for (const cell of [head, ...(this.#cells.get(kind) ?? [])]) cell.toggleAttribute('data-current', current);
    }
  }

  /** With other handles or another mesh measures again, the slowest last. */
  refine(bent: Bent, state: State): void {
    const rests = restsOf(bent.handles(state));
    if (this.#of[0] !== bent.mesh || this.#of[1] !== rests) {
      this.#of = [bent.mesh, rests];
      this.#queue = [...WEIGHTS_KINDS].sort((a, b) => Number(a === 'bounded') - Number(b === 'bounded'));
      this.element.toggleAttribute('data-done', false);
    }
    this.#soon(bent, state);
  }

  dispose(): void {
    clearTimeout(this.#timer);
  }

  #soon(bent: Bent, state: State): void {
    clearTimeout(this.#timer);
    if (this.#queue.length > 0) this.#timer = setTimeout(() => this.#next(bent, state), 60);
  }

  #next(bent: Bent, state: State): void {
    const [kind, handles] = [this.#queue.shift(), bent.handles(state)];
    const { deformer } = bent;
    if (!kind || !deformer) return;
    let measures: readonly (Measure | undefined)[] = [];
    if (handles.length > 0) {
      try {
        measures = measureWeights(deformer.hb, deformer.mesh, handles, deformer.weights(kind).weights);
      } catch {
        // The method itself says why when it is chosen.
      }
    }
    this.#cells.get(kind)?.forEach((cell, i) => {
      const measure = measures[i];
      cell.replaceChildren(
        ...(measure
          ? [
              h('span', { class: 'mark', 'aria-hidden': 'true' }, measure.holds ? '✓' : '✗'),
              h('span', { class: 'unseen' }, measure.holds ? 'holds, ' : 'broken, '),
              measure.text,
            ]
          : ['–']),
      );
      cell.toggleAttribute('data-broken', measure?.holds === false);
    });
    this.element.toggleAttribute('data-done', this.#queue.length === 0);
    this.#soon(bent, state);
  }
}
