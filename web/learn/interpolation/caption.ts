import { h } from '../../ui/dom.ts';
import { presetOf } from './presets.ts';

/** What a preset shows, what to try, and the way back to it. */
export class Caption {
  readonly element: HTMLElement;
  readonly #title: HTMLElement;
  readonly #look = h('p', {});
  readonly #attempt = h('p', { class: 'attempt' });
  readonly #back = h('a', { class: 'button small', hidden: true }, 'Back to how it was');

  /** `title` is the heading above the picture. */
  constructor(title: HTMLElement) {
    this.#title = title;
    this.element = h('div', { class: 'caption' }, this.#look, this.#attempt, this.#back);
  }

  show(id: string, changed: boolean): void {
    const preset = presetOf(id);
    this.#back.hidden = !changed;
    if (!preset || this.#title.dataset.preset === id) return;
    this.#title.dataset.preset = id;
    const figure = /^Fig\. \d+/.exec(preset.mark)?.[0];
    this.#title.replaceChildren(...(figure ? [h('span', { class: 'figure' }, `${figure} `)] : []), preset.title);
    this.#look.textContent = preset.look;
    this.#attempt.replaceChildren(h('strong', {}, 'Try: '), preset.attempt);
    this.#back.setAttribute('href', `#${id}`);
  }
}
