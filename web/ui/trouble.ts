import { button, h } from './dom.ts';
import { explain } from './explain.ts';

/** A page's one line for what went wrong: a sentence, what to do about it and, where that may help, a button that tries again. */
export class Trouble {
  readonly #area: HTMLElement;
  readonly #returnTo: () => HTMLElement | null;
  /** Told of what is said, too. */
  onTell: (error: unknown) => void = () => {};

  /** `returnTo` gets the focus when the line goes and had it. */
  constructor(area: HTMLElement, returnTo: () => HTMLElement | null) {
    [this.#area, this.#returnTo] = [area, returnTo];
  }

  tell(error: unknown, again?: () => void): void {
    const { message, remedy, detail = '' } = explain(error);
    const act = (then?: () => void) => () => {
      this.clear();
      then?.();
    };
    const retry = again && button('Try again', act(again));
    const dismiss = button('×', act(), 'dismiss', { 'aria-label': 'Dismiss this message' });
    this.#area.replaceChildren(h('span', {}, `${message} ${remedy}`), ...(retry ? [retry] : []), dismiss);
    this.#area.dataset.code = detail;
    this.#area.hidden = false;
    this.onTell(error);
  }

  clear(): void {
    const focused = this.#area.contains(document.activeElement);
    this.#area.replaceChildren();
    this.#area.hidden = true;
    if (focused) this.#returnTo()?.focus();
  }
}
