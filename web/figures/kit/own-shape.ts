import { simplify, withoutRepeats } from '../../models/resample.ts';
import { centered, checkShape, type Shape } from '../../models/shape.ts';
import { button, h, svg } from '../../ui/dom.ts';
import { lazy } from '../../ui/lazy.ts';
import type { Kit, OpenPanel, Panel } from './figure.ts';
import { portable } from './outline.ts';
import type { PaintedShape } from './shape-picture.ts';

/** Only who opens a picture needs what traces it. */
const picturePart = lazy(() => import('./open-picture.ts'), 'The part of this page that opens pictures');

/** What a figure makes of an outline, and of the picture that it was taken from. */
type Take<S> = (outline: Shape, painted?: PaintedShape) => Partial<S>;

interface Drawing {
  /** Whether an outline of one's own is being drawn. */
  readonly draw: boolean;
}

/** All on the page that would take a file. */
const takers = new Set<{ readonly figure: Element | null }>();

/** An outline of one's own over the picture: drawn in one stroke, typed, or taken from a picture, which may be dropped anywhere. */
export function ownShape<M, S extends Drawing>(take: Take<S>): Panel<M, S> {
  return { open: (kit) => new OwnShape(kit, take) };
}

class OwnShape<M, S extends Drawing> implements OpenPanel<M, S> {
  readonly element: HTMLElement;
  readonly #kit: Kit<S>;
  readonly #accept: Take<S>;
  readonly #path = svg('path');
  readonly #typed = h('textarea', {
    rows: 4,
    'aria-label': 'Outline as numbers, x y of each point',
    placeholder: '0 1\n0.9 -0.6\n-0.9 -0.6',
  });
  readonly #file = h('input', {
    type: 'file',
    class: 'unseen',
    tabindex: -1,
    'aria-label': 'Picture',
    accept: 'image/png,image/svg+xml,image/webp,.png,.svg',
  });
  /** While a file is over the page. */
  readonly #veil = h('div', { class: 'veil' }, h('p', {}, 'Drop a PNG or SVG with transparency'));
  readonly #left = new AbortController();
  #points: number[] = [];
  #pointer = -1;
  /** The file that was opened last. */
  #opened: File | undefined;

  constructor(kit: Kit<S>, take: Take<S>) {
    [this.#kit, this.#accept] = [kit, take];
    const sheet = h('div', { class: 'sheet' }, svg('svg', { 'aria-hidden': 'true' }, this.#path));
    this.element = h(
      'div',
      { class: 'own' },
      sheet,
      h(
        'div',
        { class: 'own-words stack' },
        h('p', {}, h('strong', {}, 'Draw an outline here, in one stroke.'), ' It closes by itself.'),
        h(
          'div',
          { class: 'tools' },
          button('Open a PNG or SVG', () => this.#file.click()),
          button('Cancel', () => this.#cancel()),
        ),
        h(
          'details',
          {},
          h('summary', {}, 'Type it instead'),
          h('p', { class: 'soft' }, 'x and y of a point on each line; an empty line begins a hole.'),
          this.#typed,
          button('Use these points', () => this.#takeTyped()),
        ),
      ),
      this.#file,
    );
    sheet.addEventListener('pointerdown', (event) => this.#begin(event, sheet));
    sheet.addEventListener('pointermove', (event) => this.#follow(event, sheet));
    sheet.addEventListener('pointerup', (event) => this.#end(event));
    sheet.addEventListener('pointercancel', () => this.#clear());
    this.#listen(this.#left.signal);
  }

  draw(_: M, { draw }: S): void {
    this.element.hidden = !draw;
  }

  get figure(): Element | null {
    return this.element.closest('.figure');
  }

  dispose(): void {
    this.#left.abort();
    takers.delete(this);
    this.#veil.remove();
  }

  #listen(signal: AbortSignal): void {
    this.#file.addEventListener('change', () => {
      const file = this.#file.files?.[0];
      // The same file may be chosen again.
      this.#file.value = '';
      this.#open(file);
    });
    takers.add(this);
    addEventListener('keydown', (event) => event.key === 'Escape' && isIn(event, this.figure) && this.#cancel(), { signal });
    addEventListener(
      'dragover',
      (event) => {
        this.#veil.remove();
        if (!this.#takes(event)) return;
        event.preventDefault();
        this.element.after(this.#veil);
      },
      { signal },
    );
    addEventListener('dragleave', (event) => event.relatedTarget || this.#veil.remove(), { signal });
    addEventListener(
      'drop',
      (event) => {
        this.#veil.remove();
        if (!this.#takes(event)) return;
        event.preventDefault();
        this.#open(event.dataTransfer?.files[0]);
      },
      { signal },
    );
  }

  /** A file that the page itself does not take is for the figure under it; elsewhere for the one that has the focus, or the only one. */
  #takes(event: DragEvent): boolean {
    if (event.defaultPrevented || !event.dataTransfer?.types.includes('Files')) return false;
    const { figure } = this;
    if (isIn(event, figure)) return true;
    const others = [...takers].filter((taker) => taker !== this);
    const isFree = !others.some((other) => isIn(event, other.figure));
    return isFree && (others.length === 0 || figure?.matches(':focus-within') === true);
  }

  #open(file: File | undefined): void {
    this.#opened = file;
    if (!file) return;
    this.#kit.wait('Tracing the picture…', async () => {
      const { openPicture } = await picturePart(this.#kit.address);
      const { outline, painting } = await openPicture(file);
      // Unless another one was opened meanwhile.
      if (this.#opened === file) this.#show(outline, painting);
    });
  }

  /** Two units large. */
  #show(outline: Shape, painted?: PaintedShape): void {
    this.#clear();
    this.#kit.change({ ...this.#accept(portable(outline), painted), draw: false });
  }

  /** The choice of a shape says again what is shown. */
  #cancel(): void {
    if (!this.#kit.state.draw) return;
    const isFocused = this.element.matches(':focus-within');
    this.#clear();
    this.#kit.change({ draw: false } as Partial<S>);
    if (isFocused) this.element.closest('.figure')?.querySelector<HTMLElement>('.choices input:checked')?.focus();
  }

  #begin(event: PointerEvent, sheet: HTMLElement): void {
    if (event.button !== 0 || this.#pointer >= 0) return;
    event.preventDefault();
    this.#clear();
    this.#pointer = event.pointerId;
    sheet.setPointerCapture(event.pointerId);
    this.#add(event, sheet);
  }

  #follow(event: PointerEvent, sheet: HTMLElement): void {
    if (event.pointerId !== this.#pointer) return;
    for (const each of event.getCoalescedEvents?.() ?? [event]) this.#add(each, sheet);
  }

  #add(event: PointerEvent, sheet: HTMLElement): void {
    const box = sheet.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    const [px = -1e9, py = -1e9] = this.#points.slice(-2);
    if (Math.hypot(x - px, y - py) < 3) return;
    this.#points.push(x, y);
    this.#path.setAttribute('d', `M${this.#points.join(' ')}`);
  }

  #end(event: PointerEvent): void {
    if (event.pointerId !== this.#pointer) return;
    this.#pointer = -1;
    this.#path.setAttribute('d', `M${this.#points.join(' ')}Z`);
    const ring = simplify(
      Float64Array.from(this.#points, (value, i) => (i % 2 === 0 ? value : -value)),
      1.5,
    );
    this.#take([ring.length >= 6 ? rounded(rounded(ring)) : ring]);
  }

  #takeTyped(): void {
    const rings = this.#typed.value.trim().split(/\n\s*\n/);
    this.#take(
      rings.map((ring) =>
        Float64Array.from(
          ring.split(/[\s,;]+/).filter((word) => word !== ''),
          Number,
        ),
      ),
    );
  }

  #take(rings: Shape): void {
    try {
      const shape = rings.map(withoutRepeats);
      checkShape(shape);
      this.#show(centered(shape, 2).shape);
    } catch (error) {
      this.#kit.tell(error);
    }
  }

  #clear(): void {
    this.#points = [];
    this.#pointer = -1;
    this.#path.setAttribute('d', '');
  }
}

/** In an element, too, whose inside the page does not see. */
function isIn(event: Event, figure: Element | null): boolean {
  return figure !== null && event.composedPath().includes(figure);
}

/** A closed line with its corners cut at a quarter (Chaikin). */
function rounded(ring: Float64Array): Float64Array {
  const n = ring.length / 2;
  const out = new Float64Array(4 * n);
  for (let i = 0; i < n; i++) {
    const j = (i + 1) % n;
    for (const k of [0, 1]) {
      const [a, b] = [ring[2 * i + k] as number, ring[2 * j + k] as number];
      out[4 * i + k] = 0.75 * a + 0.25 * b;
      out[4 * i + 2 + k] = 0.25 * a + 0.75 * b;
    }
  }
  return out;
}
