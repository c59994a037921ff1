import { h } from '../../ui/dom.ts';
import type { Lesson } from './lesson.ts';
import { METHODS, type Method, type MethodId } from './methods.ts';

interface Tile {
  readonly method: Method;
  readonly button: HTMLButtonElement;
  readonly context: CanvasRenderingContext2D;
  readonly note: HTMLElement;
}

/** Small pictures of every method in the same pose; a click chooses the method. Drawn one by one while nothing else happens. */
export class Strip {
  readonly element: HTMLElement;
  readonly #lesson: Lesson;
  readonly #tiles: Tile[];
  #queue: Tile[] = [];
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(lesson: Lesson, choose: (id: MethodId) => void) {
    this.#lesson = lesson;
    this.#tiles = METHODS.map((method) => {
      const canvas = h('canvas', { width: 1, height: 1, 'aria-hidden': 'true' });
      const note = h('span', { class: 'tile-note', hidden: true }, 'not prepared');
      const button = h(
        'button',
        { type: 'button', class: 'tile', onclick: () => choose(method.id) },
        canvas,
        note,
        h('span', { class: 'tile-name' }, method.title),
      );
      button.dataset.method = method.id;
      return { method, button, note, context: canvas.getContext('2d') as CanvasRenderingContext2D };
    });
    this.element = h(
      'section',
      { class: 'strip', 'aria-label': 'Every method in the same pose' },
      ...this.#tiles.map(({ button }) => button),
    );
  }

  /** Marks what is chosen. */
  update(): void {
    for (const { method, button } of this.#tiles) {
      if (method.id === this.#lesson.method.id) button.setAttribute('aria-current', 'true');
      else button.removeAttribute('aria-current');
    }
  }

  /** Everything is to be drawn again, soon; what is chosen first, what takes long last. */
  refresh(): void {
    const { deformer } = this.#lesson;
    const rank = ({ method }: Tile) => (deformer?.isReady(method) ? 0 : method.kind === 'bounded' ? 2 : 1);
    this.#queue = [...this.#tiles].sort((a, b) => rank(a) - rank(b));
    this.#schedule();
  }

  /** Somebody does something: the rest has to wait. */
  pause(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }

  /** Whether all pictures show the pose as it is. */
  get isDone(): boolean {
    return this.#queue.length === 0;
  }

  #schedule(): void {
    this.#timer ??= setTimeout(() => requestAnimationFrame(() => this.#next()), 30);
  }

  #next(): void {
    this.#timer = undefined;
    const tile = this.#queue.shift();
    if (!tile) return;
    const { method, context, note, button } = tile;
    const ratio = Math.min(devicePixelRatio, 2);
    const box = context.canvas.getBoundingClientRect();
    const [width, height] = [Math.round(box.width * ratio), Math.round(box.height * ratio)];
    if (width > 0 && (context.canvas.width !== width || context.canvas.height !== height))
      [context.canvas.width, context.canvas.height] = [width, height];
    const prepared = method.family !== 'irbf' || this.#lesson.deformer?.isReady(method);
    note.hidden = Boolean(prepared);
    const drawn = prepared && width > 0 && this.#lesson.drawTile(method, context);
    if (!drawn) context.clearRect(0, 0, context.canvas.width, context.canvas.height);
    button.toggleAttribute('data-drawn', Boolean(drawn));
    this.element.toggleAttribute('data-done', this.isDone);
    if (!this.isDone) this.#schedule();
  }
}
