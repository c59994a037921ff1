import { h } from '../../ui/dom.ts';
import type { Lesson } from './lesson.ts';
import { METHODS, WEIGHTS_KINDS, type WeightsKind } from './methods.ts';
import { type Measure, measureWeights, REQUIREMENTS } from './solver.ts';

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
        names.get(kind) ?? kind,
      );
      this.#heads.set(kind, h('th', { scope: 'row' }, button));
      this.#cells.set(
        kind,
        REQUIREMENTS.map(() => h('td')),
      );
    }
    const rows = WEIGHTS_KINDS.map((kind) =>
      h('tr', {}, this.#heads.get(kind) as HTMLElement, ...(this.#cells.get(kind) as HTMLElement[])),
    );
    this.element = h(
      'section',
      { 'aria-labelledby': 'requirements-title', class: 'requirements' },
      h('h2', { id: 'requirements-title' }, 'What weights should be'),
      h(
        'table',
        {},
        h(
          'thead',
          {},
          h('tr', {}, h('td', {}, ''), ...REQUIREMENTS.map(({ name, said }) => h('th', { scope: 'col', title: said }, name))),
        ),
        h('tbody', {}, ...rows),
      ),
      h('p', { class: 'soft small' }, REQUIREMENTS.map(({ name, said }) => `${name}: ${said}`).join(' ')),
    );
  }

  /** Marks the weights in use. */
  update(): void {
    for (const [kind, head] of this.#heads) head.parentElement?.toggleAttribute('data-current', kind === this.#lesson.method.kind);
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
              h('span', { class: 'mark', 'aria-hidden': 'true' }, measure.met ? '✓' : '✗'),
              h('span', { class: 'unseen' }, measure.met ? 'met, ' : 'broken, '),
              measure.text,
            ]
          : ['–']),
      );
      cell.toggleAttribute('data-broken', measure?.met === false);
    });
    this.element.toggleAttribute('data-done', this.#queue.length === 0);
    this.resume();
  }
}
