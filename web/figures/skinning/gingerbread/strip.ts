import { h } from '../../../ui/dom.ts';
import type { Panel } from '../../kit/figure.ts';
import { Leisure } from '../../kit/leisure.ts';
import { ShapePicture } from '../../kit/shape-picture.ts';
import type { Bent, State } from './bent.ts';
import { METHODS, type Method } from './methods.ts';

interface Tile {
  readonly method: Method;
  readonly button: HTMLButtonElement;
  readonly canvas: HTMLCanvasElement;
  readonly note: HTMLElement;
}

/** Small pictures of every method in the same pose; a click chooses the method. Drawn while nothing else happens. */
export const strip: Panel<Bent, State> = {
  open: (kit) => {
    const picture = new ShapePicture();
    const tiles = METHODS.map((method): Tile => {
      const canvas = h('canvas', { width: 1, height: 1, 'aria-hidden': 'true' });
      const note = h('span', { class: 'tile-note', hidden: true }, 'not prepared');
      const name = h('span', { class: 'tile-name' }, method.title);
      const choose = () => kit.change({ m: method.id });
      const attributes = { type: 'button', class: 'tile', 'data-method': method.id, onclick: choose };
      return { method, button: h('button', attributes, canvas, note, name), note, canvas };
    });
    const buttons = tiles.map(({ button }) => button);
    const element = h('section', { class: 'strip', 'aria-label': 'Every method in the same pose' }, ...buttons);
    const leisure = new Leisure<Tile>(element);
    return {
      element,
      draw: (_, { m }) => {
        leisure.pause();
        for (const { method, button } of tiles) button.ariaCurrent = method.id === m ? 'true' : null;
      },
      // Everything is drawn again; what is there first, what takes long last.
      refine: (bent, state) => {
        const rank = ({ method }: Tile) => (bent.deformer?.isReady(method) ? 0 : method.kind === 'bounded' ? 2 : 1);
        const inOrder = [...tiles].sort((a, b) => rank(a) - rank(b));
        leisure.go((tile) => paint(picture, tile, bent, state), inOrder);
      },
      dispose: () => {
        leisure.pause();
        picture.dispose();
      },
    };
  },
};

function paint(picture: ShapePicture, { method, button, note, canvas }: Tile, bent: Bent, state: State): void {
  const isPrepared = bent.deformer?.isOffered(method) === true;
  note.hidden = isPrepared || method.family !== 'irbf';
  let isDrawn = false;
  try {
    if (isPrepared) {
      const positions = bent.positions.slice();
      bent.deformer?.deform(method, bent.handles(state), positions);
      picture.show(bent.mesh, bent.painted, positions);
      picture.setWeight(undefined, 0, 0);
      picture.showLines(false);
      isDrawn = picture.paint(canvas);
    }
  } catch {
    // The method itself says why when it is chosen.
  }
  if (!isDrawn) canvas.getContext('2d')?.clearRect(0, 0, canvas.width, canvas.height);
  button.toggleAttribute('data-drawn', isDrawn);
}
