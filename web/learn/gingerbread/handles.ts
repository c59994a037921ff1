import { h } from '../../ui/dom.ts';
import { draggable, type Grip } from '../../ui/drag.ts';
import { focusNeighbor } from '../../ui/focus.ts';
import { putHandle } from '../../ui/put-handle.ts';
import { endOf, type Place, placeOf } from './experiment.ts';
import type { Lesson } from './lesson.ts';

/** Part of the picture's height for a step of the keyboard. */
const STEP = 0.01;
/** Degrees for a key, or a notch of the wheel. */
const TURN_STEP = 5;
/** Pixels from a handle to the knob that turns it. */
const KNOB = 38;

interface Item {
  readonly move: HTMLButtonElement;
  readonly end: HTMLButtonElement;
  readonly line: HTMLElement;
}

/** Handles over the picture: dragged by mouse, finger or pen, turned by a knob, a second finger or the wheel, moved by the keyboard. */
export class Handles {
  readonly #area: HTMLElement;
  readonly #lesson: Lesson;
  /** What adds handles. */
  readonly #adds: HTMLElement;
  readonly #items: Item[] = [];
  readonly #knob = h('span', { class: 'knob', 'aria-hidden': 'true' });
  /** A handle that asks to be taken, until one is. */
  #invites = 2;

  constructor(area: HTMLElement, lesson: Lesson, adds: HTMLElement) {
    this.#area = area;
    this.#lesson = lesson;
    this.#adds = adds;
    const picked = () => lesson.picked;
    draggable(this.#knob, {
      hold: () => this.#hold(picked()),
      drag: (x, y) => this.#turnTo(picked(), x, y),
      settle: () => lesson.redraw(),
    });
    area.append(this.#knob);
    area.addEventListener('dblclick', (event) => {
      if (event.target === area || (event.target as Element).matches('canvas')) this.#add(event);
    });
  }

  focus(i: number): void {
    this.#items[i]?.move.focus();
  }

  /** The focus goes to a neighbor of handle `i`, which is gone. */
  focusNear(i: number): void {
    this.draw();
    focusNeighbor(
      this.#items.map(({ move }) => move),
      i,
      this.#adds,
    );
  }

