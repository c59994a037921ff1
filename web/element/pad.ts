import type { DrivenSpace } from '../three/pose-driver.ts';
import { h, svg } from '../ui/dom.ts';
import { draggable, type Grip, isDragging, take } from '../ui/drag.ts';
import { declutter, type Label } from './declutter.ts';

/** Words for the ends of the axes of Russell's plane; other spaces get minus and plus. */
const ENDS: Record<string, readonly [string, string]> = { valence: ['unpleasant', 'pleasant'], arousal: ['sleepy', 'activated'] };

const DOT = 4;
/** A click this close to a dot means the dot, in pixels. */
const SNAP = 13;
const LINE = 13;

/** The picture behind the sliders: the plane, the examples as dots as large as their weights, and a puck to drag. */
export class Pad {
  readonly element: HTMLElement;
  readonly #svg = svg('svg', { 'aria-hidden': 'true' });
  readonly #source: DrivenSpace;
  readonly #limit: number;
  readonly #go: (x: number, y: number) => void;
  readonly #lines = svg('g', { class: 'pad-lines' });
  readonly #dots: SVGCircleElement[];
  readonly #labels: SVGTextElement[];
  readonly #puck = svg('circle', { class: 'puck', r: 10 });
  /** What a finger takes the puck by; in HTML, since browsers do not ask parts of a picture whether a touch may scroll. */
  readonly #grip = h('div', { class: 'grip' });
  readonly #ends: SVGTextElement[];
  #size = 0;
  #at: readonly [number, number] = [0, 0];
  /** Where the puck was before it came to a pointer beside it. */
  #before: readonly [number, number] | undefined;
  /** Where a touch began that has not said yet what it wants. */
  #tap: { readonly pointer: number; readonly x: number; readonly y: number } | undefined;

