import type { HandlebodyRuntime } from '../../../wasm/ts/runtime.ts';
import { leftOut, writeAddress } from '../../ui/address.ts';
import { copyLink } from '../../ui/copy-link.ts';
import { byId, h } from '../../ui/dom.ts';
import { focusNeighbor } from '../../ui/focus.ts';
import { lazy, NotFetched } from '../../ui/lazy.ts';
import { PageError } from '../../ui/page-error.ts';
import { Trouble } from '../../ui/trouble.ts';
import { fromAddress, toAddress } from './address.ts';
import { Caption } from './caption.ts';
import { copyOf, type Experiment, MOST_MODELS, MOST_POINTS } from './experiment.ts';
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

const planeView = lazy(() => import('./plane-view.ts'), 'The part of this page that draws the plane');

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
  readonly #add: HTMLButtonElement;
  readonly #remove: HTMLButtonElement;
  readonly #views = new Map<1 | 2, View>();
  /** The experiment of the other dimension, as it was left. */
  readonly #left = new Map<1 | 2, Experiment>();
  readonly #trouble = new Trouble(byId('trouble'), () => document.querySelector('input[name=dimension]:checked'));
  /** What was asked for last: shown, or on its way. */
  #wanted: Experiment | undefined;

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
        if (!fit) this.#trouble.tell(tooMany());
        requestAnimationFrame(() => (fit ? this.#models.reveal(fit.model.key) : this.#models.focusNear(MOST_MODELS)));
      },
      set: (key, settings) => playground.setModel(key, settings),
      setShown: (key, shown) => playground.setShown(key, shown),
      remove: (key) => {
        const i = playground.fits.findIndex(({ model }) => model.key === key);
        playground.removeModel(key);
        requestAnimationFrame(() => this.#models.focusNear(i));
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
    const addPoint = { type: 'button', class: 'button small', id: 'add-point', onclick: () => playground.add() };
    this.#add = h('button', addPoint, 'Add a point');
    byId('tools').append(
      this.#add,
      this.#remove,
      h('button', { type: 'button', class: 'button small', onclick: () => playground.fitFrame() }, 'Fit view'),
    );
    this.#picture.after(this.#legend.element, this.#caption.element, h('nav', { 'aria-label': 'Figures' }, this.#film.element));
    byId('panel').append(this.#models.element, this.#show.element, this.#table.element);
    for (const input of document.querySelectorAll<HTMLInputElement>('input[name=dimension]'))
      input.addEventListener('change', () => this.#turnTo(Number(input.value) as 1 | 2));
    copyLink(byId('copy'), this.#live, () => this.#write());
    addEventListener('hashchange', () => this.#follow());
    this.#follow();
  }

  /** Shows what the address says, as far as it can be read. */
  #follow(): void {
    const left: string[] = [];
    const next = fromAddress(location.hash, left);
    void this.#open(next, false, leftOut(left));
  }

  /** To the line or the plane, as it was left. */
  #turnTo(dimension: 1 | 2): void {
    const { experiment } = this.#playground;
    const next = this.#left.get(dimension) ?? presetOf(dimension === 1 ? 'line' : 'plane')?.make();
    if (dimension !== experiment.dimension) {
      if (next) void this.#open(copyOf(next), true);
      return;
    }
    // Back before the other one has come.
    this.#wanted = experiment;
    this.#playground.settle();
  }

  /**
   * Shows another experiment. What was shown stays until the view that it needs has come, and for good where that does not come. `turned`:
   * by the switch, which leads back.
   */
  async #open(next: Experiment, turned: boolean, said?: PageError): Promise<void> {
    const playground = this.#playground;
    const { dimension } = next;
    this.#wanted = next;
    this.#trouble.clear();
    byId('playground').dataset.rest = 'no';
    // At first there is nothing to stay, and the controls wait for nobody.
    if (!playground.view) playground.start(next);
    try {
      if (!this.#views.has(dimension)) this.#views.set(dimension, await this.#makeView(dimension, toAddress(next)));
    } catch (error) {
      const again = error instanceof NotFetched ? () => void this.#open(next, turned, said) : undefined;
      if (this.#wanted === next) this.#refuse(error, again);
      return;
    }
    if (this.#wanted !== next) return;
    const { experiment } = playground;
    if (turned) this.#left.set(experiment.dimension, copyOf(experiment));
    playground.view = this.#views.get(dimension) as View;
    if (playground.experiment === next) playground.redraw();
    else playground.start(next);
    const { element } = playground.view;
    if (element.parentElement !== this.#picture) this.#picture.replaceChildren(element);
    if (turned) writeAddress(playground.address, true);
    if (said) this.#trouble.tell(said);
  }

  /** What was asked for does not come: switch and address say again what is shown. */
  #refuse(error: unknown, again?: () => void): void {
    const { experiment } = this.#playground;
    this.#wanted = experiment;
    this.#mark(experiment.dimension);
    this.#trouble.tell(error, again);
    this.#playground.settle();
  }

  #mark(dimension: 1 | 2): void {
    for (const input of document.querySelectorAll<HTMLInputElement>('input[name=dimension]'))
      input.checked = input.value === String(dimension);
  }

  /** The plane's part is fetched when somebody goes there. */
  async #makeView(dimension: 1 | 2, state: string): Promise<View> {
    const playground = this.#playground;
    if (dimension === 1) return new LineView(playground.hb, playground, () => playground.redraw());
    const { PlaneView } = await planeView(state);
    return new PlaneView(playground);
  }

  #structure(): void {
    const { experiment, fits } = this.#playground;
    const { dimension } = experiment;
    byId('playground').dataset.dimension = String(dimension);
    this.#mark(dimension);
    this.#models.list(fits, dimension);
    this.#legend.list(fits);
    this.#caption.show(experiment.preset, false);
  }

  #frame(): void {
    const { experiment, tolerance, found, view, fits } = this.#playground;
    this.#models.update(tolerance);
    this.#show.update(experiment, outlierText(found));
    this.#table.update(experiment);
    this.#legend.update(fits);
    this.#legend.element.hidden = view?.named ?? false;
    this.#add.disabled = experiment.values.length >= MOST_POINTS;
    this.#remove.disabled = experiment.picked < 0 || experiment.values.length === 1;
    this.#remove.textContent = experiment.picked < 0 ? 'Remove' : `Remove point ${experiment.picked}`;
  }

  #rest(said: string): void {
    // What was asked for is still on its way.
    if (this.#wanted !== this.#playground.experiment) return;
    this.#write();
    this.#live.textContent = said;
    byId('playground').dataset.rest = this.#playground.view ? 'yes' : 'no';
  }

  /** The address says what the page shows. */
  #write(): void {
    const { address, experiment } = this.#playground;
    if (location.hash !== '' || address !== experiment.preset) writeAddress(address);
    this.#caption.show(experiment.preset, address !== experiment.preset);
    this.#film.show(address === experiment.preset ? address : '');
  }

  #removePicked(): void {
    const { picked } = this.#playground;
    this.#playground.remove(picked);
    requestAnimationFrame(() => {
      const { view, count } = this.#playground;
      focusNeighbor([view?.handle(Math.min(picked, count - 1))], 0, this.#add);
    });
  }
}

function tooMany(): PageError {
  return new PageError('too-many-interpolants', `There are ${MOST_MODELS} interpolants already.`, 'Remove one to add another.');
}
