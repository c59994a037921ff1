import { button, h } from './dom.ts';

/** A bar over the view for work that takes a while, with a way to stop it. */
export class Progress {
  readonly #box: HTMLElement;
  readonly #label = h('span');
  readonly #bar = h('progress', { max: 1 });
  readonly #cancel = button('Cancel', () => this.#stop?.(), 'button', { hidden: true });
  #stop: (() => void) | undefined;
  /** What had the focus when the work began. */
  #from: Element | null = null;

  constructor(box: HTMLElement) {
    this.#box = box;
    // What the page itself says until the program has come.
    this.#name(box.textContent?.trim() ?? '');
    box.replaceChildren(h('div', { class: 'progress-text' }, this.#label, this.#cancel), this.#bar);
  }

  /** Shows the bar. Without `cancel` there is no button. */
  begin(label: string, cancel?: () => void): void {
    this.#name(label);
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
    this.#name(label);
  }

  end(): void {
    if (this.#box.contains(document.activeElement) && this.#from instanceof HTMLElement) this.#from.focus();
    this.#box.hidden = true;
    this.#stop = undefined;
  }

  #name(label = this.#label.textContent): void {
    this.#label.textContent = this.#bar.ariaLabel = label;
  }
}
