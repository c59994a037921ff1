/*
 * How every handle of the house is moved: in the plane and in space, in the studio and in figures.
 *
 *   drag           the main button, a finger or a pen. Until it ends, other fingers and buttons change nothing
 *   Esc            goes back to where the drag, or the run of keys, began
 *   arrows         a step; with Shift a fifth of one
 *   Page Up, Down  ten steps up, down
 *   + −            a step toward, away; so do Alt and the up and down arrows
 *   Q E, wheel     turn left, right: the handle that has the focus
 *   Home           back to rest
 *   Delete         removes, or puts back what cannot be removed
 *
 * A drag ends, and keeps its last place, when the pointer, the window or the tab is lost.
 */

const FINE = 1 / 5;
const COARSE = 10;

/** Steps to the right, up and toward the viewer. */
const MOVES: Readonly<Record<string, readonly [across: number, up: number, toward: number]>> = {
  ArrowLeft: [-1, 0, 0],
  ArrowRight: [1, 0, 0],
  ArrowDown: [0, -1, 0],
  ArrowUp: [0, 1, 0],
  PageDown: [0, -COARSE, 0],
  PageUp: [0, COARSE, 0],
  '+': [0, 0, 1],
  '=': [0, 0, 1],
  '-': [0, 0, -1],
  _: [0, 0, -1],
  'Alt+ArrowDown': [0, 0, 1],
  'Alt+ArrowUp': [0, 0, -1],
};

/** What a handle can do. Only what is here is listened for. */
export interface Grip {
  /** A drag or a run of keys begins; gives what takes it back. */
  hold(): () => void;
  /** The pointer is over these pixels of the window, less how far off the handle's middle it was taken. */
  drag(x: number, y: number): void;
  /** The handle's middle, pixels of the window; that of its box where this is left out. */
  middle?(): readonly [x: number, y: number];
  nudge?(across: number, up: number, toward: number): void;
  /** Counter-clockwise by steps: of a key, or of a notch of the wheel. */
  turn?(steps: number): void;
  /** A second finger comes down, which turns what the first one holds; gives what turns it by degrees from then on, counter-clockwise. */
  twist?(): (degrees: number) => void;
  pick?(): void;
  reset?(): void;
  remove?(): void;
  /** A drag or a keystroke is over. */
  settle?(): void;
}

type Keys = Omit<Grip, 'drag'>;

interface Drag {
  readonly element: HTMLElement;
  readonly grip: Grip;
  readonly pointer: number;
  readonly back: () => void;
  /** From the handle's middle to the pointer. */
  readonly dx: number;
  readonly dy: number;
  readonly listening: AbortController;
  /** Where the pointer is, pixels of the window. */
  x: number;
  y: number;
  /** A second finger, and the angle of the line to it when it came. */
  second: (Spot & { readonly pointer: number; readonly from: number; readonly turn: (degrees: number) => void }) | undefined;
  /** Pointers that came down meanwhile, of which nobody else has heard. */
  readonly refused: Set<number>;
}

interface Spot {
  x: number;
  y: number;
}

/** There is one hand. */
let drag: Drag | undefined;

/** Whether some handle is being dragged. */
export function isDragging(): boolean {
  return drag !== undefined;
}

/** Makes an element that can have the focus a handle. */
export function draggable(element: HTMLElement, grip: Grip): void {
  element.style.touchAction = 'none';
  element.addEventListener('pointerdown', (event) => {
    // Prevented: what lies below is held already, and this is its second finger.
    if (event.button === 0 && !event.defaultPrevented && !element.matches(':disabled')) take(element, grip, event);
  });
  steerable(element, grip);
}

/** The same by keys and wheel only: for what browsers drag by themselves, as sliders. */
export function steerable(element: HTMLElement, grip: Keys): void {
  // What takes back the run of keys that is on.
  let back: (() => void) | undefined;
  const forget = () => {
    back = undefined;
  };
  element.addEventListener('pointerdown', forget);
  element.addEventListener('blur', forget);
  element.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || drag) return;
    const act = actOf(event, grip);
    if (act) {
      back ??= grip.hold();
      act();
    } else if (event.key === 'Escape' && back) {
      back();
      back = undefined;
    } else if (event.key === 'Home' && grip.reset) {
      grip.reset();
    } else if ((event.key === 'Delete' || event.key === 'Backspace') && (grip.remove || grip.reset)) {
      back = undefined;
      (grip.remove ?? grip.reset)?.();
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
    grip.settle?.();
  });
  if (!grip.turn) return;
  element.addEventListener(
    'wheel',
    (event) => {
      // Elsewhere the page scrolls.
      if (document.activeElement !== element || event.ctrlKey || event.deltaY === 0) return;
      event.preventDefault();
      grip.turn?.((event.shiftKey ? FINE : 1) * -Math.sign(event.deltaY));
      grip.settle?.();
    },
    { passive: false },
  );
}

