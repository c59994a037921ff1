import { h } from '../../ui/dom.ts';
import { draggable, type Grip } from '../../ui/drag.ts';
import { focusNeighbor } from '../../ui/focus.ts';
import { putHandle } from '../../ui/put-handle.ts';
import { describe, endOf, type Handle, movedTo, type Place, placed, placeOf, resting, turnedTo } from './plane-handles.ts';
import type { ShapePicture } from './shape-picture.ts';

/** Part of the picture's height for a step of the keyboard. */
const STEP = 0.01;
/** Degrees for a key, or a notch of the wheel. */
const TURN_STEP = 5;
/** Pixels from a handle to the knob that turns it. */
const KNOB = 38;

const KEYS = 'ArrowLeft ArrowRight ArrowUp ArrowDown PageUp PageDown Q E Shift+Q Shift+E Home Delete Escape';

/** Handles, and what hears that they change: none is changed in place. */
export interface Held {
  readonly handles: readonly Handle[];
  /** As they are drawn, on their way to a pose. */
  readonly shown: readonly Handle[];
  readonly picked: number;
  /** Handles are placed, not posed: where they go, there they rest. */
  readonly places?: boolean;
  change(handles: readonly Handle[], picked: number): void;
}

interface Item {
  readonly move: HTMLButtonElement;
  readonly end: HTMLButtonElement;
  readonly line: HTMLElement;
}

/** Handles over a shape: dragged by mouse, finger or pen, turned by a knob, a second finger or the wheel, moved by the keyboard. */
export class ShapeHandles {
  readonly element = h('div', { class: 'overlay' });
  readonly #picture: ShapePicture;
  /** What adds handles gets the focus when there is none left. */
  readonly #adds: HTMLElement;
  readonly #items: Item[] = [];
  readonly #knob = h('span', { class: 'knob', 'aria-hidden': 'true' });
  /** A handle that asks to be taken, until one is. */
  #invites = 2;
  #held: Held = { handles: [], shown: [], picked: -1, change: () => {} };

