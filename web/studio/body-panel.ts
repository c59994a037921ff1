import { Vector3 } from 'three';
import type { Point } from '../three/live-body.ts';
import { button, h } from '../ui/dom.ts';
import { PARTS, type Part } from './address.ts';

/** What the panel steers. */
export interface Steerable {
  readonly points: readonly Point[];
  readonly selected: number;
  target(i: number): Vector3;
  select(i: number): void;
  moveTo(i: number, position: Vector3): void;
  resetHandle(i: number): void;
  remove(i: number): void;
  startPlacing(): void;
  /** How much of each part the body has. */
  readonly insides: Readonly<Record<Part, number>>;
  showInside(part: Part, shown: boolean): void;
  reset(): void;
}

/** The controls of a body: its handles, the chosen one's place in numbers, add, remove, reset. */
export class BodyPanel {
  readonly element: HTMLElement;
  readonly #scene: Steerable;
  readonly #list = h('div', { class: 'handle-list', role: 'group', 'aria-label': 'Handles' });
  readonly #inside: readonly HTMLButtonElement[];
  readonly #heading = h('h3', { id: 'chosen' });
  readonly #inputs: HTMLInputElement[];
  readonly #place: HTMLElement;
  readonly #back = button('Put back', () => this.#scene.resetHandle(this.#scene.selected), 'button');
  readonly #remove = button('Remove', () => this.#scene.remove(this.#scene.selected), 'button');
  readonly #digits: number;

  constructor(scene: Steerable, title: string, diagonal: number) {
    this.#scene = scene;
    this.#digits = Math.min(Math.max(3 - Math.floor(Math.log10(diagonal)), 0), 8);
    const step = 10 ** -(this.#digits - 1);
    this.#inputs = ['x', 'y', 'z'].map((axis) =>
      h('input', { type: 'number', step, 'aria-label': `${axis} of the chosen handle`, onchange: () => this.#typed() }),
    );
    this.#place = h(
      'section',
      { 'aria-labelledby': 'chosen', hidden: true },
      this.#heading,
      h(
        'div',
        { class: 'coordinates' },
        ...this.#inputs.map((input, i) =>
          h('label', {}, h('span', { 'aria-hidden': 'true' }, ['x', 'y', 'z'][i] as string), input),
        ),
      ),
      h('div', { class: 'buttons' }, this.#back, this.#remove),
    );
    this.#inside = PARTS.map((part) => insideButton(part, scene));
    this.element = h(
      'div',
      { class: 'panel-content' },
      h(
        'section',
        {},
        h('h2', {}, title),
        h('p', { class: 'soft' }, 'Drag a handle: the rest follows, through the inside of the body.'),
      ),
      h('section', {}, h('h3', {}, 'Handles'), this.#list),
      this.#place,
      h(
        'section',
        { 'aria-labelledby': 'inside' },
        h('h3', { id: 'inside' }, 'Inside'),
        h('div', { class: 'insides', role: 'group', 'aria-labelledby': 'inside' }, ...this.#inside),
      ),
      h(
        'div',
        { class: 'buttons panel-foot' },
        button('Add a handle', () => scene.startPlacing(), 'button', { id: 'add-handle' }),
        button('Reset', () => scene.reset(), 'button primary', { id: 'reset' }),
      ),
    );
  }

  list(points: readonly Point[]): void {
    this.#list.replaceChildren(
      ...points.map(({ name }, i) =>
        h(
          'button',
          { type: 'button', class: 'handle-row', 'aria-pressed': 'false', onclick: () => this.#scene.select(i) },
          h('span', {}, name),
          h('span', { class: 'moved' }),
        ),
      ),
    );
    this.select(this.#scene.selected);
  }

  /** These parts of the inside are shown. */
  show(parts: ReadonlySet<Part>): void {
    this.#inside.forEach((each, i) => {
      each.setAttribute('aria-pressed', String(!each.disabled && parts.has(PARTS[i] as Part)));
    });
  }

  select(index: number): void {
    const point = this.#scene.points[index];
    for (const [i, row] of [...this.#list.children].entries()) row.setAttribute('aria-pressed', String(i === index));
    this.#place.hidden = !point;
    if (!point) return;
    this.#heading.textContent = point.name;
    this.#remove.hidden = !point.removable;
    this.follow();
  }

  /** How far handle `i` is from rest, in words. */
  moved(i: number, text: string): void {
    const cell = this.#list.children[i]?.lastElementChild;
    if (cell && cell.textContent !== text) cell.textContent = text;
  }

  /** Writes the chosen handle's place, except where somebody is typing. */
  follow(): void {
    if (this.#scene.selected < 0) return;
    const target = this.#scene.target(this.#scene.selected).toArray();
    this.#inputs.forEach((input, i) => {
      if (input !== document.activeElement) input.value = (target[i] as number).toFixed(this.#digits);
    });
  }

  #typed(): void {
    const values = this.#inputs.map((input) => input.valueAsNumber);
    if (values.every(Number.isFinite)) this.#scene.moveTo(this.#scene.selected, new Vector3(...values));
  }
}

const NAMES: Record<Part, string> = { spheres: 'Spheres', centers: 'Centers', skeleton: 'Skeleton' };

/** Shows a part of the inside, and says how much there is of it. */
function insideButton(part: Part, scene: Steerable): HTMLButtonElement {
  const count = scene.insides[part];
  const unit = part === 'skeleton' ? (count === 1 ? ' branch' : ' branches') : '';
  const made: HTMLButtonElement = h(
    'button',
    {
      type: 'button',
      class: 'button inside-part',
      'data-part': part,
      'aria-pressed': 'false',
      disabled: count === 0,
      onclick: () => scene.showInside(part, made.getAttribute('aria-pressed') !== 'true'),
    },
    h('span', {}, NAMES[part]),
    h('span', { class: 'many' }, count === 0 ? 'none' : `${count}${unit}`),
  );
  return made;
}
