import { h } from '../../ui/dom.ts';

/** Where handles lie and what moving them means; places are two numbers, on the picture's axes. */
export interface Board {
  /** Pixels of the area for point `i`. */
  screen(i: number): readonly [number, number];
  /** A place for pixels of the area; nothing where the picture has no one place for them. */
  place(px: number, py: number): readonly [number, number] | undefined;
  /** Brings point `i` to pixels of the area. */
  drag(i: number, px: number, py: number): void;
  /** Extent of both axes: a hundredth is a step of the keyboard. */
  readonly spans: readonly [number, number];
}

/** What happens to points. */
export interface PointActions {
  readonly count: number;
  readonly picked: number;
  placeOf(i: number): readonly [number, number];
  move(i: number, across: number, up: number): void;
  /** What puts point `i` back to where it is now. */
  hold(i: number): () => void;
  /** Adds to the value of a point, in hundredths of the values' range; only where that is not its place. */
  raise?(i: number, hundredths: number): void;
  pick(i: number): void;
  addAt(across: number, up: number): void;
  remove(i: number): void;
  /** "Point 3, x 2.5, value 0.4" */
  describe(i: number): string;
  /** A drag or a keystroke is over. */
  settle(): void;
}

const STEP = 0.01;

/** One handle a point: dragged by mouse, finger or pen, moved by the keyboard. */
export class Handles {
  readonly #area: HTMLElement;
  readonly #board: Board;
  readonly #actions: PointActions;
  readonly #silent: boolean;
  readonly #handles: HTMLButtonElement[] = [];
  #drag: { i: number; pointer: number; back: () => void; dx: number; dy: number } | undefined;
  /** The point that the keyboard took hold of. */
  #before: { i: number; back: () => void } | undefined;

  /** `silent` handles are for pointers only: copies of others that the keyboard reaches. */
  constructor(area: HTMLElement, board: Board, actions: PointActions, silent = false) {
    this.#area = area;
    this.#board = board;
    this.#actions = actions;
    this.#silent = silent;
    area.addEventListener('dblclick', (event) => {
      if (event.target !== area) return;
      const box = area.getBoundingClientRect();
      const place = board.place(event.clientX - box.left, event.clientY - box.top);
      if (place) actions.addAt(...place);
    });
    document.addEventListener('keydown', this.#escape, { capture: true });
  }

  dispose(): void {
    document.removeEventListener('keydown', this.#escape, { capture: true });
  }

  element(i: number): HTMLButtonElement | undefined {
    return this.#handles[i];
  }

  draw(): void {
    const { count, picked } = this.#actions;
    while (this.#handles.length > count) this.#handles.pop()?.remove();
    while (this.#handles.length < count) this.#make(this.#handles.length);
    for (let i = 0; i < count; i++) {
      const handle = this.#handles[i] as HTMLButtonElement;
      const [x, y] = this.#board.screen(i);
      handle.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
      handle.toggleAttribute('data-picked', i === picked);
      if (!this.#silent) handle.ariaLabel = this.#actions.describe(i);
    }
  }

  #make(i: number): void {
    const handle = h('button', { type: 'button', class: 'point' });
    if (this.#silent) {
      handle.tabIndex = -1;
      handle.ariaHidden = 'true';
    } else {
      handle.setAttribute('aria-roledescription', 'movable point');
      handle.setAttribute('aria-keyshortcuts', 'ArrowLeft ArrowRight ArrowUp ArrowDown PageUp PageDown Delete Escape');
    }
    handle.dataset.point = String(i);
    handle.addEventListener('pointerdown', (event) => this.#begin(event, i));
    handle.addEventListener('pointermove', (event) => this.#follow(event));
    for (const type of ['pointerup', 'pointercancel', 'lostpointercapture'] as const)
      handle.addEventListener(type, (event) => this.#end(event.pointerId));
    handle.addEventListener('focus', () => this.#actions.pick(i));
    handle.addEventListener('blur', () => {
      this.#before = undefined;
    });
    handle.addEventListener('keydown', (event) => this.#key(event, i));
    this.#handles.push(handle);
    this.#area.append(handle);
  }

  #begin(event: PointerEvent, i: number): void {
    if (event.button !== 0 || this.#drag) return;
    const handle = this.#handles[i] as HTMLButtonElement;
    handle.setPointerCapture(event.pointerId);
    handle.toggleAttribute('data-dragging', true);
    const box = this.#area.getBoundingClientRect();
    const [x, y] = this.#board.screen(i);
    // The point stays under the finger where it was taken, off its middle by so much.
    this.#drag = {
      i,
      pointer: event.pointerId,
      back: this.#actions.hold(i),
      dx: event.clientX - box.left - x,
      dy: event.clientY - box.top - y,
    };
    this.#actions.pick(i);
  }

  #follow(event: PointerEvent): void {
    const drag = this.#drag;
    if (drag?.pointer !== event.pointerId) return;
    const box = this.#area.getBoundingClientRect();
    this.#board.drag(drag.i, event.clientX - box.left - drag.dx, event.clientY - box.top - drag.dy);
  }

  #end(pointer: number): void {
    if (this.#drag?.pointer !== pointer) return;
    this.#handles[this.#drag.i]?.toggleAttribute('data-dragging', false);
    this.#drag = undefined;
    this.#actions.settle();
  }

  readonly #escape = (event: KeyboardEvent): void => {
    if (event.key !== 'Escape' || !this.#drag) return;
    const { back, pointer } = this.#drag;
    this.#end(pointer);
    back();
    this.#actions.settle();
    event.stopPropagation();
  };

  #key(event: KeyboardEvent, i: number): void {
    const actions = this.#actions;
    const [across, up] = actions.placeOf(i);
    const [wide, tall] = this.#board.spans;
    const step = event.shiftKey ? STEP / 10 : STEP;
    const moves: Record<string, () => void> = {
      ArrowLeft: () => actions.move(i, across - wide * step, up),
      ArrowRight: () => actions.move(i, across + wide * step, up),
      ArrowDown: () => actions.move(i, across, up - tall * step),
      ArrowUp: () => actions.move(i, across, up + tall * step),
      PageDown: () => actions.move(i, across, up - tall * 10 * STEP),
      PageUp: () => actions.move(i, across, up + tall * 10 * STEP),
    };
    if (actions.raise) {
      moves['+'] = () => actions.raise?.(i, 1);
      moves['='] = moves['+'];
      moves['-'] = () => actions.raise?.(i, -1);
    }
    const move = moves[event.key];
    if (move && !event.ctrlKey && !event.metaKey && !event.altKey) {
      if (this.#before?.i !== i) this.#before = { i, back: actions.hold(i) };
      move();
    } else if (event.key === 'Escape' && this.#before?.i === i) {
      this.#before.back();
      this.#before = undefined;
    } else if (event.key === 'Delete' || event.key === 'Backspace') {
      actions.remove(i);
      this.#handles[Math.min(i, this.#handles.length - 1)]?.focus();
    } else {
      return;
    }
    event.preventDefault();
    actions.settle();
  }
}