  constructor(picture: ShapePicture, adds: HTMLElement) {
    [this.#picture, this.#adds] = [picture, adds];
    draggable(this.#knob, {
      hold: () => this.#hold(this.#held.picked),
      drag: (x, y) => this.#turnTo(this.#held.picked, x, y),
    });
    this.element.append(this.#knob);
  }

  get held(): Held {
    return this.#held;
  }

  /** Other handles, drawn at once: what is listened to next has to know them. */
  set(handles: readonly Handle[], picked: number): void {
    const next = this.#held.places
      ? handles.map((handle, i) => (handle === this.#held.handles[i] ? handle : placed(handle)))
      : handles;
    this.draw({ ...this.#held, handles: next, shown: next, picked });
    this.#held.change(next, picked);
  }

  focus(i: number): void {
    this.#items[i]?.move.focus();
  }

  remove(i: number): void {
    const { handles } = this.#held;
    if (!handles[i]) return;
    this.set(handles.toSpliced(i, 1), Math.min(i, handles.length - 2));
    focusNeighbor(
      this.#items.map(({ move }) => move),
      i,
      this.#adds,
    );
  }

  /** Pixels of the picture for pixels of the window. */
  local(x: number, y: number): Place {
    const box = this.element.getBoundingClientRect();
    return [x - box.left, y - box.top];
  }

  /** Puts everything where it is on the screen. */
  draw(held: Held): void {
    this.#held = held;
    const { shown, picked } = held;
    const { clientWidth: width, clientHeight: height } = this.element;
    const { toScreen } = this.#layout;
    while (this.#items.length > shown.length) for (const element of Object.values(this.#items.pop() ?? {})) element.remove();
    while (this.#items.length < shown.length) this.#make(this.#items.length);
    shown.forEach((handle, i) => {
      const { move, end, line } = this.#items[i] as Item;
      const at = toScreen(placeOf(handle));
      putHandle(move, ...at, width, height);
      move.toggleAttribute('data-picked', i === picked);
      move.toggleAttribute('data-invites', i === this.#invites);
      move.ariaLabel = describe(handle, i);
      end.hidden = line.hidden = handle.end === undefined;
      if (!handle.end) return;
      const tip = toScreen(endOf(handle));
      putHandle(end, ...tip, width, height);
      end.toggleAttribute('data-picked', i === picked);
      end.ariaLabel = `End of bone ${i}, turned ${Math.round(handle.turn)}°`;
      const [dx, dy] = [tip[0] - at[0], tip[1] - at[1]];
      // Parts of the picture, as the ends: see putHandle.
      line.style.left = `${((100 * at[0]) / width).toFixed(3)}%`;
      line.style.top = `${((100 * at[1]) / height).toFixed(3)}%`;
      line.style.width = `${((100 * Math.hypot(dx, dy)) / width).toFixed(3)}%`;
      line.style.rotate = `${Math.atan2(dy, dx)}rad`;
    });
    const handle = shown[picked];
    this.#knob.hidden = !handle || handle.end !== undefined || held.places === true;
    if (!handle || this.#knob.hidden) return;
    putHandle(this.#knob, ...toScreen(placeOf(handle)), width, height);
    this.#knob.style.transform = `rotate(${-handle.turn}deg) translateY(${-KNOB}px)`;
  }

  get #layout() {
    return this.#picture.layout(this.element.clientWidth, this.element.clientHeight);
  }

  #make(i: number): void {
    const button = (kind: string, grip: Pick<Grip, 'drag' | 'nudge' | 'twist'>) => {
      const made = h('button', { type: 'button', class: `point ${kind}`, 'aria-roledescription': 'movable handle' });
      made.dataset.handle = String(i);
      made.setAttribute('aria-keyshortcuts', KEYS);
      made.addEventListener('focus', () => this.#pick(i));
      draggable(made, {
        ...grip,
        hold: () => this.#hold(i),
        turn: (steps) => this.#turn(i, steps),
        pick: () => this.#pick(i),
        reset: () => this.#edit(i, resting),
        remove: () => this.remove(i),
      });
      return made;
    };
    const move = button('start', {
      drag: (x, y) => this.#edit(i, (handle) => movedTo(handle, ...this.#layout.toPlace(...this.local(x, y)))),
      nudge: (across, up) => this.#nudge(i, across, up),
      twist: () => {
        const from = this.#held.handles[i]?.turn ?? 0;
        return (degrees) => this.#edit(i, (handle) => turnedTo(handle, from + degrees));
      },
    });
    // The end of a bone goes around its start.
    const end = button('end', {
      drag: (x, y) => this.#turnTo(i, x, y),
      nudge: (across, up) => this.#turn(i, up - across),
    });
    const line = h('span', { class: 'bone-line' });
    this.#items.push({ move, end, line });
    this.element.append(line, move, end);
  }

  #pick(i: number): void {
    const { handles, picked } = this.#held;
    if (i !== picked) this.set(handles, i);
  }

  #edit(i: number, change: (handle: Handle) => Handle): void {
    const { handles, picked } = this.#held;
    const handle = handles[i];
    if (handle) this.set(handles.with(i, change(handle)), picked);
  }

  #hold(i: number): () => void {
    this.#invites = -1;
    const held = this.#held.handles[i];
    const { places } = this.#held;
    // It may be another one by now, of another shape.
    return () => this.#edit(i, (handle) => (held && (places || handle.rest === held.rest) ? held : handle));
  }

  #nudge(i: number, across: number, up: number): void {
    const step = (STEP * this.element.clientHeight) / this.#layout.scale;
    this.#edit(i, (handle) => {
      const [x, y] = placeOf(handle);
      return movedTo(handle, x + across * step, y + up * step);
    });
  }

  #turn(i: number, steps: number): void {
    this.#edit(i, (handle) => turnedTo(handle, handle.turn + steps * TURN_STEP));
  }

  /** Turns a handle so that its knob, or a bone so that its end, points to these pixels of the window. */
  #turnTo(i: number, x: number, y: number): void {
    const [px, py] = this.local(x, y);
    this.#edit(i, (handle) => {
      const [cx, cy] = this.#layout.toScreen(placeOf(handle));
      // The knob stands above a handle at rest, the end of a bone where the bone points.
      const zero = handle.end ? Math.atan2(handle.end[1] - handle.rest[1], handle.end[0] - handle.rest[0]) : Math.PI / 2;
      return turnedTo(handle, ((Math.atan2(cy - py, px - cx) - zero) * 180) / Math.PI);
    });
  }
}
