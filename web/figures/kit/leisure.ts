/** Milliseconds until a pause is one, and those that are then taken at a time. */
const PAUSE = 30;
const BUDGET = 10;

/** Work on one thing after another while nobody does anything; `data-done` on an element says that none is left. */
export class Leisure<T> {
  readonly #element: HTMLElement;
  #left: T[] = [];
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(element: HTMLElement) {
    this.#element = element;
  }

  /** Goes on, or begins with other things. */
  go(work: (thing: T) => void, things: T[] = this.#left): void {
    this.pause();
    this.#left = things;
    this.#element.toggleAttribute('data-done', things.length === 0);
    if (things.length === 0) return;
    this.#timer = setTimeout(() => {
      const until = performance.now() + BUDGET;
      do work(things.shift() as T);
      while (things.length > 0 && performance.now() < until);
      this.go(work);
    }, PAUSE);
  }

  pause(): void {
    clearTimeout(this.#timer);
  }
}
