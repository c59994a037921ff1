import type { DrivenSpace } from '../three/pose-driver.ts';
import { h, readable } from '../ui/dom.ts';
import { steerSlider } from '../ui/slider.ts';
import { Pad } from './pad.ts';

/** How long the puck must rest before its place is read out. */
const SPEAK_AFTER = 600;
/** An example counts as near up to this distance. */
const NEAR = 0.3;
const EXACT = 0.02;
/** Of the sliders. */
const STEP = 0.01;

/** A place in a pose space's plane: a picture with a puck, a slider along each axis, and the place in words. */
export class PosePlane {
  readonly element: HTMLElement;
  /** "valence 0.40, arousal 0.20, near calm" */
  readonly place = h('p', { class: 'place', 'aria-hidden': 'true' });
  /** The same, said when the puck rests. */
  readonly spoken = h('p', { class: 'unseen', 'aria-live': 'polite' });
  readonly #pad: Pad;
  readonly #sliders: readonly HTMLInputElement[];
  readonly #source: DrivenSpace;
  #speaking: ReturnType<typeof setTimeout> | undefined;

  constructor(source: DrivenSpace, go: (x: number, y: number) => void) {
    this.#source = source;
    const names = [source.dimensions[0]?.name ?? 'x', source.dimensions[1]?.name ?? 'y'] as const;
    const reach = Math.max(1, ...source.examples.flatMap(({ at }) => at.map(Math.abs)));
    const limit = Math.ceil(reach * 10) / 10;
    const slid = () => go(...(this.#sliders.map((slider) => slider.valueAsNumber) as [number, number]));
    this.#sliders = names.map((name, i) =>
      h('input', {
        type: 'range',
        class: i ? 'upright' : '',
        min: -limit,
        max: limit,
        value: 0,
        'aria-label': capital(name),
        ...(i ? { 'aria-orientation': 'vertical' } : {}),
        oninput: slid,
      }),
    );
    for (const slider of this.#sliders) steerSlider(slider, STEP);
    this.#pad = new Pad(source, limit, go);
    // The sliders say their names themselves.
    const label = (i: 0 | 1) => h('span', { class: `pad-label${i ? ' upright' : ''}`, 'aria-hidden': 'true' }, capital(names[i]));
    const [across = '', up = ''] = this.#sliders;
    this.element = h('div', { class: 'pad-grid' }, label(1), up, this.#pad.element, across, label(0));
  }

  /** The puck is at (x, y). */
  show(x: number, y: number): void {
    const { dimensions } = this.#source;
    this.#pad.place(x, y);
    const near = this.#near(x, y);
    [x, y].forEach((value, i) => {
      const slider = this.#sliders[i] as HTMLInputElement;
      if (slider.valueAsNumber !== value) slider.value = String(value);
      slider.setAttribute('aria-valuetext', `${words(value)}${near}`);
    });
    const text = `${dimensions[0]?.name} ${words(x)}, ${dimensions[1]?.name} ${words(y)}${near}`;
    this.place.textContent = text;
    clearTimeout(this.#speaking);
    this.#speaking = setTimeout(() => {
      this.spoken.textContent = text;
    }, SPEAK_AFTER);
  }

  /** The examples' weights at the present, maybe still moving, place. */
  weigh(weights: Float64Array): void {
    this.#pad.weigh(weights);
  }

  #near(x: number, y: number): string {
    let [best, name] = [Number.POSITIVE_INFINITY, ''];
    for (const example of this.#source.examples) {
      const distance = Math.hypot(x - (example.at[0] ?? 0), y - (example.at[1] ?? 0));
      if (distance < best) [best, name] = [distance, example.name];
    }
    if (best < EXACT) return `, ${name}`;
    return best < NEAR ? `, near ${name}` : '';
  }
}

/** A place on an axis, with a digit more where a fine step went between two. */
function words(value: number): string {
  return readable(value, Math.abs(value - Number(value.toFixed(2))) < 1e-6 ? 2 : 3);
}

function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
