import { h } from '../../ui/dom.ts';
import { type Control, checkbox, controlOf } from './controls.ts';
import type { Experiment, Show } from './experiment.ts';
import type { Parameter } from './parameter.ts';

type Entry = readonly [id: keyof Show, control: Control, when: (experiment: Experiment) => boolean];

const line = ({ dimension }: Experiment) => dimension === 1;
const plane = ({ dimension }: Experiment) => dimension === 2;

const OUTLIERS: Parameter = {
  type: 'choice',
  id: 'outliers',
  label: 'Look for outliers',
  initial: 'off',
  options: [
    ['off', 'no'],
    ['row-sum', 'by their part of the function norm'],
    ['leave-one-out', 'by leaving each out'],
    ['residual', 'farthest from the smoothed curve'],
  ],
};

const SECTION: Parameter = {
  type: 'choice',
  id: 'section',
  label: 'Section',
  initial: 'off',
  options: [
    ['off', 'none'],
    ['across', 'across'],
    ['up', 'from below to above'],
    ['diagonal', 'along the diagonal'],
  ],
};

const COLORS: Parameter = {
  type: 'choice',
  id: 'colors',
  label: 'Colors',
  initial: 'viridis',
  options: [
    ['viridis', 'viridis'],
    ['around-zero', 'blue and orange around zero'],
  ],
};

/** What is drawn besides the interpolants. */
export class ShowPanel {
  readonly element: HTMLElement;
  readonly #entries: readonly Entry[];
  readonly #found = h('p', { class: 'found', hidden: true });
  readonly #at: HTMLInputElement;
  readonly #atPart: HTMLElement;

  constructor(change: (show: Partial<Show>) => void) {
    const tick = (id: keyof Show, label: string, when: Entry[2]): Entry => [
      id,
      checkbox({ label }, (on) => change({ [id]: on })),
      when,
    ];
    const choice = (parameter: Parameter, when: Entry[2]): Entry => [
      parameter.id as keyof Show,
      controlOf(parameter, (setting) => change({ [parameter.id]: setting })),
      when,
    ];
    this.#entries = [
      tick('kernels', 'Weighted kernels, and their sum dashed', line),
      tick('cardinal', 'Weight of the chosen point', () => true),
      tick('surface', 'Surfaces instead of maps', plane),
      tick('isolines', 'Isolines', ({ dimension, show }) => dimension === 2 && !show.surface),
      choice(SECTION, plane),
      choice(COLORS, plane),
      choice(OUTLIERS, () => true),
    ];
    const id = 'section-at';
    this.#at = h('input', {
      type: 'range',
      id,
      step: 'any',
      oninput: () => change({ sectionAt: Number(this.#at.valueAsNumber.toFixed(3)) }),
    });
    this.#atPart = h('div', { class: 'control' }, h('label', { for: id }, 'Section at'), this.#at);
    this.element = h(
      'section',
      { class: 'show-part', 'aria-labelledby': 'show-title' },
      h('h2', { id: 'show-title' }, 'Show'),
      ...this.#entries.map(([, { element }]) => element),
      this.#found,
    );
    const section = this.#entries.find(([name]) => name === 'section');
    section?.[1].element.after(this.#atPart);
  }

  update(experiment: Experiment, found: string): void {
    for (const [id, control, when] of this.#entries) {
      control.element.hidden = !when(experiment);
      control.show(experiment.show[id]);
    }
    const { section, sectionAt } = experiment.show;
    const [left, right, bottom, top] = experiment.frame;
    this.#atPart.hidden = experiment.dimension === 1 || section === 'off' || section === 'diagonal';
    this.#at.min = String(section === 'up' ? left : bottom);
    this.#at.max = String(section === 'up' ? right : top);
    this.#at.value = String(sectionAt);
    this.#found.hidden = found === '';
    if (this.#found.textContent !== found) this.#found.textContent = found;
  }
}
