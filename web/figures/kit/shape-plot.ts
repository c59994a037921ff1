import type { PlaneMesh } from '../../models/mesh-shape.ts';
import type { Shape } from '../../models/shape.ts';
import { ColorMap } from '../../ui/color-map.ts';
import { button, h } from '../../ui/dom.ts';
import { noteIn } from '../../ui/note.ts';
import { PageError } from '../../ui/page-error.ts';
import { onPaper, onScreenChange } from '../../ui/screen.ts';
import type { Kit, OpenPanel, Panel } from './figure.ts';
import { boneIn, emptiest, restOf } from './placing.ts';
import { type Handle, MOST_HANDLES, movedTo, point, resting, struck, toThousandths } from './plane-handles.ts';
import { type Held, ShapeHandles } from './shape-handles.ts';
import { type PaintedShape, ShapePicture } from './shape-picture.ts';

/** A shape of the plane with its handles, as it is drawn. */
interface ShapeDrawing extends Held {
  readonly outline: Shape;
  readonly mesh: PlaneMesh;
  /** Of one color, where this is left out. */
  readonly painted?: PaintedShape;
  /** Where the vertices are now: n×2. */
  readonly positions: ArrayLike<number>;
  /** A handle's weight instead of what is painted: column `picked` of a row a vertex. */
  readonly weights?: Float64Array | undefined;
  /** The triangles. */
  readonly lines?: boolean;
}

interface ShapePlotOptions<M, S> {
  /** What the picture shows, for those who do not see it. */
  readonly label: string;
  draw(made: M, state: S, change: (patch: Partial<S>) => void): ShapeDrawing;
}

/** A panel with a triangulated shape of the plane, and handles on it: points and bones, which can be added and removed. */
export function shapePlot<M, S>(options: ShapePlotOptions<M, S>): Panel<M, S> {
  return { open: (kit) => new ShapePlot(kit, options) };
}

class ShapePlot<M, S> implements OpenPanel<M, S> {
  readonly element: HTMLElement;
  readonly #kit: Kit<S>;
  readonly #options: ShapePlotOptions<M, S>;
  readonly #picture: ShapePicture;
  readonly #canvas: HTMLCanvasElement;
  readonly #area: HTMLElement;
  readonly #legend = legend();
  readonly #handles: ShapeHandles;
  readonly #remove: HTMLButtonElement;
  readonly #rest: HTMLButtonElement;
  readonly #left = new AbortController();
  #drawn: ShapeDrawing | undefined;

  constructor(kit: Kit<S>, options: ShapePlotOptions<M, S>) {
    [this.#kit, this.#options] = [kit, options];
    const note = h('p', { class: 'note', role: 'status', hidden: true });
    this.#picture = new ShapePicture(noteIn(note), () => kit.redraw());
    const adds = button('Add a point', () => this.#add(({ mesh, handles }) => point(...emptiest(mesh, handles))));
    this.#handles = new ShapeHandles(this.#picture, adds);
    this.#remove = button('Remove', () => this.#handles.remove(this.#handles.held.picked));
    this.#rest = button('Rest pose', () => {
      const rest = this.#handles.held.handles.map(resting);
      struck.add(rest);
      this.#handles.held.change(rest, this.#handles.held.picked);
    });
    this.#canvas = h('canvas', { role: 'img', 'aria-label': options.label });
    this.#area = h('div', { class: 'picture' }, this.#canvas, this.#handles.element, this.#legend, note);
    const tools = h(
      'div',
      { class: 'tools' },
      adds,
      button('Add a bone', () => this.#add(({ outline, mesh, handles }) => boneIn(outline, emptiest(mesh, handles)))),
      this.#remove,
      this.#rest,
    );
    this.element = h('div', { class: 'shape-panel stack' }, tools, this.#area);
    this.#handles.element.addEventListener('dblclick', (event) => this.#addAt(event));
    const { signal } = this.#left;
    onScreenChange(this.#area, () => kit.redraw(), signal);
    onPaper(this.#canvas, () => this.#picture.paint(this.#canvas), signal);
  }

  draw(made: M, state: S): void {
    const drawn = this.#options.draw(made, state, this.#kit.change);
    this.#drawn = drawn;
    const { mesh, painted, positions, weights, lines, handles, picked } = drawn;
    this.#area.style.setProperty('--shape', `${this.#area.clientWidth} / ${this.#area.clientHeight}`);
    this.#picture.show(mesh, painted ?? plain(), positions);
    this.#rest.hidden = drawn.places === true;
    this.#picture.setWeight(weights, Math.max(picked, 0), handles.length);
    this.#picture.showLines(lines === true);
    this.#picture.paint(this.#canvas);
    this.#handles.draw(drawn);
    this.#legend.hidden = !weights;
    const held = handles[picked];
    this.#remove.disabled = !held;
    this.#remove.textContent = held ? `Remove ${held.end ? 'bone' : 'handle'} ${picked}` : 'Remove';
  }

  dispose(): void {
    this.#left.abort();
    this.#picture.dispose();
  }

  #add(make: (drawn: ShapeDrawing) => Handle | undefined): void {
    if (!this.#drawn) return;
    const { handles } = this.#handles.held;
    const handle = handles.length < MOST_HANDLES ? make({ ...this.#drawn, handles }) : undefined;
    if (handle) {
      this.#handles.set([...handles, handle], handles.length);
      this.#handles.focus(handles.length);
    } else this.#kit.tell(noRoom(handles.length));
  }

  /** A handle where the shape is now drawn at a place; none where there is nothing. */
  #addAt(event: MouseEvent): void {
    if (event.target !== this.#handles.element || !this.#drawn) return;
    const { clientWidth, clientHeight } = this.#canvas;
    const place = this.#picture.layout(clientWidth, clientHeight).toPlace(...this.#handles.local(event.clientX, event.clientY));
    const rest = restOf(this.#drawn.mesh, this.#drawn.positions, place);
    if (rest) this.#add(() => movedTo(point(toThousandths(rest[0]), toThousandths(rest[1])), ...place));
  }
}

let ofOneColor: PaintedShape | undefined;

function plain(): PaintedShape {
  if (ofOneColor) return ofOneColor;
  const canvas = h('canvas', { width: 1, height: 1 });
  const context = canvas.getContext('2d') as CanvasRenderingContext2D;
  context.fillStyle = '#c3c9d4';
  context.fillRect(0, 0, 1, 1);
  ofOneColor = { canvas, low: [-1, -1], high: [1, 1] };
  return ofOneColor;
}

/** What the colors of weights mean. */
function legend(): HTMLElement {
  const strip = h('span', { class: 'legend-strip' });
  strip.style.background = new ColorMap('viridis', 0, 1).gradient;
  const beyond = (side: string, words: string) => [h('span', { class: `hatch ${side}` }), h('span', {}, words)];
  return h(
    'p',
    { class: 'legend', hidden: true },
    ...['0', strip, '1'],
    ...beyond('below', 'below 0'),
    ...beyond('above', 'above 1'),
  );
}

function noRoom(handles: number): PageError {
  return handles >= MOST_HANDLES
    ? new PageError('too-many-handles', `There are ${handles} handles already.`, 'Remove one to add another.')
    : new PageError('no-room', 'There is no room for a bone here.', 'Add a point, or move other handles away.');
}
