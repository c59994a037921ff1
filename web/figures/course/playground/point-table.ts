import { h } from '../../ui/dom.ts';
import { focusNeighbor } from '../../ui/focus.ts';
import { type Experiment, MOST_POINTS, placeOf } from './experiment.ts';

interface TableActions {
  /** Column of a point: a coordinate, or the value behind them. */
  type(i: number, column: number, number: number): void;
  pick(i: number): void;
  remove(i: number): void;
  add(): void;
}

/** The points as numbers that can be typed: what can be dragged can be written. */
export class PointTable {
  readonly element: HTMLElement;
  readonly #body = h('tbody');
  readonly #head = h('tr');
  readonly #actions: TableActions;
  readonly #add: HTMLButtonElement;
  #columns = 0;
  #shown: number[][] = [];

  constructor(actions: TableActions) {
    this.#actions = actions;
    this.#add = h('button', { type: 'button', class: 'button', onclick: () => actions.add() }, 'Add a point');
    this.element = h(
      'details',
      { class: 'points-part' },
      h('summary', {}, h('h2', {}, 'Points as numbers')),
      h('table', { class: 'points-table' }, h('thead', {}, this.#head), this.#body),
      this.#add,
    );
    this.element.addEventListener('toggle', () => this.#last && this.update(this.#last));
  }

  #last: Experiment | undefined;

  update(experiment: Experiment): void {
    this.#last = experiment;
    if (!(this.element as HTMLDetailsElement).open) return;
    const { dimension, values, points, picked } = experiment;
    if (this.#columns !== dimension + 1) this.#setColumns(dimension + 1);
    while (this.#body.childElementCount > values.length) {
      this.#body.lastElementChild?.remove();
      this.#shown.pop();
    }
    while (this.#body.childElementCount < values.length) this.#body.append(this.#row(this.#body.childElementCount));
    const span = experiment.frame[1] - experiment.frame[0];
    for (let i = 0; i < values.length; i++) {
      const row = this.#body.children[i] as HTMLElement;
      row.toggleAttribute('data-picked', i === picked);
      const numbers = dimension === 1 ? placeOf(experiment, i) : [...placeOf(experiment, i), values[i] as number];
      const inputs = row.querySelectorAll('input');
      numbers.forEach((number, column) => {
        const input = inputs[column] as HTMLInputElement;
        if (this.#shown[i]?.[column] === number || input === document.activeElement) return;
        (this.#shown[i] as number[])[column] = number;
        input.value = String(Number(number.toPrecision(6)));
        input.step = String(10 ** Math.floor(Math.log10(span / 100)));
      });
      (row.querySelector('button') as HTMLButtonElement).disabled = values.length === 1;
    }
    this.#add.disabled = points.length / dimension >= MOST_POINTS;
  }

  #setColumns(columns: number): void {
    this.#columns = columns;
    this.#shown = [];
    this.#body.replaceChildren();
    const names = columns === 2 ? ['x', 'value'] : ['x', 'y', 'value'];
    this.#head.replaceChildren(
      ...['point', ...names].map((name) => h('th', { scope: 'col' }, name)),
      h('td', {}, h('span', { class: 'unseen' }, 'Remove')),
    );
  }

  #row(i: number): HTMLElement {
    this.#shown[i] = [];
    const names = this.#columns === 2 ? ['x', 'value'] : ['x', 'y', 'value'];
    const cells = names.map((name, column) => {
      const input = h('input', {
        type: 'number',
        'aria-label': `${name} of point ${i}`,
        onfocus: () => this.#actions.pick(i),
        onblur: () => this.#last && this.update(this.#last),
        onchange: () => {
          if (!Number.isFinite(input.valueAsNumber)) return;
          this.#shown[i] = [];
          this.#actions.type(i, column, input.valueAsNumber);
        },
      });
      return h('td', {}, input);
    });
    const act = () => {
      this.#actions.remove(i);
      if (this.#last) this.update(this.#last);
      focusNeighbor(this.#body.querySelectorAll('button'), i, this.#add);
    };
    const remove = h('button', { type: 'button', class: 'tool-button', 'aria-label': `Remove point ${i}`, onclick: act }, '×');
    return h('tr', {}, h('th', { scope: 'row' }, String(i)), ...cells, h('td', {}, remove));
  }
}
