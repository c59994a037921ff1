import { simplify, withoutRepeats } from '../../models/resample.ts';
import { centered, checkShape, type Shape } from '../../models/shape.ts';
import { h, svg } from '../../ui/dom.ts';

interface OwnActions {
  /** A sound outline, two units large: the sheet stays open until it is hidden. */
  take(outline: Shape): void;
  open(): void;
  /** Nobody wants it any more. */
  cancel(): void;
  trouble(error: unknown): void;
}

/** An outline of one's own over the picture: drawn in one stroke, typed, or taken from a picture. */
export class OwnShape {
  readonly element: HTMLElement;
  readonly #actions: OwnActions;
  readonly #path = svg('path');
  readonly #typed = h('textarea', {
    rows: 4,
    'aria-label': 'Outline as numbers, x y of each point',
    placeholder: '0 1\n0.9 -0.6\n-0.9 -0.6',
  });
  #points: number[] = [];
  #pointer = -1;

  constructor(actions: OwnActions) {
    this.#actions = actions;
    const sheet = h('div', { class: 'sheet' }, svg('svg', { 'aria-hidden': 'true' }, this.#path));
    this.element = h(
      'div',
      { class: 'own', hidden: true },
      sheet,
      h(
        'div',
        { class: 'own-words' },
        h('p', {}, h('strong', {}, 'Draw an outline here, in one stroke.'), ' It closes by itself.'),
        h(
          'div',
          { class: 'own-buttons' },
          h('button', { type: 'button', class: 'button small', id: 'open', onclick: () => actions.open() }, 'Open a PNG or SVG'),
          h('button', { type: 'button', class: 'button small', onclick: () => this.cancel() }, 'Cancel'),
        ),
        h(
          'details',
          {},
          h('summary', {}, 'Type it instead'),
          h('p', { class: 'soft small' }, 'x and y of a point on each line; an empty line begins a hole.'),
          this.#typed,
          h(
            'button',
            { type: 'button', class: 'button small', id: 'use-typed', onclick: () => this.#takeTyped() },
            'Use these points',
          ),
        ),
      ),
    );
    sheet.addEventListener('pointerdown', (event) => this.#begin(event, sheet));
    sheet.addEventListener('pointermove', (event) => this.#follow(event, sheet));
    sheet.addEventListener('pointerup', (event) => this.#end(event));
    sheet.addEventListener('pointercancel', () => this.#clear());
    this.element.addEventListener('keydown', (event) => {
      if (event.key === 'Escape') this.cancel();
    });
  }

  show(): void {
    this.#clear();
    // The focus stays with the choice: arrow keys go on from there.
    this.element.hidden = false;
  }

  hide(): void {
    this.element.hidden = true;
  }

  cancel(): void {
    if (!this.element.hidden) this.#actions.cancel();
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
      this.#actions.take(centered(shape, 2).shape);
    } catch (error) {
      this.#actions.trouble(error);
    }
  }

  #clear(): void {
    this.#points = [];
    this.#pointer = -1;
    this.#path.setAttribute('d', '');
  }
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
