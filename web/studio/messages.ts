import { h } from './dom.ts';

interface Told {
  readonly message: string;
  readonly remedy: string;
  readonly detail?: string;
}

/** The page's one place for what went wrong: a sentence, what to do about it, and the code in small type. */
export class Messages {
  readonly #area: HTMLElement;
  readonly #returnTo: () => HTMLElement | null;

  /** `area` is the live region, in the page from the start; `returnTo` gets the focus when a message is dismissed. */
  constructor(area: HTMLElement, returnTo: () => HTMLElement | null) {
    this.#area = area;
    this.#returnTo = returnTo;
  }

  show(error: unknown): void {
    if (this.final) return;
    const text = sentences(error);
    const dismiss = h(
      'button',
      { type: 'button', class: 'dismiss', 'aria-label': 'Dismiss this message', onclick: () => this.#dismiss() },
      '×',
    );
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

/** Any error as a sentence and a remedy. The library's own errors bring both. */
export function explain(error: unknown): Told {
  if (!(error instanceof Error))
    return { message: `Something went wrong: ${String(error)}.`, remedy: 'Reload the page and try again.' };
  const { code, remedy, culprit } = error as Partial<{ code: string; remedy: string; culprit: { kind: string; index: number } }> &
    Error;
  if (typeof remedy !== 'string') {
    return { message: `Something went wrong: ${error.message}`, remedy: 'Reload the page; if it happens again, please report it.' };
  }
  const where = culprit ? `, ${culprit.kind} ${culprit.index}` : '';
  return { message: error.message, remedy, detail: `${code}${where}` };
}

/** Whether the error only says that the user cancelled. */
export function isAbort(error: unknown): boolean {
  return error instanceof Error && (error.name === 'AbortError' || (error as { code?: unknown }).code === 'aborted');
}
