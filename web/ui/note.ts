/** A line over a view that says what is going on. */
export class Note {
  readonly #element: HTMLElement;

  constructor(element: HTMLElement) {
    this.#element = element;
  }

  /** Without words it goes. */
  show(words: string): void {
    this.#element.textContent = words;
    this.#element.hidden = words === '';
  }
}