function actOf({ key, shiftKey, altKey }: KeyboardEvent, grip: Keys): (() => void) | undefined {
  const part = shiftKey ? FINE : 1;
  const move = MOVES[altKey ? `Alt+${key}` : key];
  if (move && grip.nudge) return () => grip.nudge?.(move[0] * part, move[1] * part, move[2] * part);
  const steps = altKey ? 0 : ({ q: 1, e: -1 }[key.toLowerCase()] ?? 0);
  return steps !== 0 && grip.turn ? () => grip.turn?.(steps * part) : undefined;
}

/** Begins a drag with a pointer that is down, on the handle or beside it. */
export function take(element: HTMLElement, grip: Grip, event: PointerEvent): void {
  if (drag) return;
  event.preventDefault();
  event.stopPropagation();
  element.focus({ preventScroll: true });
  grip.pick?.();
  const box = element.getBoundingClientRect();
  const [x, y] = grip.middle?.() ?? [box.x + box.width / 2, box.y + box.height / 2];
  const listening = new AbortController();
  drag = {
    element,
    grip,
    pointer: event.pointerId,
    back: grip.hold(),
    dx: event.clientX - x,
    dy: event.clientY - y,
    listening,
    x: event.clientX,
    y: event.clientY,
    second: undefined,
    refused: new Set(),
  };
  element.setPointerCapture(event.pointerId);
  element.toggleAttribute('data-dragging', true);
  const first = { capture: true, passive: false, signal: listening.signal };
  addEventListener('pointermove', follow, first);
  for (const type of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) addEventListener(type, lift, first);
  for (const type of ['pointerdown', 'touchstart', 'contextmenu', 'dblclick', 'auxclick'] as const)
    addEventListener(type, refuse, first);
  addEventListener('keydown', cancel, first);
  addEventListener('blur', end, { signal: listening.signal });
  document.addEventListener('visibilitychange', end, { signal: listening.signal });
}

function follow(event: PointerEvent): void {
  if (!drag) return;
  const { element, grip, pointer, second } = drag;
  if (!element.isConnected) {
    end();
    return;
  }
  if (event.pointerId === second?.pointer) {
    second.x = event.clientX;
    second.y = event.clientY;
  } else if (event.pointerId !== pointer) {
    event.stopPropagation();
    return;
  } else if (event.pointerType === 'mouse' && (event.buttons & 1) === 0) {
    // The main button was let go while another one was down: browsers tell that by a movement.
    end();
    return;
  } else {
    drag.x = event.clientX;
    drag.y = event.clientY;
    grip.drag(event.clientX - drag.dx, event.clientY - drag.dy);
  }
  second?.turn(angle(drag, second) - second.from);
}

function lift(event: PointerEvent): void {
  // A finger that came down beside the handle leaves what it was on for the handle.
  if (event.type === 'lostpointercapture' && drag?.element.hasPointerCapture(event.pointerId)) return;
  if (event.pointerId === drag?.pointer) end();
  else if (event.pointerId === drag?.second?.pointer) drag.second = undefined;
  else if (drag?.refused.has(event.pointerId)) event.stopPropagation();
}

/** Another finger or button, and what comes of it. */
function refuse(event: Event): void {
  if (!drag) return;
  event.preventDefault();
  event.stopImmediatePropagation();
  if (!(event instanceof PointerEvent) || event.type !== 'pointerdown' || event.pointerId === drag.pointer) return;
  drag.refused.add(event.pointerId);
  if (!drag.grip.twist || drag.second) return;
  const second = { pointer: event.pointerId, x: event.clientX, y: event.clientY };
  drag.second = { ...second, from: angle(drag, second), turn: drag.grip.twist() };
}

function cancel(event: KeyboardEvent): void {
  if (event.key !== 'Escape' || !drag) return;
  event.preventDefault();
  event.stopImmediatePropagation();
  const { back, grip } = drag;
  end();
  back();
  grip.settle?.();
}

/** Ends a drag of this element, which keeps its last place: what it held is gone, or is not to be moved now. */
export function letGo(element: HTMLElement): void {
  if (drag?.element === element) end();
}

function end(): void {
  if (!drag) return;
  const { element, grip, pointer, listening } = drag;
  drag = undefined;
  listening.abort();
  element.removeAttribute('data-dragging');
  if (element.hasPointerCapture(pointer)) element.releasePointerCapture(pointer);
  grip.settle?.();
}

/** Degrees of the line from one place to another, counter-clockwise. */
function angle(from: Spot, to: Spot): number {
  return (Math.atan2(from.y - to.y, to.x - from.x) * 180) / Math.PI;
}
