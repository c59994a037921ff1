import { h } from '../../ui/dom.ts';
import { endOf, type Handle, type Place, placeOf } from './experiment.ts';
import type { Lesson } from './lesson.ts';

/** Part of the picture's height for a step of the keyboard. */
const STEP = 0.01;
const TURN_STEP = 5;
/** Pixels from a handle to the knob that turns it. */
const KNOB = 38;
/** Degrees for a notch of the wheel. */
const WHEEL = 5;

type Part = 'move' | 'turn';

interface Item {
  readonly move: HTMLButtonElement;
  readonly end: HTMLButtonElement;
  readonly line: HTMLElement;
}

interface Drag {
  readonly i: number;
  readonly part: Part;
  readonly pointer: number;
  readonly back: () => void;
  /** Off the handle's middle by so much. */
  readonly grip: Place;
  /** The second finger, and the angle of the line to it when it came. */
  second?: { pointer: number; at: Place; angle: number; turn: number };
  at: Place;
}

/** Handles over the picture: dragged by mouse, finger or pen, turned by a knob, a second finger or the wheel, moved by the keyboard. */
export class Handles {
  readonly #area: HTMLElement;
  readonly #lesson: Lesson;
  readonly #settle: () => void;
  readonly #items: Item[] = [];
  readonly #knob = h('span', { class: 'knob', 'aria-hidden': 'true' });
  #drag: Drag | undefined;
  /** A handle that asks to be taken, until one is. */
  #invites = 2;
  /** The handle that the keyboard took hold of. */
  #before: { i: number; back: () => void } | undefined;

