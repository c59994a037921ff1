import { h } from '../../ui/dom.ts';
import { draggable, type Grip } from '../../ui/drag.ts';
import { focusNeighbor } from '../../ui/focus.ts';
import { putHandle } from '../../ui/put-handle.ts';

/** Where handles lie and what moving them means; places are two numbers, on the picture's axes. */
export interface Board {
  /** Width and height of the area, pixels. */
  readonly size: readonly [number, number];
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
  /** Adds to the value of a point, in hundredths of the values' range, where that is not its place. */
  raise(i: number, hundredths: number): void;
  pick(i: number): void;
  addAt(across: number, up: number): void;
  remove(i: number): void;
  /** "Point 3, x 2.5, value 0.4" */
  describe(i: number): string;
}

const STEP = 0.01;

/** One handle a point: dragged by mouse, finger or pen, moved by the keyboard. */
export class Handles {
  readonly #area: HTMLElement;
  readonly #board: Board;
  readonly #actions: PointActions;
  readonly #silent: boolean;
  readonly #handles: HTMLButtonElement[] = [];

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
  }

  element(i: number): HTMLButtonElement | undefined {
    return this.#handles[i];
  }

  draw(): void {
    const { count, picked } = this.#actions;
    while (this.#handles.length > count) this.#handles.pop()?.remove();
    while (this.#handles.length < count) this.#make(this.#handles.length);
    const [width, height] = this.#board.size;
    for (let i = 0; i < count; i++) {
      const handle = this.#handles[i] as HTMLButtonElement;
      putHandle(handle, ...this.#board.screen(i), width, height);
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
    handle.addEventListener('focus', () => this.#actions.pick(i));
    draggable(handle, this.#grip(i));
    this.#handles.push(handle);
    this.#area.append(handle);
  }

  #grip(i: number): Grip {
    const [actions, board] = [this.#actions, this.#board];
    return {
      hold: () => actions.hold(i),
      drag: (x, y) => {
        const box = this.#area.getBoundingClientRect();
        board.drag(i, x - box.left, y - box.top);
      },
      nudge: (across, up, toward) => {
        const [x, y] = actions.placeOf(i);
        const [wide, tall] = board.spans;
        if (toward === 0) actions.move(i, x + across * wide * STEP, y + up * tall * STEP);
        else actions.raise(i, toward);
      },
      pick: () => actions.pick(i),
      remove: () => {
        actions.remove(i);
        // The last handle goes with the next frame.
        focusNeighbor(this.#handles.slice(0, actions.count), i);
      },
    };
  }
}
