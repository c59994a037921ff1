import { PosePlane } from '../element/pose-plane.ts';
import type { DrivenSpace } from '../three/pose-driver.ts';
import { button, h } from '../ui/dom.ts';
import { WeightBars } from './weight-bars.ts';

/** The controls of a pose space: the plane, the place in words, the examples' weights. */
export class PosePanel {
  readonly element: HTMLElement;
  readonly #plane: PosePlane;
  readonly #bars: WeightBars;

  constructor(title: string, source: DrivenSpace, go: (x: number, y: number) => void, reset: () => void) {
    this.#plane = new PosePlane(source, go);
    this.#bars = new WeightBars(source, go);
    this.element = h(
      'div',
      { class: 'panel-content' },
      h(
        'section',
        { class: 'intro' },
        h('h2', {}, title),
        h('p', { class: 'soft' }, 'Move the puck: every face between the named ones is a blend of them all.'),
      ),
      h(
        'section',
        { class: 'pad-section', 'aria-label': 'Place on the plane' },
        this.#plane.element,
        h('div', { class: 'place-row' }, this.#plane.place, button('Reset', reset, 'button', { id: 'reset' })),
        this.#plane.spoken,
      ),
      this.#bars.element,
    );
    this.place(0, 0);
  }

  /** The puck is at (x, y). */
  place(x: number, y: number): void {
    this.#plane.show(x, y);
    this.element.dataset.place = `${x} ${y}`;
  }

  /** The examples' weights at the present, maybe still moving, place. */
  weigh(weights: Float64Array): void {
    this.#plane.weigh(weights);
    this.#bars.show(weights);
  }
}
