import type { ColorMap } from '../../ui/color-map.ts';
import { h, readable, write } from '../../ui/dom.ts';
import { axisMarks } from './scale.ts';
import { brief } from './words.ts';

let nextId = 1;

/** The legend of all fields, with a slider on it: the chosen point's value among the colors. */
export class ColorScale {
  readonly element: HTMLElement;
  readonly #input: HTMLInputElement;
  readonly #title: HTMLLabelElement;
  readonly #strip = h('div', { class: 'scale-strip', 'aria-hidden': 'true' });
  readonly #marks = h('div', { class: 'scale-marks', 'aria-hidden': 'true' });
  #drawn = '';

  constructor(change: (value: number) => void) {
    const id = `scale-${nextId++}`;
    this.#title = h('label', { for: id }, 'Value');
    this.#input = h('input', {
      type: 'range',
      id,
      step: 'any',
      oninput: () => change(this.#input.valueAsNumber),
    });
    this.element = h(
      'div',
      { class: 'color-scale' },
      this.#title,
      h('div', { class: 'scale-bar' }, this.#strip, this.#input),
      this.#marks,
    );
  }

  show(colors: ColorMap, title: string, value: number | undefined): void {
    const drawn = `${colors.gradient}${colors.low},${colors.high}`;
    if (drawn !== this.#drawn) {
      this.#drawn = drawn;
      this.#strip.style.background = colors.gradient;
      const { at, digits } = axisMarks(colors.low, colors.high, 6);
      this.#marks.replaceChildren(
        ...at.map((mark) => {
          const span = h('span', {}, readable(mark, digits));
          span.style.left = `${(((mark - colors.low) / (colors.high - colors.low)) * 100).toFixed(2)}%`;
          return span;
        }),
      );
      this.#input.min = String(colors.low);
      this.#input.max = String(colors.high);
      this.#input.step = String((colors.high - colors.low) / 400);
    }
    write(this.#title, title);
    this.#input.disabled = value === undefined;
    this.#input.hidden = value === undefined;
    if (value === undefined) return;
    if (Math.abs(this.#input.valueAsNumber - value) > (colors.high - colors.low) / 800) this.#input.value = String(value);
    this.#input.setAttribute('aria-valuetext', brief(value));
    this.#input.style.setProperty('--fill', colors.css(value));
  }
}