  constructor(source: DrivenSpace, limit: number, go: (x: number, y: number) => void) {
    this.#source = source;
    this.#limit = limit;
    this.#go = go;
    this.#dots = source.examples.map(({ name }) => svg('circle', { class: 'dot', r: DOT }, svg('title', {}, name)));
    this.#labels = source.examples.map(({ name }) => svg('text', { class: 'dot-name' }, name));
    const [across, up] = [0, 1].map((i) => ENDS[source.dimensions[i]?.name ?? ''] ?? ['−', '+']) as [
      readonly [string, string],
      readonly [string, string],
    ];
    this.#ends = [across[0], across[1], up[0], up[1]].map((word) => svg('text', { class: 'pad-end' }, word));
    this.#svg.append(this.#lines, ...this.#ends, ...this.#dots, ...this.#labels, this.#puck);
    this.element = document.createElement('div');
    this.element.className = 'pad';
    this.element.append(this.#svg, this.#grip);
    const puck: Grip = {
      hold: () => {
        const before = this.#before ?? this.#at;
        return () => this.#go(...before);
      },
      drag: (x, y) => this.#follow(x, y, 0),
    };
    draggable(this.#grip, puck);
    /** The puck comes to a pointer beside it, and goes with it. */
    const call = (event: PointerEvent, snap: number) => {
      this.#before = this.#at;
      this.#follow(event.clientX, event.clientY, snap);
      take(this.#grip, puck, event);
      this.#before = undefined;
    };
    this.element.addEventListener('pointerdown', (event) => {
      if (event.button !== 0 || isDragging()) return;
      // A finger beside the puck may be about to scroll the page: it counts when it moves sideways or lifts.
      // Two fingers zoom the page.
      if (event.pointerType !== 'touch') call(event, SNAP);
      else this.#tap = this.#tap ? undefined : { pointer: event.pointerId, x: event.clientX, y: event.clientY };
    });
    this.element.addEventListener('pointermove', (event) => {
      if (event.pointerId !== this.#tap?.pointer) return;
      if (!isSideways(event.clientX - this.#tap.x, event.clientY - this.#tap.y)) return;
      this.#tap = undefined;
      call(event, 0);
    });
    for (const type of ['pointerup', 'pointercancel'] as const)
      this.element.addEventListener(type, (event) => {
        if (event.pointerId !== this.#tap?.pointer) return;
        this.#tap = undefined;
        if (type === 'pointerup') this.#follow(event.clientX, event.clientY, SNAP);
      });
    new ResizeObserver(() => this.#layout()).observe(this.element);
  }

  place(x: number, y: number): void {
    this.#at = [x, y];
    set(this.#puck, { cx: this.#x(x), cy: this.#y(y) });
    this.#grip.style.translate = `${this.#x(x)}px ${this.#y(y)}px`;
  }

  weigh(weights: Float64Array): void {
    this.#dots.forEach((dot, i) => {
      const weight = weights[i] ?? 0;
      dot.setAttribute('r', (DOT + 5 * Math.sqrt(Math.min(Math.abs(weight), 1))).toFixed(2));
      dot.dataset.sign = Math.abs(weight) < 0.03 ? 'none' : weight > 0 ? 'positive' : 'negative';
    });
  }

  #x(value: number): number {
    return ((value / this.#limit + 1) / 2) * this.#size;
  }

  #y(value: number): number {
    return ((1 - value / this.#limit) / 2) * this.#size;
  }

  /** Brings the puck to these pixels of the window, or to the example that is nearer than `snap`. */
  #follow(x: number, y: number, snap: number): void {
    const box = this.element.getBoundingClientRect();
    const [px, py] = [x - box.left - this.element.clientLeft, y - box.top - this.element.clientTop];
    let nearest = snap;
    let found: readonly number[] | undefined;
    for (const { at } of this.#source.examples) {
      const distance = Math.hypot(this.#x(at[0] ?? 0) - px, this.#y(at[1] ?? 0) - py);
      if (distance < nearest) [nearest, found] = [distance, at];
    }
    const clamp = (value: number) => Math.round(Math.min(Math.max(value, -1), 1) * this.#limit * 100) / 100;
    if (found) this.#go(found[0] ?? 0, found[1] ?? 0);
    else this.#go(clamp((px / this.#size) * 2 - 1), clamp(1 - (py / this.#size) * 2));
  }

  #layout(): void {
    const size = this.element.clientWidth;
    if (size === 0 || size === this.#size) return;
    this.#size = size;
    this.#svg.setAttribute('viewBox', `0 0 ${size} ${size}`);
    const half = size / 2;
    this.#lines.replaceChildren(
      svg('circle', { cx: half, cy: half, r: half / this.#limit }),
      svg('path', { d: `M0 ${half}H${size}M${half} 0V${size}` }),
    );
    const ends = [
      [6, half - 6, 'start'],
      [size - 6, half - 6, 'end'],
      [half - 6, size - 7, 'end'],
      [half - 6, 14, 'end'],
    ] as const;
    this.#ends.forEach((end, i) => {
      const [x, y, anchor] = ends[i] as (typeof ends)[number];
      set(end, { x, y, 'text-anchor': anchor });
    });
    this.#name();
    this.place(...this.#at);
  }

  /** Dots, and their names where there is room. */
  #name(): void {
    const { examples } = this.#source;
    // Hidden texts have no length to measure.
    for (const label of this.#labels) label.style.display = '';
    const words = this.#ends.map((end) => {
      const width = end.getComputedTextLength();
      const [x, y] = [Number(end.getAttribute('x')), Number(end.getAttribute('y'))];
      return { x: end.getAttribute('text-anchor') === 'end' ? x - width : x, y: y - LINE + 3, width, height: LINE };
    });
    const labels = examples.map(({ at }, i) => ({
      x: this.#x(at[0] ?? 0),
      y: this.#y(at[1] ?? 0),
      width: (this.#labels[i] as SVGTextElement).getComputedTextLength() + 2,
      height: LINE,
    }));
    const places = declutter(labels, words, this.#size, DOT + 3);
    examples.forEach(({ at }, i) => {
      set(this.#dots[i] as SVGCircleElement, { cx: this.#x(at[0] ?? 0), cy: this.#y(at[1] ?? 0) });
      const place = places[i];
      const label = this.#labels[i] as SVGTextElement;
      label.style.display = place ? '' : 'none';
      if (!place) return;
      set(label, { x: place.x + 1, y: place.y + LINE - 3.5 });
      if (place.near) return;
      // To the nearest point of the label's box.
      const { x, y, width, height } = labels[i] as Label;
      const x2 = Math.min(Math.max(x, place.x), place.x + width);
      const y2 = Math.min(Math.max(y, place.y + 2), place.y + height - 2);
      this.#lines.append(svg('line', { class: 'leader', x1: x, y1: y, x2, y2 }));
    });
  }
}

function isSideways(dx: number, dy: number): boolean {
  return Math.abs(dx) > 8 && Math.abs(dx) > Math.abs(dy);
}

function set(element: Element, attributes: Record<string, string | number>): void {
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
}
