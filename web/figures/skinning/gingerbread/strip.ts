import { h } from '../../ui/dom.ts';
import type { Lesson } from './lesson.ts';
import { METHODS, type Method, type MethodId } from './methods.ts';

interface Entry {
  readonly method: Method;
  readonly button: HTMLButtonElement;
  readonly context: CanvasRenderingContext2D;
  readonly note: HTMLElement;
}

/** Small pictures of every method in the same pose; a click chooses the method. Drawn while nothing else happens. */
export class Strip {
  readonly element: HTMLElement;
  readonly #lesson: Lesson;
  readonly #tiles: Entry[];
  #queue: Entry[] = [];
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
    const rank = ({ method }: Entry) => (deformer?.isReady(method) ? 0 : method.kind === 'bounded' ? 2 : 1);
    this.element.toggleAttribute('data-done', false);
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
    this.#lesson.drawTiles(() => {
      for (let tile = this.#queue.shift(); tile; tile = this.#queue.shift()) {
        const { method, context, note } = tile;
        const prepared = this.#lesson.deformer?.isOffered(method) === true;
        note.hidden = prepared || method.family !== 'irbf';
        if (sized(context.canvas) && prepared) return { method, context, done: (drawn) => show(tile, drawn) };
        show(tile, false);
      }
      return undefined;
    });
    this.element.toggleAttribute('data-done', this.isDone);
    if (!this.isDone) this.#schedule();
  }
}

function show({ context, button }: Entry, drawn: boolean): void {
  if (!drawn) context.clearRect(0, 0, context.canvas.width, context.canvas.height);
  button.toggleAttribute('data-drawn', drawn);
}

/** Gives a canvas the pixels that it is laid out with; says whether there are any. */
function sized(canvas: HTMLCanvasElement): boolean {
  const ratio = Math.min(devicePixelRatio, 2);
  const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  return width > 0 && height > 0;
}
