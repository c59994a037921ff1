import { h, match, readable, svg, write } from '../../ui/dom.ts';
import { onScreenChange } from '../../ui/screen.ts';
import { curvePath, spreadLabels } from './path.ts';
import type { Frame } from './samples.ts';
import { axisMarks } from './scale.ts';

export interface Label {
  readonly name: string;
  /** What tells it from others of its name; may be empty. */
  readonly detail: string;
}

/** A curve as the chart draws it. */
export interface Curve {
  /** By which it is emphasized. */
  readonly key: number;
  readonly slot: number;
  readonly label: Label;
  readonly xs: Float64Array;
  /** One number a place. */
  readonly ys: Float64Array;
  /** Not of the present data, because those were refused. */
  readonly stale?: boolean;
  /** Dashed in any case: the sum of what is drawn below it. */
  readonly sum?: boolean;
}

/** From this width on there is room for names beside the ends of curves. */
const ROOMY = 640;
const NAMES = 184;
const LINE = 15;

let nextChart = 1;

/** Curves over a line, with axes: sharp at any size, colors and dashes by style sheet. */
export class Chart {
  readonly element: HTMLElement;
  /** Lies exactly over the part with the curves: handles go here. */
  readonly area = h('div', { class: 'chart-area' });
  /** Drawings below and above the curves, in pixels of the area. */
  readonly under = svg('g', { class: 'under' });
  readonly over = svg('g', { class: 'over' });
  /** Width and height of the area, pixels. */
  width = 0;
  height = 0;
  #frame: Frame = [0, 1, 0, 1];
  readonly #svg = svg('svg', { 'aria-hidden': 'true' });
  readonly #grid = svg('g', { class: 'grid' });
  readonly #curves = svg('g', { class: 'curves' });
  readonly #names = svg('g', { class: 'names' });
  readonly #clip = svg('rect', { x: 0, y: 0 });
  readonly #inner = svg('g');
  readonly #left = new AbortController();
  readonly #withNames: boolean;
  #size: readonly [number, number] = [0, 0];
  #nameless = false;

