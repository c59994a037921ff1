import type { ColorMap } from '../../ui/color-map.ts';
import { h, write } from '../../ui/dom.ts';
import { onScreenChange } from '../../ui/screen.ts';
import type { Label } from './chart.ts';
import { FieldValues } from './field.ts';
import { type Board, Handles, type PointActions } from './handles.ts';
import { drawIsolines, levels } from './isolines.ts';
import type { Frame } from './samples.ts';
import { swatch } from './swatch.ts';

/** How points lie over a surface: parts of the picture from its upper left corner. */
export interface Relief {
  screen(i: number): readonly [across: number, down: number];
  /** The value at which point `i` would be seen at this height. */
  value(i: number, down: number): number;
}

/** What the plane asks for besides moving points. */
export interface FieldActions extends PointActions {
  setValue(i: number, value: number): void;
}

/** Where a section begins and ends, as parts of the picture from its upper left corner: x, y, x, y. */
export type Ends = readonly [number, number, number, number];

/** A function in the plane: a picture, its name, and the points over it. */
export class FieldPanel {
  readonly element: HTMLElement;
  readonly canvas = h('canvas');
  readonly area = h('div', { class: 'field-area' });
  readonly field = new FieldValues();
  readonly #handles: Handles;
  readonly #name = h('span', { class: 'name' });
  readonly #detail = h('span', { class: 'detail' });
  readonly #small = h('canvas');
  /** Where points lie over a surface; nothing over a map. */
  relief: Relief | undefined;
  readonly #left = new AbortController();
  #pixels: ImageData | undefined;
  #words: Uint32Array | undefined;
  /** Device pixels of a side. */
  #side = 0;
  #width = 0;

  /** The handles of the first one are those that the keyboard reaches. */
  constructor(first: boolean, frame: () => Frame, actions: FieldActions, resized: () => void) {
    const width = () => this.#width;
    const board: Board = {
      get size() {
        return [width(), width()] as const;
      },
      screen: (i) => {
        const [left, right, bottom, top] = frame();
        const [x, y] = actions.placeOf(i);
        if (this.relief) {
          const [across, down] = this.relief.screen(i);
          return [across * this.#width, down * this.#width];
        }
        return [((x - left) / (right - left)) * this.#width, ((top - y) / (top - bottom)) * this.#width];
      },
      place: (px, py) => {
        if (this.relief) return undefined;
        const [left, right, bottom, top] = frame();
        return [left + (px / this.#width) * (right - left), top - (py / this.#width) * (top - bottom)];
      },
      drag: (i, px, py) => {
        if (this.relief) return actions.setValue(i, this.relief.value(i, py / this.#width));
        const place = board.place(px, py);
        if (place) actions.move(i, ...place);
      },
      get spans() {
        const [left, right, bottom, top] = frame();
        return [right - left, top - bottom] as const;
      },
    };
    this.#handles = new Handles(this.area, board, actions, !first);
    this.area.prepend(this.canvas);
    this.element = h(
      'figure',
      { class: 'field' },
      this.area,
      h('figcaption', {}, swatch(0), h('span', {}, this.#name, ' ', this.#detail)),
    );
    onScreenChange(this.area, () => this.measure() && resized(), this.#left.signal);
  }

  /** Takes the size that the page gives, and the pixels that the screen has for it; whether they are others. */
  measure(): boolean {
    const width = this.area.clientWidth;
    const side = Math.round(width * devicePixelRatio);
    if ((width === this.#width && side === this.#side) || width === 0) return false;
    [this.#width, this.#side] = [width, side];
    this.canvas.width = this.canvas.height = side;
    return true;
  }

  get side(): number {
    return this.#side;
  }

  /** Of the processor's, not the graphics card's: many short lines come out several times sooner, most of all where there is no card. */
  get context(): CanvasRenderingContext2D {
    return this.canvas.getContext('2d', { willReadFrequently: true }) as CanvasRenderingContext2D;
  }

  name({ name, detail }: Label, slot: number, key: number): void {
    this.element.dataset.key = String(key);
    write(this.#name, name);
    write(this.#detail, detail);
    const path = this.element.querySelector<SVGElement>('.swatch path');
    if (path) path.dataset.slot = String(slot);
  }

  set stale(stale: boolean) {
    this.element.toggleAttribute('data-stale', stale);
  }

  /** Colors, lines of equal value, and where the section runs. */
  paint(size: number, colors: ColorMap, isolines: boolean, section: Ends | undefined): void {
    const context = this.context;
    const { values } = this.field;
    if (this.#pixels?.width !== size) {
      this.#small.width = this.#small.height = size;
      this.#pixels = new ImageData(size, size);
      this.#words = new Uint32Array(this.#pixels.data.buffer);
    }
    const words = this.#words as Uint32Array;
    for (let i = 0; i < values.length; i++) words[i] = colors.packed(values[i] as number);
    this.#small.getContext('2d', { willReadFrequently: true })?.putImageData(this.#pixels as ImageData, 0, 0);
    context.imageSmoothingQuality = 'high';
    context.clearRect(0, 0, this.#side, this.#side);
    context.drawImage(this.#small, 0, 0, this.#side, this.#side);
    context.lineWidth = Math.max(1, devicePixelRatio * 0.9);
    if (isolines) {
      const at = levels(colors.low, colors.high, values);
      drawIsolines(context, values, size, this.#side, at, (level) =>
        colors.isLight(level) ? 'rgb(0 0 0 / 42%)' : 'rgb(255 255 255 / 55%)',
      );
    }
    if (section) this.#rule(context, section);
  }

  points(values: readonly number[], colors: ColorMap, outliers: readonly number[] = []): void {
    this.#handles.draw();
    for (let i = 0; i < values.length; i++) {
      const handle = this.#handles.element(i);
      handle?.style.setProperty('--fill', colors.css(values[i] as number));
      handle?.toggleAttribute('data-outlier', outliers.includes(i));
    }
  }

  dispose(): void {
    this.#left.abort();
    this.element.remove();
  }

  #rule(context: CanvasRenderingContext2D, [ax, ay, bx, by]: Ends): void {
    const side = this.#side;
    for (const [color, width] of [
      ['rgb(0 0 0 / 55%)', 3],
      ['#fff', 1.25],
    ] as const) {
      context.beginPath();
      context.moveTo(ax * side, ay * side);
      context.lineTo(bx * side, by * side);
      context.strokeStyle = color;
      context.lineWidth = width * devicePixelRatio;
      context.setLineDash([6 * devicePixelRatio, 4 * devicePixelRatio]);
      context.stroke();
    }
    context.setLineDash([]);
  }
}