  /** Puts everything where it is on the screen. */
  draw(): void {
    const { shown, picked, picture } = this.#lesson;
    while (this.#items.length > shown.length) {
      const item = this.#items.pop();
      for (const element of Object.values(item ?? {})) element.remove();
    }
    while (this.#items.length < shown.length) this.#make(this.#items.length);
    shown.forEach((handle, i) => {
      const { move, end, line } = this.#items[i] as Item;
      const at = picture.toScreen(placeOf(handle));
      putHandle(move, ...at, ...picture.size);
      move.toggleAttribute('data-picked', i === picked);
      move.toggleAttribute('data-bone', handle.end !== undefined);
      move.toggleAttribute('data-invites', i === this.#invites);
      move.ariaLabel = this.#lesson.describe(i);
      end.hidden = line.hidden = handle.end === undefined;
      if (!handle.end) return;
      const tip = picture.toScreen(endOf(handle));
      putHandle(end, ...tip, ...picture.size);
      end.toggleAttribute('data-picked', i === picked);
      end.ariaLabel = `End of bone ${i}, turned ${Math.round(handle.turn)}°`;
      const [dx, dy] = [tip[0] - at[0], tip[1] - at[1]];
      const [width, height] = picture.size;
      // Parts of the picture, as the ends: see putHandle.
      line.style.left = `${((100 * at[0]) / width).toFixed(3)}%`;
      line.style.top = `${((100 * at[1]) / height).toFixed(3)}%`;
      line.style.width = `${((100 * Math.hypot(dx, dy)) / width).toFixed(3)}%`;
      line.style.rotate = `${Math.atan2(dy, dx)}rad`;
    });
    const handle = shown[picked];
    this.#knob.hidden = !handle || handle.end !== undefined;
    if (handle && !handle.end) {
      putHandle(this.#knob, ...picture.toScreen(placeOf(handle)), ...picture.size);
      this.#knob.style.transform = `rotate(${-handle.turn}deg) translateY(${-KNOB}px)`;
    }
  }

  #make(i: number): void {
    const button = (kind: string, grip: Partial<Grip> & Pick<Grip, 'drag' | 'nudge'>) => {
      const made = h('button', { type: 'button', class: `handle ${kind}`, 'aria-roledescription': 'movable handle' });
      made.dataset.handle = String(i);
      made.setAttribute(
        'aria-keyshortcuts',
        'ArrowLeft ArrowRight ArrowUp ArrowDown PageUp PageDown Q E Shift+Q Shift+E Home Delete Escape',
      );
      made.addEventListener('focus', () => this.#lesson.pick(i));
      draggable(made, { ...this.#grip(i), ...grip });
      return made;
    };
    const move = button('start', {
      drag: (x, y) => this.#lesson.move(i, ...this.#lesson.picture.toPlace(...this.#local(x, y))),
      nudge: (across, up) => this.#nudge(i, across, up),
      twist: () => {
        const from = this.#lesson.handles[i]?.turn ?? 0;
        return (degrees) => this.#lesson.turn(i, from + degrees);
      },
    });
    // The end of a bone goes around its start.
    const end = button('end', {
      drag: (x, y) => this.#turnTo(i, x, y),
      nudge: (across, up) => this.#turn(i, up - across),
    });
    const line = h('span', { class: 'bone-line' });
    this.#items.push({ move, end, line });
    this.#area.append(line, move, end);
  }

  /** What both ends of a handle do alike. */
  #grip(i: number) {
    const lesson = this.#lesson;
    return {
      hold: () => this.#hold(i),
      turn: (steps: number) => this.#turn(i, steps),
      pick: () => lesson.pick(i),
      reset: () => lesson.relax(i),
      remove: () => {
        lesson.remove(i);
        this.focusNear(i);
      },
      settle: () => lesson.redraw(),
    };
  }

  #hold(i: number): () => void {
    this.#invites = -1;
    return this.#lesson.hold(i);
  }

  #nudge(i: number, across: number, up: number): void {
    const handle = this.#lesson.handles[i];
    if (!handle) return;
    const [x, y] = placeOf(handle);
    const step = (STEP * this.#area.clientHeight) / this.#lesson.picture.scale;
    this.#lesson.move(i, x + across * step, y + up * step);
  }

  #turn(i: number, steps: number): void {
    this.#lesson.turn(i, (this.#lesson.handles[i]?.turn ?? 0) + steps * TURN_STEP);
  }

  /** Turns a handle so that its knob, or a bone so that its end, points to these pixels of the window. */
  #turnTo(i: number, x: number, y: number): void {
    const handle = this.#lesson.handles[i];
    if (!handle) return;
    const [px, py] = this.#local(x, y);
    const [cx, cy] = this.#lesson.picture.toScreen(placeOf(handle));
    // The knob stands above a handle at rest, the end of a bone where the bone points.
    const zero = handle.end ? Math.atan2(handle.end[1] - handle.rest[1], handle.end[0] - handle.rest[0]) : Math.PI / 2;
    this.#lesson.turn(i, ((Math.atan2(cy - py, px - cx) - zero) * 180) / Math.PI);
  }

  #add(event: MouseEvent): void {
    if (!this.#lesson.addAt(this.#lesson.picture.toPlace(...this.#local(event.clientX, event.clientY)))) return;
    this.draw();
    this.focus(this.#lesson.picked);
  }

  /** Pixels of the picture for pixels of the window. */
  #local(x: number, y: number): Place {
    const box = this.#area.getBoundingClientRect();
    return [x - box.left, y - box.top];
  }
}
