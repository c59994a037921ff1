import type { Handlebody } from '../../../wasm/ts/index.ts';
import type { Shape } from '../../models/shape.ts';
import { writeAddress } from '../../ui/address.ts';
import { copyLink } from '../../ui/copy-link.ts';
import { byId, h } from '../../ui/dom.ts';
import { isDragging } from '../../ui/drag.ts';
import { lazy, NotFetched } from '../../ui/lazy.ts';
import { PageError } from '../../ui/page-error.ts';
import { onInterruption, onPaper, onScreenChange } from '../../ui/screen.ts';
import { Trouble } from '../../ui/trouble.ts';
import { initial, portable } from './address.ts';
import { captionOf, legend } from './captions.ts';
import type { Deformer } from './deformer.ts';
import { MOST_HANDLES, type ShapeName, VERTICES } from './experiment.ts';
import { listenForFiles } from './files.ts';
import { HandlePanel } from './handle-panel.ts';
import { Handles } from './handles.ts';
import type { PaintedShape } from './icing.ts';
import { Lesson } from './lesson.ts';
import { MethodPanel } from './method-panel.ts';
import { type DistanceKind, type Method, type MethodId, type WeightsKind, weightsOf } from './methods.ts';
import { OwnShape } from './own-shape.ts';
import type { Picture } from './picture.ts';
import { Requirements } from './requirements.ts';
import { shapeOf } from './shapes.ts';
import { Strip } from './strip.ts';

/** Only who opens a picture needs what traces it. */
const picturePart = lazy(() => import('./open-picture.ts'), 'The part of this page that opens pictures');
const slabPart = lazy(() => import('./interior.ts'), 'The part of this page that measures distances');