  constructor(names: boolean, onResize: () => void) {
    this.#withNames = names;
    const id = `clip-${nextChart++}`;
    this.#inner.append(
      this.#grid,
      svg('clipPath', { id }, this.#clip),
      svg('g', { 'clip-path': `url(#${id})` }, this.under, this.#curves, this.over),
      this.#names,
    );
    this.#svg.append(this.#inner);
    this.element = h('div', { class: 'chart' }, this.#svg, this.area);
    onScreenChange(this.element, () => this.measure() && onResize(), this.#left.signal);
  }

  /** Leaves no listener behind. */
  dispose(): void {
    this.#left.abort();
    this.element.remove();
  }

  /** Takes the size that the page gives; whether it is another one. */
  measure(): boolean {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || (width === this.#size[0] && height === this.#size[1])) return false;
    this.#size = [width, height];
    this.#layout();
    return true;
  }

  /** Whether names stand beside the curves: elsewhere a legend is due. */
  get named(): boolean {
    return this.#withNames && !this.#nameless;
  }

  get frame(): Frame {
    return this.#frame;
  }

  set frame(frame: Frame) {
    if (frame.every((edge, i) => edge === this.#frame[i])) return;
    this.#frame = frame;
    this.#axes();
  }

  /** Pixels of the area for a place on the axes. */
  x(value: number): number {
    const [left, right] = this.#frame;
    return ((value - left) / (right - left)) * this.width;
  }

  y(value: number): number {
    const [, , bottom, top] = this.#frame;
    return ((top - value) / (top - bottom)) * this.height;
  }

  /** The inverse: a place on the axes for pixels of the area. */
  at(px: number, py: number): [number, number] {
    const [left, right, bottom, top] = this.#frame;
    return [left + (px / this.width) * (right - left), top - (py / this.height) * (top - bottom)];
  }

  draw(curves: readonly Curve[]): void {
    if (this.width === 0 && !this.measure()) return;
    match(this.#curves, curves.length, () => svg('path'));
    curves.forEach((curve, i) => {
      const path = this.#curves.children[i] as SVGPathElement;
      mark(path, curve);
      path.setAttribute('d', this.path(curve.xs, curve.ys));
    });
    this.#drawNames(curves);
  }

  path(xs: Float64Array, ys: ArrayLike<number>): string {
    const [left, right, bottom, top] = this.#frame;
    const [ax, ay] = [this.width / (right - left), this.height / (bottom - top)];
    return curvePath(xs, ys, [ax, -left * ax, ay, -top * ay]);
  }

  #drawNames(curves: readonly Curve[]): void {
    match(this.#names, this.named ? curves.length : 0, () =>
      svg(
        'g',
        {},
        svg('path'),
        svg('text', { x: 18 }, svg('tspan', { class: 'name' }), svg('tspan', { class: 'detail', x: 18, dy: LINE })),
      ),
    );
    if (!this.named) return;
    const ends = curves.map(({ ys }) => {
      const y = this.y(ys.at(-1) ?? 0);
      return Number.isNaN(y) ? this.height / 2 : Math.min(Math.max(y, 6), this.height - 6);
    });
    const gaps = curves.map(({ label }) => (label.detail ? 2 * LINE + 4 : LINE + 4));
    const places = spreadLabels(ends, gaps, -8, this.height + 8);
    curves.forEach((curve, i) => {
      const group = this.#names.children[i] as SVGGElement;
      mark(group, curve);
      const [leader, text] = [group.children[0] as SVGPathElement, group.children[1] as SVGTextElement];
      const [name, detail] = [text.children[0] as SVGTSpanElement, text.children[1] as SVGTSpanElement];
      group.setAttribute('transform', `translate(${this.width} 0)`);
      const [end, place] = [ends[i] as number, places[i] as number];
      leader.setAttribute('d', `M2 ${end.toFixed(1)}L14 ${place.toFixed(1)}`);
      text.setAttribute('y', (place + 4 - (curve.label.detail ? LINE / 2 : 0)).toFixed(1));
      write(name, brief(curve.label.name, 23));
      write(detail, brief(curve.label.detail, 28));
    });
  }

  #layout(): void {
    const [width, height] = this.#size;
    this.#nameless = width < ROOMY;
    const [left, right, top, bottom] = [40, this.named ? NAMES : 14, 12, 28];
    this.width = Math.max(width - left - right, 1);
    this.height = Math.max(height - top - bottom, 1);
    this.#svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    this.#inner.setAttribute('transform', `translate(${left} ${top})`);
    this.#clip.setAttribute('width', String(this.width));
    this.#clip.setAttribute('height', String(this.height));
    // On paper all of it is scaled as it is, by the style sheet: so in parts, not in pixels.
    this.element.style.setProperty('--shape', `${this.element.offsetWidth} / ${this.element.offsetHeight}`);
    const part = (pixels: number, of: number) => `${((100 * pixels) / of).toFixed(4)}%`;
    this.area.style.inset = `${part(top, height)} ${part(right, width)} ${part(bottom, height)} ${part(left, width)}`;
    this.#axes();
  }

  #axes(): void {
    if (this.width <= 0) return;
    const [left, right, bottom, top] = this.#frame;
    const across = axisMarks(left, right, this.width / 80);
    const up = axisMarks(bottom, top, this.height / 48);
    const lines = up.at.map((value) => {
      const y = this.y(value).toFixed(1);
      return svg('path', { d: `M0 ${y}H${this.width}`, ...(Math.abs(value) < 1e-12 && { class: 'zero' }) });
    });
    const numbers = [
      ...up.at.map((value) =>
        svg('text', { x: -9, y: (this.y(value) + 4).toFixed(1), 'text-anchor': 'end' }, readable(value, up.digits)),
      ),
      ...across.at.map((value) =>
        svg('text', { x: this.x(value).toFixed(1), y: this.height + 20, 'text-anchor': 'middle' }, readable(value, across.digits)),
      ),
    ];
    const ticks = across.at.map((value) => svg('path', { class: 'tick', d: `M${this.x(value).toFixed(1)} ${this.height}v5` }));
    const base = svg('path', { class: 'base', d: `M0 ${this.height}H${this.width}` });
    this.#grid.replaceChildren(...lines, base, ...ticks, ...numbers);
  }
}

/** A text, shortened to what has room beside a curve. */
function brief(text: string, most: number): string {
  return text.length > most ? `${text.slice(0, most - 1).trimEnd()}…` : text;
}

function mark(element: SVGElement, { key, slot, stale, sum }: Curve): void {
  element.dataset.key = String(key);
  element.dataset.slot = String(slot);
  element.toggleAttribute('data-stale', !!stale);
  element.toggleAttribute('data-sum', !!sum);
}
