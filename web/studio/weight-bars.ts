import type { DrivenSpace } from '../three/pose-driver.ts';
import { h, readable } from '../ui/dom.ts';

/** A bar for every example's weight, blue to the right and orange to the left of zero, with its number; a click goes to the example. */
export class WeightBars {
  readonly element: HTMLElement;
  readonly #rows: { row: HTMLElement; bar: HTMLElement; number: HTMLElement }[];
  readonly #sum = h('span', { class: 'sum' });

  constructor(source: DrivenSpace, go: (x: number, y: number) => void) {
    this.#rows = source.examples.map(({ name, at }) => {
      const bar = h('span', { class: 'weight-bar' });
      const number = h('span', { class: 'weight-number' });
      const row = h(
        'button',
        { type: 'button', class: 'weight-row', onclick: () => go(at[0] ?? 0, at[1] ?? 0) },
        h('span', { class: 'weight-name' }, name),
        h('span', { class: 'weight-track', 'aria-hidden': 'true' }, bar),
        number,
      );
      row.dataset.example = name;
      return { row, bar, number };
    });
    this.element = h(
      'section',
      { class: 'weights', 'aria-labelledby': 'weights-title' },
      h('div', { class: 'weights-head' }, h('h3', { id: 'weights-title' }, 'Weights'), this.#sum),
      ...this.#rows.map(({ row }) => row),
    );
  }

  show(weights: Float64Array): void {
    let sum = 0;
    this.#rows.forEach(({ row, bar, number }, i) => {
      const weight = weights[i] ?? 0;
      sum += weight;
      number.textContent = readable(weight);
      bar.style.scale = `${Math.min(Math.abs(weight), 1.3) / 1.3} 1`;
      row.dataset.sign = Math.abs(weight) < 0.005 ? 'none' : weight > 0 ? 'positive' : 'negative';
    });
    this.#sum.textContent = `sum ${readable(sum)}`;
  }
}
