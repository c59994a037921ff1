import type { HandlebodyRuntime } from '../../../wasm/ts/runtime.ts';
import { byId, h } from '../../ui/dom.ts';
import { Caption } from './caption.ts';
import { copyOf, type Experiment } from './experiment.ts';
import { Film } from './film.ts';
import { Legend } from './legend.ts';
import { LineView } from './line-view.ts';
import { ModelList } from './model-list.ts';
import { Playground } from './playground.ts';
import { PointTable } from './point-table.ts';
import { presetOf } from './presets.ts';
import { outlierText } from './report.ts';
import { ShowPanel } from './show-panel.ts';
import type { View } from './view.ts';

/** Brings the parts of the page together. */
export class Page {
  readonly #playground: Playground;
  readonly #caption = new Caption(byId('title'));
  readonly #legend = new Legend();
  readonly #film: Film;
  readonly #models: ModelList;
  readonly #show: ShowPanel;
  readonly #table: PointTable;
  readonly #live = byId('live');
  readonly #picture = byId('picture');
  readonly #remove: HTMLButtonElement;
  readonly #views = new Map<1 | 2, View>();
  /** The experiment of the other dimension, as it was left. */
  readonly #left = new Map<1 | 2, Experiment>();

  constructor(hb: HandlebodyRuntime) {
    const playground = new Playground(hb, {
      stir: () => {
        byId('playground').dataset.rest = 'no';
      },
      structure: () => this.#structure(),
      frame: () => this.#frame(),
      rest: (_, said) => this.#rest(said),
    });
    this.#playground = playground;
    this.#film = new Film(hb);
    this.#models = new ModelList({
      add: (kind, settings) => {
        const fit = playground.addModel(kind, settings);
        if (fit) requestAnimationFrame(() => this.#models.reveal(fit.model.key));
      },
      set: (key, settings) => playground.setModel(key, settings),
      setShown: (key, shown) => playground.setShown(key, shown),
      remove: (key) => {
        playground.removeModel(key);
        requestAnimationFrame(() => this.#models.focusAdd());
      },
      emphasize: (key) => playground.emphasize(key),
    });
    this.#show = new ShowPanel((show) => playground.setShow(show));
    this.#table = new PointTable({
      type: (i, column, number) => playground.type(i, column, number),
      pick: (i) => playground.pick(i),
      remove: (i) => playground.remove(i),
      add: () => playground.add(),
    });
    this.#remove = h('button', { type: 'button', class: 'button small', onclick: () => this.#removePicked() }, 'Remove');
    byId('tools').append(
      h('button', { type: 'button', class: 'button small', id: 'add-point', onclick: () => playground.add() }, 'Add a point'),
      this.#remove,
      h('button', { type: 'button', class: 'button small', onclick: () => playground.fitFrame() }, 'Fit view'),
    );
    this.#picture.after(this.#legend.element, this.#caption.element, h('nav', { 'aria-label': 'Figures' }, this.#film.element));
    byId('panel').append(this.#models.element, this.#show.element, this.#table.element);
    for (const input of document.querySelectorAll<HTMLInputElement>('input[name=dimension]'))
      input.addEventListener('change', () => this.#turnTo(Number(input.value) as 1 | 2));
    byId('copy').addEventListener('click', () => void this.#copy());
    addEventListener('hashchange', () => playground.open(location.hash));
    playground.open(location.hash);
  }

  /** To the line or the plane, as it was left. */
  #turnTo(dimension: 1 | 2): void {
    const { experiment } = this.#playground;
    if (dimension === experiment.dimension) return;
    this.#left.set(experiment.dimension, copyOf(experiment));
    const next = this.#left.get(dimension) ?? presetOf(dimension === 1 ? 'line' : 'plane')?.make();
    if (!next) return;
    this.#playground.start(copyOf(next));
    history.pushState(null, '', `#${this.#playground.address}`);
  }

  #structure(): void {
    const { experiment, fits, hb } = this.#playground;
    const { dimension } = experiment;
    byId('playground').dataset.dimension = String(dimension);
    for (const input of document.querySelectorAll<HTMLInputElement>('input[name=dimension]'))
      input.checked = input.value === String(dimension);
    this.#playground.view = this.#views.get(dimension);
    if (this.#playground.view) this.#put(this.#playground.view);
    else void this.#makeView(dimension, hb);
    this.#models.list(fits, dimension);
    this.#legend.list(fits);
    this.#caption.show(experiment.preset, false);
  }

  /** The plane's part is fetched when somebody goes there. */
  async #makeView(dimension: 1 | 2, hb: HandlebodyRuntime): Promise<void> {
    const playground = this.#playground;
    const view =
      dimension === 1
        ? new LineView(hb, playground, () => playground.redraw())
        : new (await import('./plane-view.ts')).PlaneView(playground);
    if (!this.#views.has(dimension)) this.#views.set(dimension, view);
    if (playground.experiment.dimension !== dimension) return;
    playground.view = this.#views.get(dimension);
    this.#put(view);
    playground.redraw();
  }

  #put(view: View): void {
    if (view.element.parentElement !== this.#picture) this.#picture.replaceChildren(view.element);
  }

  #frame(): void {
    const { experiment, tolerance, found, view, fits } = this.#playground;
    this.#models.update(tolerance);
    this.#show.update(experiment, outlierText(found));
    this.#table.update(experiment);
    this.#legend.update(fits);
    this.#legend.element.hidden = view?.named ?? false;
    this.#remove.disabled = experiment.picked < 0 || experiment.values.length === 1;
    this.#remove.textContent = experiment.picked < 0 ? 'Remove' : `Remove point ${experiment.picked}`;
  }

  #rest(said: string): void {
    this.#write();
    this.#live.textContent = said;
    byId('playground').dataset.rest = this.#playground.view ? 'yes' : 'no';
  }

  /** The address says what the page shows. */
  #write(): void {
    const { address, experiment } = this.#playground;
    if (`#${address}` !== location.hash && !(location.hash === '' && address === experiment.preset))
      history.replaceState(null, '', `#${address}`);
    this.#caption.show(experiment.preset, address !== experiment.preset);
    this.#film.show(address === experiment.preset ? address : '');
  }

  async #copy(): Promise<void> {
    const button = byId('copy');
    const say = (text: string) => {
      button.textContent = text;
      this.#live.textContent = text;
      setTimeout(() => {
        button.textContent = 'Copy link';
      }, 2000);
    };
    this.#write();
    try {
      await navigator.clipboard.writeText(location.href);
      say('Copied');
    } catch {
      say('It is in the address bar');
    }
  }

  #removePicked(): void {
    const { picked } = this.#playground;
    this.#playground.remove(picked);
    requestAnimationFrame(() => this.#playground.view?.focusPoint(Math.min(picked, this.#playground.count - 1)));
  }
}
