import { computable } from '../../../ui/address.ts';
import { button, h, match } from '../../../ui/dom.ts';
import { focusNeighbor } from '../../../ui/focus.ts';
import type { Kit, OpenPanel } from '../../kit/figure.ts';
import type { PointEditing } from '../../kit/point-actions.ts';
import { MOST_POINTS, placeOf } from '../../kit/point-set.ts';
import type { State } from './channels.ts';

/** The points as numbers that can be typed: what can be dragged can be written. */
export class PointTable implements OpenPanel<unknown, State> {
  readonly element: HTMLElement;
  readonly #body = h('tbody');
  readonly #head = h('tr');
  readonly #kit: Kit<State>;
  readonly #actions: PointEditing;
  readonly #add: HTMLButtonElement;
  #names: readonly string[] = [];

  /** `add` adds a point where there are fewest. */
  constructor(kit: Kit<State>, actions: PointEditing, add: () => void) {
    [this.#kit, this.#actions] = [kit, actions];
    this.#add = button('Add a point', add, 'button');
    this.element = h(
      'details',
      { class: 'points-part stack' },
      h('summary', {}, h('h3', {}, 'Points as numbers')),
      h('table', { class: 'points-table' }, h('thead', {}, this.#head), this.#body),
      this.#add,
    );
    this.element.addEventListener('toggle', () => this.#update());
  }

  draw(): void {
    this.#update();
  }

  #update(): void {
    if (!(this.element as HTMLDetailsElement).open) return;
    const { p, pick, in: frame } = this.#kit.state;
    const { dimension, values } = p;
    if (this.#names.length !== dimension + 1) this.#setColumns(dimension === 1 ? ['x', 'value'] : ['x', 'y', 'value']);
    match(this.#body, values.length, (i) => this.#row(i));
    const step = String(10 ** Math.floor(Math.log10((frame[1] - frame[0]) / 100)));
    values.forEach((value, i) => {
      const row = this.#body.children[i] as HTMLElement;
      row.toggleAttribute('data-picked', i === pick);
      const numbers = [...p.places.slice(i * dimension, (i + 1) * dimension), value];
      row.querySelectorAll('input').forEach((input, column) => {
        const text = String(Number((numbers[column] ?? 0).toPrecision(6)));
        if (input === document.activeElement || (input.value === text && input.step === step)) return;
        [input.value, input.step] = [text, step];
      });
      (row.querySelector('button') as HTMLButtonElement).disabled = values.length === 1;
    });
    this.#add.disabled = values.length >= MOST_POINTS;
  }

  #setColumns(names: readonly string[]): void {
    this.#names = names;
    this.#body.replaceChildren();
    this.#head.replaceChildren(
      ...['point', ...names].map((name) => h('th', { scope: 'col' }, name)),
      h('td', {}, h('span', { class: 'unseen' }, 'Remove')),
    );
  }

  #row(i: number): HTMLElement {
    const cells = this.#names.map((name, column) => {
      const input = h('input', {
        type: 'number',
        'aria-label': `${name} of point ${i}`,
        onfocus: () => this.#actions.pick(i),
        onblur: () => this.#update(),
        onchange: () => Number.isFinite(input.valueAsNumber) && this.#type(i, column, computable(input.valueAsNumber)),
      });
      return h('td', {}, input);
    });
    const act = () => {
      this.#actions.remove(i);
      this.#update();
      focusNeighbor(this.#body.querySelectorAll('button'), i, this.#add);
    };
    const remove = button('×', act, 'dismiss', { 'aria-label': `Remove point ${i}` });
    return h('tr', {}, h('th', { scope: 'row' }, String(i)), ...cells, h('td', {}, remove));
  }

  /** A number that somebody typed: taken as it is, and the frame makes room for it. */
  #type(i: number, column: number, number: number): void {
    const { p, in: frame, range, d } = this.#kit.state;
    const next =
      column === d ? { ...p, values: p.values.with(i, number) } : { ...p, places: p.places.with(i * d + column, number) };
    const [across, up] = placeOf(next, i);
    const [left, right, bottom, top] = frame;
    this.#kit.change({
      p: next,
      in: [Math.min(left, across), Math.max(right, across), Math.min(bottom, up), Math.max(top, up)],
      ...(d === 2 && { range: [Math.min(range[0], number), Math.max(range[1], number)] }),
    });
  }
}
