/** A line over the view that says what is going on and goes away by itself. */
export class Note {
  readonly #element: HTMLElement;

  constructor(element: HTMLElement) {
    this.#element = element;
  }

  show(text: string): void {
    this.#element.textContent = text;
    this.#element.hidden = false;
  }

  hide(): void {
    this.#element.hidden = true;
    this.#element.textContent = '';
  }
}
