import { h } from '../../../ui/dom.ts';
import { brief } from '../../kit/words.ts';

/** The weights of a fit's kernels as bars around zero, in the largest one's scale. */
export class WeightList {
  readonly element: HTMLElement;
  readonly #rows = h('div', { class: 'weight-rows' });

  constructor() {
    this.element = h('div', { class: 'weight-list', hidden: true }, h('h3', {}, 'Weights of the kernels'), this.#rows);
  }

  show(weights: Float64Array | undefined): void {
    this.element.hidden = !weights;
    if (!weights) return;
    while (this.#rows.childElementCount > weights.length) this.#rows.lastElementChild?.remove();
    while (this.#rows.childElementCount < weights.length) {
      const i = this.#rows.childElementCount;
      this.#rows.append(
        h(
          'div',
          { class: 'kernel-weight' },
          h('span', { class: 'soft' }, String(i)),
          h('span', { class: 'track', 'aria-hidden': 'true' }, h('span', { class: 'weight-bar' })),
          h('span', { class: 'number' }),
        ),
      );
    }
    let most = 1e-300;
    for (const weight of weights) most = Math.max(most, Math.abs(weight));
    weights.forEach((weight, i) => {
      const row = this.#rows.children[i] as HTMLElement;
      const [bar, number] = [row.querySelector('.weight-bar') as HTMLElement, row.lastElementChild as HTMLElement];
      bar.style.scale = `${(Math.abs(weight) / most).toFixed(3)} 1`;
      row.dataset.sign = weight < 0 ? 'negative' : 'positive';
      const text = brief(weight);
      if (number.textContent !== text) number.textContent = text;
    });
  }
}
