import type { PoseSpaceSource } from '../three/pose-source.ts';
import { button, h, readable } from '../ui/dom.ts';
import { steerSlider } from '../ui/slider.ts';
import { Pad } from './pad.ts';
import { WeightBars } from './weight-bars.ts';

/** How long the puck must rest before its place is read out. */
const SPEAK_AFTER = 600;
/** An example counts as near up to this distance. */
const NEAR = 0.3;
const EXACT = 0.02;
/** Of the sliders. */
const STEP = 0.01;

/** The controls of a pose space: the pad with its two sliders, the place in words, the examples' weights. */
export class PosePanel {
  readonly element: HTMLElement;
  readonly #pad: Pad;
  readonly #bars: WeightBars;
  readonly #sliders: [HTMLInputElement, HTMLInputElement];
  readonly #place = h('p', { class: 'place', 'aria-hidden': 'true' });
  readonly #spoken = h('p', { class: 'unseen', 'aria-live': 'polite' });
  readonly #source: PoseSpaceSource;
  readonly #go: (x: number, y: number) => void;
  #speaking: ReturnType<typeof setTimeout> | undefined;

  constructor(title: string, source: PoseSpaceSource, go: (x: number, y: number) => void, reset: () => void) {
    this.#source = source;
    this.#go = go;
    const names = [source.dimensions[0] ?? 'x', source.dimensions[1] ?? 'y'] as const;
    const reach = Math.max(1, ...source.examples.flatMap(({ at }) => at.map(Math.abs)));
    const limit = Math.ceil(reach * 10) / 10;
    this.#sliders = names.map((name, i) =>
      h('input', {
        type: 'range',
        id: `slider-${i}`,
        class: i ? 'upright' : '',
        min: -limit,
        max: limit,
        value: 0,
        'aria-label': capital(name),
        ...(i ? { 'aria-orientation': 'vertical' } : {}),
        oninput: () => this.#slid(),
      }),
    ) as [HTMLInputElement, HTMLInputElement];
    for (const slider of this.#sliders) steerSlider(slider, STEP);
    this.#pad = new Pad(source, limit, go);
    this.#bars = new WeightBars(source, go);
    const pad = h(
      'div',
      { class: 'pad-grid' },
      h('label', { class: 'pad-label upright', for: 'slider-1' }, capital(names[1])),
      this.#sliders[1],
      this.#pad.element,
      this.#sliders[0],
      h('label', { class: 'pad-label', for: 'slider-0' }, capital(names[0])),
    );
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
        pad,
        h('div', { class: 'place-row' }, this.#place, button('Reset', reset, 'button', { id: 'reset' })),
        this.#spoken,
      ),
      this.#bars.element,
    );
    this.place(0, 0);
  }

  /** The puck is at (x, y). */
  place(x: number, y: number): void {
    const { dimensions } = this.#source;
    this.#pad.place(x, y);
    const near = this.#near(x, y);
    [x, y].forEach((value, i) => {
      const slider = this.#sliders[i] as HTMLInputElement;
      if (slider.valueAsNumber !== value) slider.value = String(value);
      slider.setAttribute('aria-valuetext', `${words(value)}${near ? `, ${near}` : ''}`);
    });
    const text = `${dimensions[0]} ${words(x)}, ${dimensions[1]} ${words(y)}${near ? `, ${near}` : ''}`;
    this.#place.textContent = text;
    this.element.dataset.place = `${x} ${y}`;
    clearTimeout(this.#speaking);
    this.#speaking = setTimeout(() => {
      this.#spoken.textContent = text;
    }, SPEAK_AFTER);
  }

  /** The examples' weights at the present, maybe still moving, place. */
  weigh(weights: Float64Array): void {
    this.#pad.weigh(weights);
    this.#bars.show(weights);
  }

  #near(x: number, y: number): string {
    let [best, name] = [Number.POSITIVE_INFINITY, ''];
    for (const example of this.#source.examples) {
      const distance = Math.hypot(x - (example.at[0] ?? 0), y - (example.at[1] ?? 0));
      if (distance < best) [best, name] = [distance, example.name];
    }
    if (best < EXACT) return name;
    return best < NEAR ? `near ${name}` : '';
  }

  #slid(): void {
    this.#go(this.#sliders[0].valueAsNumber, this.#sliders[1].valueAsNumber);
  }
}

/** A place on an axis, with a digit more where a fine step went between two. */
function words(value: number): string {
  return readable(value, Math.abs(value - Number(value.toFixed(2))) < 1e-6 ? 2 : 3);
}

function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
