import { h } from '../../ui/dom.ts';
import type { Lesson } from './lesson.ts';
import { METHODS, WEIGHTS_KINDS, type WeightsKind } from './methods.ts';
import { type Measure, measureWeights, REQUIREMENTS } from './solver.ts';

/** A place to break a long name. */
const hyphened = (name: string) => name.replace(/^(Bi|Tri)/, '$1\u00ad');

/** The lecture's requirements, each kind of weights measured against them on this shape with these handles. */
export class Requirements {
  readonly element: HTMLElement;
  readonly #lesson: Lesson;
  readonly #heads = new Map<WeightsKind, HTMLElement>();
  readonly #cells = new Map<WeightsKind, HTMLElement[]>();
  #queue: WeightsKind[] = [];
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(lesson: Lesson, choose: (kind: WeightsKind) => void) {
    this.#lesson = lesson;
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
      h('h2', { id: 'requirements-title' }, 'What weights should be'),
      h(
        'table',
        {},
        h('thead', {}, h('tr', {}, h('td'), ...WEIGHTS_KINDS.map((kind) => this.#heads.get(kind) as HTMLElement))),
        h('tbody', {}, ...rows),
      ),
      h(
        'details',
        { class: 'soft small' },
        h('summary', {}, 'What the numbers mean'),
        h('dl', {}, ...REQUIREMENTS.flatMap(({ name, said }) => [h('dt', {}, name), h('dd', {}, said)])),
      ),
    );
  }

  /** Marks the weights in use. */
  update(): void {
    for (const [kind, head] of this.#heads) {
      const current = kind === this.#lesson.method.kind;
      for (const cell of [head, ...(this.#cells.get(kind) ?? [])]) cell.toggleAttribute('data-current', current);
    }
  }

  /** Other handles or another mesh: measures again while nothing else happens, the slowest last. */
  refresh(): void {
    this.#queue = [...WEIGHTS_KINDS].sort((a, b) => Number(a === 'bounded') - Number(b === 'bounded'));
    this.element.toggleAttribute('data-done', false);
    this.resume();
  }

  pause(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }

  resume(): void {
    if (this.#queue.length > 0) this.#timer ??= setTimeout(() => this.#next(), 60);
  }

  #next(): void {
    this.#timer = undefined;
    const kind = this.#queue.shift();
    const { deformer, handles } = this.#lesson;
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
    this.resume();
  }
}
