import { h } from '../../../ui/dom.ts';
import type { Kit, OpenPanel, Panel } from '../../kit/figure.ts';
import { ShapePicture } from '../../kit/shape-picture.ts';
import type { Bent, State } from './bent.ts';
import { METHODS, type Method } from './methods.ts';

/** Milliseconds of a frame that small pictures may take. */
const BUDGET = 10;

interface Tile {
  readonly method: Method;
  readonly button: HTMLButtonElement;
  readonly canvas: HTMLCanvasElement;
  readonly note: HTMLElement;
}

/** Small pictures of every method in the same pose; a click chooses the method. Drawn while nothing else happens. */
export const strip: Panel<Bent, State> = { open: (kit) => new Strip(kit) };

class Strip implements OpenPanel<Bent, State> {
  readonly element: HTMLElement;
  readonly #picture = new ShapePicture();
  readonly #tiles: readonly Tile[];
  #queue: Tile[] = [];
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(kit: Kit<State>) {
    this.#tiles = METHODS.map((method) => {
      const canvas = h('canvas', { width: 1, height: 1, 'aria-hidden': 'true' });
      const note = h('span', { class: 'tile-note', hidden: true }, 'not prepared');
      const name = h('span', { class: 'tile-name' }, method.title);
      const choose = () => kit.change({ m: method.id });
      const button = h('button', { type: 'button', class: 'tile', onclick: choose }, canvas, note, name);
      button.dataset.method = method.id;
      return { method, button, note, canvas };
    });
    const buttons = this.#tiles.map(({ button }) => button);
    this.element = h('section', { class: 'strip', 'aria-label': 'Every method in the same pose' }, ...buttons);
  }

  /** Marks what is chosen. The rest has to wait while somebody does something. */
  draw(_: Bent, { m }: State): void {
    clearTimeout(this.#timer);
    for (const { method, button } of this.#tiles) button.ariaCurrent = method.id === m ? 'true' : null;
  }

  /** Everything is drawn again; what is there first, what takes long last. */
  refine(bent: Bent, state: State): void {
    const rank = ({ method }: Tile) => (bent.deformer?.isReady(method) ? 0 : method.kind === 'bounded' ? 2 : 1);
    this.element.toggleAttribute('data-done', false);
    this.#queue = [...this.#tiles].sort((a, b) => rank(a) - rank(b));
    this.#soon(bent, state);
  }

  dispose(): void {
    clearTimeout(this.#timer);
    this.#picture.dispose();
  }

  #soon(bent: Bent, state: State): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      const until = performance.now() + BUDGET;
      let tile = this.#queue.shift();
      for (; tile; tile = performance.now() < until ? this.#queue.shift() : undefined) this.#drawTile(tile, bent, state);
      this.element.toggleAttribute('data-done', this.#queue.length === 0);
      if (this.#queue.length > 0) this.#soon(bent, state);
    }, 30);
  }

  #drawTile({ method, button, note, canvas }: Tile, bent: Bent, state: State): void {
    const isPrepared = bent.deformer?.isOffered(method) === true;
    note.hidden = isPrepared || method.family !== 'irbf';
    let isDrawn = false;
    try {
      if (isPrepared) {
        const positions = bent.positions.slice();
        bent.deformer?.deform(method, bent.handles(state), positions);
        this.#picture.show(bent.mesh, bent.painted, positions);
        this.#picture.setWeight(undefined, 0, 0);
        this.#picture.showLines(false);
        isDrawn = this.#picture.paint(canvas);
      }
    } catch {
      // The method itself says why when it is chosen.
    }
    if (!isDrawn) canvas.getContext('2d')?.clearRect(0, 0, canvas.width, canvas.height);
    button.toggleAttribute('data-drawn', isDrawn);
  }
}