  constructor(area: HTMLElement, lesson: Lesson, settle: () => void) {
    this.#area = area;
    this.#lesson = lesson;
    this.#settle = settle;
    this.#listen(this.#knob, () => this.#lesson.picked, 'turn');
    area.append(this.#knob);
    area.addEventListener('dblclick', (event) => {
      if (event.target === area || (event.target as Element).matches('canvas')) this.#add(event);
    });
    area.addEventListener('pointerdown', (event) => this.#secondFinger(event));
    area.addEventListener('pointermove', (event) => this.#followSecond(event));
    for (const type of ['pointerup', 'pointercancel'] as const)
      area.addEventListener(type, (event) => {
        if (this.#drag?.second?.pointer === event.pointerId) delete this.#drag.second;
      });
    document.addEventListener('keydown', (event) => this.#escape(event), { capture: true });
  }

  get dragging(): boolean {
    return this.#drag !== undefined;
  }

  focus(i: number): void {
    this.#items[i]?.move.focus();
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
      put(move, at);
      move.toggleAttribute('data-picked', i === picked);
      move.toggleAttribute('data-bone', handle.end !== undefined);
      move.toggleAttribute('data-invites', i === this.#invites);
      move.ariaLabel = this.#lesson.describe(i);
      end.hidden = line.hidden = handle.end === undefined;
      if (!handle.end) return;
      const tip = picture.toScreen(endOf(handle));
      put(end, tip);
      end.toggleAttribute('data-picked', i === picked);
      end.ariaLabel = `End of bone ${i}, turned ${Math.round(handle.turn)}°`;
      const [dx, dy] = [tip[0] - at[0], tip[1] - at[1]];
      line.style.width = `${Math.hypot(dx, dy).toFixed(1)}px`;
      line.style.transform = `translate(${at[0].toFixed(1)}px, ${at[1].toFixed(1)}px) rotate(${Math.atan2(dy, dx)}rad)`;
    });
    const handle = shown[picked];
    this.#knob.hidden = !handle || handle.end !== undefined;
    if (handle && !handle.end) {
      const [x, y] = picture.toScreen(placeOf(handle));
      this.#knob.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) rotate(${-handle.turn}deg) translateY(${-KNOB}px)`;
    }
  }

  #make(i: number): void {
    const button = (kind: string) => {
      const made = h('button', { type: 'button', class: `handle ${kind}`, 'aria-roledescription': 'movable handle' });
      made.dataset.handle = String(i);
      made.setAttribute(
        'aria-keyshortcuts',
        'ArrowLeft ArrowRight ArrowUp ArrowDown PageUp PageDown Q E Shift+Q Shift+E Delete Escape',
      );
      made.addEventListener('focus', () => this.#lesson.pick(i));
      made.addEventListener('blur', () => {
        this.#before = undefined;
      });
      made.addEventListener('wheel', (event) => this.#wheel(event, i), { passive: false });
      return made;
    };
    const [move, end, line] = [button('start'), button('end'), h('span', { class: 'bone-line' })];
    this.#listen(move, () => i, 'move');
    this.#listen(end, () => i, 'turn');
    move.addEventListener('keydown', (event) => this.#key(event, i, 'move'));
    end.addEventListener('keydown', (event) => this.#key(event, i, 'turn'));
    this.#items.push({ move, end, line });
    this.#area.append(line, move, end);
  }

  #listen(element: HTMLElement, index: () => number, part: Part): void {
    element.addEventListener('pointerdown', (event) => this.#begin(event, index(), part));
    element.addEventListener('pointermove', (event) => this.#follow(event));
    for (const type of ['pointerup', 'pointercancel', 'lostpointercapture'] as const)
      element.addEventListener(type, (event) => this.#end(event.pointerId));
  }

  #begin(event: PointerEvent, i: number, part: Part): void {
    if (event.button !== 0 || this.#drag) return;
    const element = event.currentTarget as HTMLElement;
    event.preventDefault();
    if (element instanceof HTMLButtonElement) element.focus({ preventScroll: true });
    element.setPointerCapture(event.pointerId);
    const at = this.#local(event);
    const handle = this.#lesson.handles[i] as Handle;
    const middle = this.#lesson.picture.toScreen(part === 'turn' && handle.end ? endOf(handle) : placeOf(handle));
    const back = this.#lesson.hold(i);
    const grip: Place = element === this.#knob ? [0, 0] : [at[0] - middle[0], at[1] - middle[1]];
    this.#drag = { i, part, pointer: event.pointerId, back, grip, at };
    this.#area.toggleAttribute('data-dragging', true);
    this.#invites = -1;
    this.#lesson.pick(i);
  }

  #follow(event: PointerEvent): void {
    const drag = this.#drag;
    if (drag?.pointer !== event.pointerId) return;
    drag.at = this.#local(event);
    const [px, py] = [drag.at[0] - drag.grip[0], drag.at[1] - drag.grip[1]];
    if (drag.part === 'move') {
      this.#lesson.move(drag.i, ...this.#lesson.picture.toPlace(px, py));
      this.#turnBySecond();
      return;
    }
    const handle = this.#lesson.handles[drag.i] as Handle;
    const [x, y] = this.#lesson.picture.toScreen(placeOf(handle));
    // The knob stands above a handle at rest, the end of a bone where the bone points.
    const zero = handle.end ? Math.atan2(handle.end[1] - handle.rest[1], handle.end[0] - handle.rest[0]) : Math.PI / 2;
    this.#lesson.turn(drag.i, ((Math.atan2(y - py, px - x) - zero) * 180) / Math.PI);
  }

  #secondFinger(event: PointerEvent): void {
    const drag = this.#drag;
    if (!drag || drag.second || event.pointerId === drag.pointer || drag.part !== 'move') return;
    event.preventDefault();
    const at = this.#local(event);
    drag.second = { pointer: event.pointerId, at, angle: angleOf(drag.at, at), turn: this.#lesson.handles[drag.i]?.turn ?? 0 };
  }

  #followSecond(event: PointerEvent): void {
    const second = this.#drag?.second;
    if (second?.pointer !== event.pointerId) return;
    second.at = this.#local(event);
    this.#turnBySecond();
  }

  #turnBySecond(): void {
    const drag = this.#drag;
    if (!drag?.second) return;
    this.#lesson.turn(drag.i, drag.second.turn + angleOf(drag.at, drag.second.at) - drag.second.angle);
  }

  #end(pointer: number): void {
    if (this.#drag?.pointer !== pointer) return;
    this.#drag = undefined;
    this.#area.toggleAttribute('data-dragging', false);
    this.#settle();
  }

  #escape(event: KeyboardEvent): void {
    if (event.key !== 'Escape' || !this.#drag) return;
    const { back, pointer } = this.#drag;
    this.#end(pointer);
    back();
    event.stopPropagation();
  }

  /** Turns only what is focused or held: elsewhere the page scrolls. */
  #wheel(event: WheelEvent, i: number): void {
    const held = this.#drag?.i === i;
    if ((!held && document.activeElement !== event.currentTarget) || event.ctrlKey || event.deltaY === 0) return;
    event.preventDefault();
    const step = (event.shiftKey ? WHEEL / 5 : WHEEL) * -Math.sign(event.deltaY);
    this.#lesson.turn(i, (this.#lesson.handles[i]?.turn ?? 0) + step);
    this.#settle();
  }

  #key(event: KeyboardEvent, i: number, part: Part): void {
    const lesson = this.#lesson;
    const handle = lesson.handles[i];
    if (!handle || event.ctrlKey || event.metaKey || event.altKey) return;
    const [x, y] = placeOf(handle);
    const fine = event.shiftKey ? 0.2 : 1;
    const step = (STEP * fine * this.#area.clientHeight) / lesson.picture.scale;
    const turn = (by: number) => () => lesson.turn(i, handle.turn + by * fine);
    const moves: Record<string, () => void> = {
      arrowleft: () => lesson.move(i, x - step, y),
      arrowright: () => lesson.move(i, x + step, y),
      arrowdown: () => lesson.move(i, x, y - step),
      arrowup: () => lesson.move(i, x, y + step),
      pagedown: () => lesson.move(i, x, y - 10 * step),
      pageup: () => lesson.move(i, x, y + 10 * step),
      q: turn(TURN_STEP),
      e: turn(-TURN_STEP),
    };
    if (part === 'turn') {
      for (const key of ['arrowleft', 'arrowup']) moves[key] = turn(TURN_STEP);
      for (const key of ['arrowright', 'arrowdown']) moves[key] = turn(-TURN_STEP);
      moves.pageup = turn(9 * TURN_STEP);
      moves.pagedown = turn(-9 * TURN_STEP);
    }
    const move = moves[event.key.toLowerCase()];
    if (move) {
      if (this.#before?.i !== i) this.#before = { i, back: lesson.hold(i) };
      move();
    } else if (event.key === 'Escape' && this.#before?.i === i) {
      this.#before.back();
      this.#before = undefined;
    } else if (event.key === 'Delete' || event.key === 'Backspace') {
      lesson.remove(i);
      this.draw();
      this.focus(Math.min(i, this.#items.length - 1));
    } else {
      return;
    }
    event.preventDefault();
    this.#settle();
  }

  #add(event: MouseEvent): void {
    if (!this.#lesson.addAt(this.#lesson.picture.toPlace(...this.#local(event)))) return;
    this.draw();
    this.focus(this.#lesson.picked);
    this.#settle();
  }

  #local(event: MouseEvent): Place {
    const box = this.#area.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }
}

function put(element: HTMLElement, [x, y]: Place): void {
  element.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
}

/** Degrees of the line from one place of the screen to another, counter-clockwise. */
function angleOf(from: Place, to: Place): number {
  return (Math.atan2(from[1] - to[1], to[0] - from[0]) * 180) / Math.PI;
}
