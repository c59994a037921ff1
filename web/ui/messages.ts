import { button, h } from './dom.ts';
import { explain } from './explain.ts';

/** The page's one place for what went wrong: a sentence, what to do about it, and the code in small type. */
export class Messages {
  readonly #area: HTMLElement;
  readonly #returnTo: () => HTMLElement | null;

  /** `area` is the live region, in the page from the start; `returnTo` gets the focus when a message is dismissed. */
  constructor(area: HTMLElement, returnTo: () => HTMLElement | null) {
    [this.#area, this.#returnTo] = [area, returnTo];
  }

  /** `again`: what was asked for may well come when it is asked for once more. */
  show(error: unknown, again?: () => void): void {
    if (this.final) return;
    const text = sentences(error);
    const retry = () => {
      this.#dismiss();
      again?.();
    };
    if (again) text.append(button('Try again', retry, 'button', { style: 'margin-block-start: var(--gap-2)' }));
    const dismiss = button('×', () => this.#dismiss(), 'dismiss', { 'aria-label': 'Dismiss this message' });
    const card = h('div', { class: 'message' }, text, dismiss);
    card.addEventListener('keydown', (event) => event.key === 'Escape' && this.#dismiss());
    this.#area.replaceChildren(card);
  }

  /** For what leaves no picture to show: fills the view and stays. */
  showInstead(error: unknown): void {
    this.#area.toggleAttribute('data-instead', true);
    this.#area.replaceChildren(h('div', { class: 'message' }, sentences(error)));
  }

  /** Whether there is nothing but the message. */
  get final(): boolean {
    return this.#area.hasAttribute('data-instead');
  }

  clear(): void {
    if (this.final) return;
    this.#area.replaceChildren();
  }

  #dismiss(): void {
    this.clear();
    this.#returnTo()?.focus();
  }
}

function sentences(error: unknown): HTMLElement {
  const { message, remedy, detail } = explain(error);
  const text = h('div', {}, h('p', { class: 'sentence' }, message), h('p', { class: 'remedy' }, remedy));
  if (detail) text.append(h('p', { class: 'code' }, detail));
  return text;
}

/** Whether the error only says that the user cancelled. */
export function isAbort(error: unknown): boolean {
  return error instanceof Error && (error.name === 'AbortError' || (error as { code?: unknown }).code === 'aborted');
}
