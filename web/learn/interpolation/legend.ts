import { swatch } from '../../figures/kit/swatch.ts';
import { h } from '../../ui/dom.ts';
import type { Fit } from './fit.ts';

/** Which line is whose, where there is no room beside the curves. */
export class Legend {
  readonly element = h('ul', { class: 'legend', 'aria-hidden': 'true' });

  list(fits: readonly Fit[]): void {
    this.element.replaceChildren(...fits.map(({ model }) => h('li', {}, swatch(model.slot), h('span', {}))));
  }

  update(fits: readonly Fit[]): void {
    fits.forEach(({ model, label }, i) => {
      const item = this.element.children[i] as HTMLElement | undefined;
      if (!item) return;
      item.hidden = !model.shown;
      const text = [label.name, label.detail].filter(Boolean).join(', ');
      const span = item.lastElementChild as HTMLElement;
      if (span.textContent !== text) span.textContent = text;
    });
  }
}
