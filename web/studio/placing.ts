import { byId } from '../ui/dom.ts';

/** What a new handle is asked of: a place on the view, −1 to 1. Says whether there is a surface. */
type PlaceAt = (x: number, y: number) => boolean;

/** Adding handles: a double-click anywhere, or a mode in which Enter takes the middle of the view and a click takes its place. */
export class Placing {
  readonly #viewport = byId('viewport');
  readonly #reticle = byId('reticle');
  readonly #note: (words: string) => void;
  readonly #place: PlaceAt;
  #active = false;
  #down: { x: number; y: number } | undefined;

  constructor(note: (words: string) => void, place: PlaceAt) {
    this.#note = note;
    this.#place = place;
    const viewport = this.#viewport;
    viewport.addEventListener('keydown', (event) => this.#key(event), { capture: true });
    viewport.addEventListener('pointerdown', ({ clientX: x, clientY: y }) => {
      this.#down = { x, y };
    });
    viewport.addEventListener('pointerup', (event) => {
      const still = this.#down && Math.hypot(event.clientX - this.#down.x, event.clientY - this.#down.y) < 5;
      if (this.#active && still && !onHandle(event)) this.#try(event);
    });
    viewport.addEventListener('dblclick', (event) => !this.#active && !onHandle(event) && this.#place(...this.#at(event)));
  }

  begin(): void {
    this.#active = true;
    this.#reticle.hidden = false;
    this.#note('Turn the model until the ring is on the spot and press Enter, or click the spot. Esc stops.');
    this.#viewport.focus({ preventScroll: true });
    this.#viewport.scrollIntoView({ block: 'nearest' });
  }

  end(): void {
    if (!this.#active) return;
    this.#active = false;
    this.#reticle.hidden = true;
    this.#note('');
  }

  #key(event: KeyboardEvent): void {
    if (!this.#active || (event.key !== 'Enter' && event.key !== 'Escape')) return;
    event.preventDefault();
    event.stopPropagation();
    if (event.key === 'Enter') this.#try(undefined);
    else this.end();
  }

  #try(event: MouseEvent | undefined): void {
    const [x, y] = event ? this.#at(event) : [0, 0];
    if (this.#place(x, y)) this.end();
    else this.#note('There is no surface at that spot. Turn the model, or click on it. Esc stops.');
  }

  #at(event: MouseEvent): [number, number] {
    const box = this.#viewport.getBoundingClientRect();
    return [((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2];
  }
}

function onHandle(event: Event): boolean {
  return event.target instanceof Element && event.target.closest('.handle') !== null;
}
