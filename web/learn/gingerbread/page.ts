import type { Handlebody } from '../../../wasm/ts/index.ts';
import type { Shape } from '../../models/shape.ts';
import { byId, h } from '../../ui/dom.ts';
import { explain } from '../../ui/explain.ts';
import { initial, portable } from './address.ts';
import { captionOf, legend } from './captions.ts';
import { type ShapeName, VERTICES } from './experiment.ts';
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
  readonly #trouble = byId('trouble');
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
  #baking: AbortController | undefined;
  #handlesSeen = '';
  #meshSeen: unknown;

  constructor(picture: Picture) {
    const area = byId('picture');
    const size = () => picture.resize(area.clientWidth, area.clientHeight);
    size();
    const lesson = new Lesson(picture, {
      mesh: () => this.#mesh(),
      structure: () => this.#structure(),
      frame: () => this.#frame(),
      busy: (said, part) => this.#busy(said, part),
      trouble: (error) => this.#tell(error),
      rest: () => this.#rest(),
    });
    this.#lesson = lesson;
    this.#handles = new Handles(byId('overlay'), lesson, () => this.#pause());
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
      cancel: () => this.#markShape(),
      trouble: (error) => this.#tell(error),
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
      onchange: () => lesson.setVertices(this.#vertices.valueAsNumber),
    });
    this.#remove = h('button', { type: 'button', class: 'button small', onclick: () => lesson.remove(lesson.picked) }, 'Remove');
    this.#lay();
    new ResizeObserver(() => {
      size();
      lesson.redraw();
      this.#strip.refresh();
    }).observe(area);
    const canvas = byId('canvas');
    canvas.addEventListener('webglcontextlost', () =>
      this.#busy('The graphics card was interrupted; the picture comes back by itself.'),
    );
    canvas.addEventListener('webglcontextrestored', () => {
      this.#busy(undefined);
      lesson.redraw();
    });
    for (const input of document.querySelectorAll<HTMLInputElement>('input[name=shape]'))
      input.addEventListener('change', () => this.#turnTo(input.value as ShapeName));
    byId('copy').addEventListener('click', () => void this.#copy());
    addEventListener('hashchange', () => lesson.open(location.hash));
    listenForFiles(this.#file, byId('veil'), (file) => void this.#takeFile(file));
    this.#mesh();
    this.#structure();
    lesson.redraw();
  }

  connect(hb: Handlebody): void {
    this.#lesson.connect(hb);
  }

  #lay(): void {
    const button = (id: string, text: string, act: () => void) =>
      h('button', { type: 'button', class: 'button small', id, onclick: act }, text);
    const added = (add: () => boolean) => () => {
      if (!add()) return;
      this.#handles.draw();
      this.#handles.focus(this.#lesson.picked);
    };
    byId('tools').append(
      button(
        'add-point',
        'Add a point',
        added(() => this.#lesson.addPoint()),
      ),
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
    this.#own.hide();
    if (this.#lesson.start({ ...initial(shape), method: this.#lesson.experiment.method }))
      history.pushState(null, '', `#${this.#lesson.address}`);
  }

  #takeOutline(outline: Shape, painting?: PaintedShape): void {
    const { method } = this.#lesson.experiment;
    if (!this.#lesson.start({ ...initial('own', portable(outline)), method }, painting)) return;
    this.#own.hide();
    history.pushState(null, '', `#${this.#lesson.address}`);
  }

  #markShape(): void {
    for (const input of document.querySelectorAll<HTMLInputElement>('input[name=shape]'))
      input.checked = input.value === this.#lesson.experiment.shape;
  }

  async #takeFile(file: File): Promise<void> {
    try {
      this.#busy('Tracing the picture …');
      // Only who opens a picture needs what traces it.
      const { openPicture } = await import('./open-picture.ts');
      const { outline, painting } = await openPicture(file);
      this.#takeOutline(outline, painting);
    } catch (error) {
      this.#tell(error);
    } finally {
      this.#busy(undefined);
    }
  }

  #mesh(): void {
    const { experiment, mesh } = this.#lesson;
    const known = shapeOf(experiment.shape);
    byId('title').textContent = known?.name ?? 'Your own shape';
    this.#markShape();
    this.#vertices.value = String(experiment.vertices);
    const [vertices, triangles] = [mesh.positions.length / 2, mesh.triangles.length / 3];
    this.#facts.textContent = `${vertices.toLocaleString('en')} vertices, ${triangles.toLocaleString('en')} triangles, smallest angle ${mesh.smallestAngle.toFixed(1)}°.`;
    this.#poses.replaceChildren(
      h('button', { type: 'button', class: 'button small', onclick: () => this.#lesson.rest() }, 'Rest pose'),
      ...(known?.poses ?? []).map(({ name, handles, method }) =>
        h('button', { type: 'button', class: 'button small', onclick: () => this.#lesson.strike(handles(), method) }, name),
      ),
    );
    this.#baking?.abort();
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
    if (method.family === 'irbf') void this.#bake(method);
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
    if (this.#handles.dragging || !lesson.deformer) return;
    // Its end is drawn, and comes to rest again.
    void lesson.finishBounded();
    if (lesson.deformer.isFinishing) return;
    const { address } = lesson;
    if (location.hash.slice(1) !== address && !(location.hash === '' && address === 'man'))
      history.replaceState(null, '', `#${address}`);
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

  #tell(error: unknown): void {
    this.#trouble.hidden = error === undefined;
    if (error === undefined) return;
    const { message, remedy } = explain(error);
    this.#trouble.textContent = `${message} ${remedy}`;
  }

  // Interior radial basis functions

  async #bake({ kind }: Method): Promise<void> {
    const { deformer } = this.#lesson;
    if (!deformer || deformer.hasSlab(kind as DistanceKind) || this.#baking) return;
    const baking = new AbortController();
    this.#baking = baking;
    const bar = h('progress', { max: 1, value: 0, 'aria-label': 'Preparing interior distances' });
    this.#note.replaceChildren(
      h('span', {}, kind === 'interior' ? 'Measuring distances through the inside …' : 'Measuring distances …'),
      bar,
      h('button', { type: 'button', class: 'button small', onclick: () => baking.abort() }, 'Cancel'),
    );
    this.#note.hidden = false;
    try {
      const { bakeSlab } = await import('./interior.ts');
      const slab = await bakeSlab(deformer.hb, deformer.mesh, kind as DistanceKind, {
        signal: baking.signal,
        onProgress: (part) => {
          bar.value = part;
        },
      });
      if (this.#lesson.deformer === deformer) deformer.setSlab(kind as DistanceKind, slab);
      else slab.dispose();
    } catch (error) {
      if (!baking.signal.aborted) this.#tell(error);
    } finally {
      this.#baking = undefined;
      this.#busy(undefined);
    }
    this.#lesson.redraw();
  }

  async #copy(): Promise<void> {
    const { address } = this.#lesson;
    history.replaceState(null, '', `#${address}`);
    try {
      await navigator.clipboard.writeText(location.href);
      this.#live.textContent = 'The link is copied.';
      byId('copy').textContent = 'Copied';
      setTimeout(() => {
        byId('copy').textContent = 'Copy link';
      }, 1500);
    } catch {
      this.#live.textContent = 'The link is in the address bar.';
    }
  }
}
