import { h } from './dom.ts';

/** A bar over the view for work that takes a while, with a way to stop it. */
export class Progress {
  readonly #box: HTMLElement;
  readonly #label = h('span', { id: 'progress-label' });
  readonly #bar = h('progress', { max: 1, 'aria-labelledby': 'progress-label' });
  readonly #cancel = h('button', { type: 'button', class: 'button', hidden: true }, 'Cancel');
  #stop: (() => void) | undefined;
  /** What had the focus when the work began. */
  #from: Element | null = null;

  constructor(box: HTMLElement) {
    this.#box = box;
    this.#cancel.addEventListener('click', () => this.#stop?.());
    const label = document.getElementById('progress-label');
    label?.replaceWith(this.#label);
    box.replaceChildren(h('div', { class: 'progress-text' }, this.#label, this.#cancel), this.#bar);
  }

  /** Shows the bar. Without `cancel` there is no button. */
  begin(label: string, cancel?: () => void): void {
    this.#label.textContent = label;
    this.#stop = cancel;
    if (this.#box.hidden) this.#from = document.activeElement;
    this.#cancel.hidden = !cancel;
    this.#bar.removeAttribute('value');
    this.#box.hidden = false;
  }

  /** The part done, 0 to 1; `undefined` when nobody knows how much there is. */
  set(part: number | undefined, label?: string): void {
    if (part === undefined) this.#bar.removeAttribute('value');
    else this.#bar.value = part;
    if (label) this.#label.textContent = label;
  }

  end(): void {
    if (this.#box.contains(document.activeElement) && this.#from instanceof HTMLElement) this.#from.focus();
    this.#box.hidden = true;
    this.#stop = undefined;
  }
}
