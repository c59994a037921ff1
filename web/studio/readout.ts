import type { Round } from '../three/live-body.ts';
import { h } from '../ui/dom.ts';

/** The small print of the solver, in the corner of the view. Silent for screen readers: it changes with every frame. */
export class Readout {
  readonly #element: HTMLElement;
  readonly #iterations = h('dd');
  readonly #solve = h('dd');
  readonly #deform = h('dd');
  readonly #error = h('dd');

  constructor(element: HTMLElement) {
    this.#element = element;
    const row = (name: string, value: HTMLElement) => h('div', {}, h('dt', {}, name), value);
    this.#element.replaceChildren(
      row('iterations', this.#iterations),
      row('solve', this.#solve),
      row('deform', this.#deform),
      row('off target', this.#error),
    );
  }

  show({ iterations, solve, deform, error, converged }: Round): void {
    this.#element.hidden = false;
    this.#element.toggleAttribute('data-settled', converged);
    this.#iterations.textContent = String(iterations);
    this.#solve.textContent = `${solve.toFixed(1)} ms`;
    this.#deform.textContent = `${deform.toFixed(1)} ms`;
    this.#error.textContent = `${(error * 100).toFixed(3)} %`;
  }

  hide(): void {
    this.#element.hidden = true;
  }
}