/** Brings the parts of the page together. */
export class Page {
  readonly #lesson: Lesson;
  readonly #handles: Handles;
  readonly #methods: MethodPanel;
  readonly #handlePanel: HandlePanel;
  readonly #requirements: Requirements;
  readonly #strip: Strip;
  readonly #own: OwnShape;
  readonly #main = byId('lesson');
  readonly #live = byId('live');
  readonly #note = byId('note');
  readonly trouble = new Trouble(byId('trouble'), () => document.querySelector('input[name=shape]:checked'));
  readonly #caption = h('p', { class: 'caption' });
  readonly #flips = h('span', {});
  readonly #legend: HTMLElement;
  readonly #poses = h('div', { class: 'poses', role: 'group', 'aria-label': 'Poses' });
  readonly #facts = h('p', { class: 'soft small' });
  readonly #islands = h('p', { class: 'found', hidden: true });
  readonly #vertices: HTMLInputElement;
  readonly #remove: HTMLButtonElement;
  readonly #weightBox: HTMLInputElement;
  readonly #meshBox: HTMLInputElement;
  readonly #file = h('input', {
    type: 'file',
    class: 'unseen',
    id: 'file',
    tabindex: -1,
    'aria-label': 'Picture',
    accept: 'image/png,image/svg+xml,image/webp,.png,.svg',
  });
  #baking: { readonly deformer: Deformer; readonly kind: DistanceKind; readonly stop: AbortController } | undefined;
  /** The method of which the picture is: interior radial basis functions only when their distances are there. */
  #answered: MethodId = initial().method;
  /** The file that was opened last. */
  #opened: File | undefined;
  #handlesSeen = '';
  #meshSeen: unknown;

  constructor(picture: Picture) {
    const area = byId('picture');
    const size = () => {
      const { clientWidth: width, clientHeight: height } = area;
      area.style.setProperty('--shape', `${width} / ${height}`);
      picture.resize(width, height);
    };
    size();
    const lesson = new Lesson(picture, {
      mesh: () => this.#mesh(),
      structure: () => this.#structure(),
      frame: () => this.#frame(),
      busy: (said, part) => this.#busy(said, part),
      trouble: (error) => (error === undefined ? this.trouble.clear() : this.trouble.tell(error)),
      rest: () => this.#rest(),
    });
    this.#lesson = lesson;
    const adds = h('button', { type: 'button', class: 'button small', id: 'add-point' }, 'Add a point');
    this.#handles = new Handles(byId('overlay'), lesson, adds);
    const choose = (id: MethodId) => lesson.setMethod(id);
    this.#methods = new MethodPanel(choose);
    this.#handlePanel = new HandlePanel(lesson, () => this.#pause());
    this.#requirements = new Requirements(lesson, (kind: WeightsKind) =>
      choose(`${lesson.method.family === 'rigid' ? 'rigid' : 'linear'}-${kind}`),
    );
    this.#strip = new Strip(lesson, choose);
    this.#own = new OwnShape({
      take: (outline) => this.#takeOutline(outline),
      open: () => this.#file.click(),
      cancel: () => this.#leaveOwn(),
      trouble: (error) => this.trouble.tell(error),
    });
    this.#weightBox = h('input', {
      type: 'checkbox',
      id: 'show-weight',
      onchange: () => lesson.setShow({ weight: this.#weightBox.checked }),
    });
    this.#meshBox = h('input', {
      type: 'checkbox',
      id: 'show-mesh',
      onchange: () => lesson.setShow({ mesh: this.#meshBox.checked }),
    });
    this.#legend = legend();
    this.#vertices = h('input', {
      type: 'range',
      id: 'vertices',
      min: VERTICES.low,
      max: VERTICES.high,
      step: 50,
      onchange: () => {
        if (!lesson.setVertices(this.#vertices.valueAsNumber)) this.#vertices.value = String(lesson.experiment.vertices);
      },
    });
    const remove = () => {
      const { picked } = lesson;
      lesson.remove(picked);
      this.#handles.focusNear(picked);
    };
    this.#remove = h('button', { type: 'button', class: 'button small', onclick: remove }, 'Remove');
    this.#lay(adds);
    onScreenChange(area, () => {
      size();
      lesson.repaint();
      this.#handles.draw();
      this.#strip.refresh();
    });
    const canvas = byId<HTMLCanvasElement>('canvas');
    onPaper(canvas, () => lesson.repaint());
    onInterruption(
      canvas,
      (words) => this.#busy(words || undefined),
      () => lesson.redraw(),
    );
    for (const input of document.querySelectorAll<HTMLInputElement>('input[name=shape]')) {
      input.addEventListener('change', () => this.#turnTo(input.value as ShapeName));
      input.addEventListener('keydown', (event) => event.key === 'Escape' && this.#own.cancel());
    }
    copyLink(byId('copy'), this.#live, () => writeAddress(lesson.address));
    addEventListener('hashchange', () => lesson.open(location.hash));
    listenForFiles(this.#file, byId('veil'), (file) => void this.#takeFile(file));
    this.#mesh();
    this.#structure();
    lesson.redraw();
  }

  connect(hb: Handlebody): void {
    this.#lesson.connect(hb);
  }

  get address(): string {
    return this.#lesson.address;
  }

  #lay(addPoint: HTMLElement): void {
    const button = (id: string, text: string, act: () => void) =>
      h('button', { type: 'button', class: 'button small', id, onclick: act }, text);
    const added = (add: () => boolean) => () => {
      if (!add()) return this.trouble.tell(noRoom(this.#lesson.handles.length));
      this.#handles.draw();
      this.#handles.focus(this.#lesson.picked);
    };
    addPoint.addEventListener(
      'click',
      added(() => this.#lesson.addPoint()),
    );
    byId('tools').append(
      addPoint,
      button(
        'add-bone',
        'Add a bone',
        added(() => this.#lesson.addBone()),
      ),
      this.#remove,
    );
    byId('picture').append(this.#own.element, this.#legend);
    byId('under').append(
      h(
        'div',
        { class: 'under-row' },
        this.#poses,
        h(
          'div',
          { class: 'looks' },
          h('label', { class: 'tick-box' }, this.#weightBox, h('span', {}, 'Weight of the picked handle')),
          h('label', { class: 'tick-box' }, this.#meshBox, h('span', {}, 'Triangles')),
        ),
      ),
      this.#caption,
      this.#strip.element,
    );
    byId('panel').append(
      this.#methods.element,
      this.#islands,
      this.#requirements.element,
      this.#handlePanel.element,
      h(
        'section',
        { 'aria-labelledby': 'mesh-title' },
        h('h2', { id: 'mesh-title' }, 'Mesh'),
        h('div', { class: 'control' }, h('label', { for: 'vertices' }, 'Vertices, about'), this.#vertices),
        this.#facts,
      ),
      this.#file,
    );
  }

  // Shapes

  #turnTo(shape: ShapeName): void {
    if (shape === 'own') {
      this.#own.show();
      return;
    }
    if (this.#lesson.start({ ...initial(shape), method: this.#lesson.experiment.method })) writeAddress(this.#lesson.address, true);
  }

  #takeOutline(outline: Shape, painting?: PaintedShape): void {
    const { method } = this.#lesson.experiment;
    if (this.#lesson.start({ ...initial('own', portable(outline)), method }, painting)) writeAddress(this.#lesson.address, true);
  }

  /** The choice of a shape says again what is shown. */
  #leaveOwn(): void {
    const focused = this.#own.element.contains(document.activeElement);
    this.#own.hide();
    for (const input of document.querySelectorAll<HTMLInputElement>('input[name=shape]')) {
      input.checked = input.value === this.#lesson.experiment.shape;
      if (focused && input.checked) input.focus();
    }
  }

  async #takeFile(file: File): Promise<void> {
    this.#opened = file;
    try {
      this.#busy('Tracing the picture …');
      const { openPicture } = await picturePart(this.#lesson.address);
      const { outline, painting } = await openPicture(file);
      // Unless another one was opened meanwhile.
      if (this.#opened === file) this.#takeOutline(outline, painting);
    } catch (error) {
      this.trouble.tell(error, error instanceof NotFetched ? () => void this.#takeFile(file) : undefined);
    } finally {
      this.#busy(undefined);
    }
  }

  #mesh(): void {
    const { experiment, mesh } = this.#lesson;
    const known = shapeOf(experiment.shape);
    byId('title').textContent = known?.name ?? 'Your own shape';
    this.#leaveOwn();
    this.#vertices.value = String(experiment.vertices);
    const [vertices, triangles] = [mesh.positions.length / 2, mesh.triangles.length / 3];
    this.#facts.textContent = `${vertices.toLocaleString('en')} vertices, ${triangles.toLocaleString('en')} triangles, smallest angle ${mesh.smallestAngle.toFixed(1)}°.`;
    this.#poses.replaceChildren(
      h('button', { type: 'button', class: 'button small', onclick: () => this.#lesson.rest() }, 'Rest pose'),
      ...(known?.poses ?? []).map(({ name, handles, method }) =>
        h('button', { type: 'button', class: 'button small', onclick: () => this.#lesson.strike(handles(), method) }, name),
      ),
    );
    this.#baking?.stop.abort();
  }

  // Frames

  #structure(): void {
    const { method, experiment, handles, picked } = this.#lesson;
    this.#pause();
    this.#methods.update(method);
    this.#strip.update();
    this.#requirements.update();
    this.#handlePanel.update();
    const { weight, mesh } = experiment.show;
    [this.#weightBox.checked, this.#meshBox.checked] = [weight, mesh];
    this.#legend.hidden = !weight || !weightsOf(method);
    this.#weightBox.disabled = !weightsOf(method);
    this.#remove.disabled = !handles[picked];
    this.#remove.textContent = handles[picked] ? `Remove ${handles[picked]?.end ? 'bone' : 'handle'} ${picked}` : 'Remove';
    this.#flips.textContent = '';
    this.#caption.replaceChildren(h('strong', {}, method.title), ` ${captionOf(method, handles)}`, this.#flips);
    if (method.family !== 'irbf') this.#answered = method.id;
    else void this.#bake(method);
  }

  #frame(): void {
    this.#pause();
    this.#handles.draw();
    this.#handlePanel.update();
  }

  #pause(): void {
    this.#main.dataset.rest = 'no';
    this.#strip.pause();
    this.#requirements.pause();
  }

  #rest(): void {
    const lesson = this.#lesson;
    if (isDragging() || !lesson.deformer) return;
    // Its end is drawn, and comes to rest again.
    void lesson.finishBounded();
    if (lesson.deformer.isFinishing) return;
    const { address } = lesson;
    if (location.hash !== '' || address !== 'man') writeAddress(address);
    const { picked, handles } = lesson;
    this.#live.textContent = handles[picked] ? `${lesson.describe(picked)}.` : '';
    const rests = handles.map(({ rest, end }) => `${rest} ${end}`).join(';');
    if (rests !== this.#handlesSeen || this.#meshSeen !== lesson.mesh) {
      [this.#handlesSeen, this.#meshSeen] = [rests, lesson.mesh];
      this.#requirements.refresh();
    } else this.#requirements.resume();
    this.#tellIslands();
    const { flips } = lesson;
    this.#flips.textContent = flips === 0 ? '' : ` ${flips} ${flips === 1 ? 'triangle is' : 'triangles are'} turned over.`;
    this.#strip.refresh();
    this.#main.dataset.rest = 'yes';
  }

  #tellIslands(): void {
    const { deformer, method, handles } = this.#lesson;
    const kind = weightsOf(method);
    const islands = deformer && kind && handles.length > 0 && deformer.isReady(method) ? deformer.weights(kind).islands : [];
    this.#islands.hidden = islands.length === 0;
    this.#islands.textContent = islands
      .map(
        ({ count, first, handle }) =>
          `A piece of ${count} vertices (${first} is its first) holds no handle: all of it follows handle ${handle}, the nearest.`,
      )
      .join(' ');
  }

  #busy(said: string | undefined, part?: number): void {
    // What prepares interior distances has the note for itself.
    if (this.#baking) return;
    this.#note.hidden = said === undefined;
    if (said === undefined) return;
    this.#note.replaceChildren(said, ...(part === undefined ? [] : [h('progress', { max: 1, value: part, 'aria-label': said })]));
  }

  // Interior radial basis functions

  /** Prepares a kind of distances; where that is cancelled or fails, the method is again the one that the picture is of. */
  async #bake(method: Method): Promise<void> {
    const lesson = this.#lesson;
    const { deformer } = lesson;
    const kind = method.kind as DistanceKind;
    if (!deformer) return;
    if (deformer.hasSlab(kind)) {
      this.#answered = method.id;
      return;
    }
    if (this.#baking?.deformer === deformer && this.#baking.kind === kind) return;
    this.#baking?.stop.abort();
    const stop = new AbortController();
    const baking = { deformer, kind, stop };
    this.#baking = baking;
    const bar = h('progress', { max: 1, value: 0, 'aria-label': 'Preparing interior distances' });
    this.#note.replaceChildren(
      h('span', {}, kind === 'interior' ? 'Measuring distances through the inside …' : 'Measuring distances …'),
      bar,
      h('button', { type: 'button', class: 'button small', onclick: () => stop.abort() }, 'Cancel'),
    );
    this.#note.hidden = false;
    let refused: unknown;
    try {
      const { bakeSlab } = await slabPart(lesson.address);
      const slab = await bakeSlab(deformer.hb, deformer.mesh, kind, {
        signal: stop.signal,
        onProgress: (part) => {
          bar.value = part;
        },
        onFallback: () => this.trouble.tell(withoutWorker()),
      });
      if (lesson.deformer === deformer) deformer.setSlab(kind, slab);
      else slab.dispose();
    } catch (error) {
      refused = error;
    }
    // Something else is being prepared.
    if (this.#baking !== baking) return;
    this.#baking = undefined;
    // What was stopped by a button there.
    const focused = this.#note.contains(document.activeElement);
    this.#busy(undefined);
    const asked = lesson.deformer === deformer && lesson.method.id === method.id;
    if (refused !== undefined && asked) lesson.setMethod(this.#answered);
    if (refused !== undefined && !stop.signal.aborted)
      this.trouble.tell(refused, refused instanceof NotFetched ? () => lesson.setMethod(method.id) : undefined);
    // Another shape may have come meanwhile, for which nothing is prepared.
    this.#structure();
    if (focused) this.#methods.focus();
    lesson.redraw();
  }
}

function noRoom(handles: number): PageError {
  return handles >= MOST_HANDLES
    ? new PageError('too-many-handles', `There are ${handles} handles already.`, 'Remove one to add another.')
    : new PageError('no-room', 'There is no room for a bone here.', 'Add a point, or move other handles away.');
}

function withoutWorker(): PageError {
  return new PageError(
    'worker-unavailable',
    'No second thread could be started here: while distances are measured, the page answers late.',
    'Open the page in a window of its own if it takes too long.',
  );
}
