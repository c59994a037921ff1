import { h, match, write } from '../../../ui/dom.ts';
import { brief } from '../../kit/words.ts';

/** The weights of a fit's kernels as bars around zero, in the largest one's scale. */
export class WeightList {
  readonly #rows = h('div', { class: 'weight-rows' });
  readonly element = h('div', { hidden: true }, h('h4', { class: 'soft' }, 'Weights of the kernels'), this.#rows);

  show(weights: Float64Array | undefined): void {
    this.element.hidden = !weights;
    if (!weights) return;
    match(this.#rows, weights.length, (i) => {
      const track = h('span', { class: 'track', 'aria-hidden': 'true' }, h('span', { class: 'weight-bar' }));
      return h('div', { class: 'kernel-weight' }, h('span', { class: 'soft' }, String(i)), track, h('span', { class: 'number' }));
    });
    const most = weights.reduce((largest, weight) => Math.max(largest, Math.abs(weight)), 1e-300);
    weights.forEach((weight, i) => {
      const row = this.#rows.children[i] as HTMLElement;
      const [bar, number] = [row.querySelector('.weight-bar') as HTMLElement, row.lastElementChild as HTMLElement];
      bar.style.scale = `${(Math.abs(weight) / most).toFixed(3)} 1`;
      row.dataset.sign = weight < 0 ? 'negative' : 'positive';
      write(number, brief(weight));
    });
  }
}
