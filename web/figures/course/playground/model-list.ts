import { button, h } from '../../../ui/dom.ts';
import { focusNeighbor } from '../../../ui/focus.ts';
import { PageError } from '../../../ui/page-error.ts';
import type { Kit, OpenPanel } from '../../kit/figure.ts';
import { Card } from './card.ts';
import type { State } from './channels.ts';
import { MOST_MODELS, type Model, type Settings } from './experiment.ts';
import { type Fits, toleranceOf } from './fits.ts';
import { isOffered, kindOf, modelOf, OFFERS } from './interpolants.ts';

/** The interpolants, a card each, and the menu that adds more. */
export class ModelList implements OpenPanel<Fits, State> {
  readonly element: HTMLElement;
  readonly #list = h('ul', { class: 'cards' });
  readonly #menu = h('div', { class: 'offers stack' });
  readonly #add: HTMLDetailsElement;
  readonly #kit: Kit<State>;
  readonly #cards = new Map<number, Card>();
  /** Which cards somebody opened or closed. */
  readonly #opened = new Map<number, boolean>();
  #dimension = 0;

  constructor(kit: Kit<State>) {
    this.#kit = kit;
    this.#add = h('details', { class: 'add' }, h('summary', { class: 'button' }, 'Add an interpolant'), this.#menu);
    this.#add.addEventListener('keydown', (event) => {
      if (event.key !== 'Escape' || !this.#add.open) return;
      this.#add.open = false;
      this.#add.querySelector('summary')?.focus();
    });
    this.element = h(
      'section',
      { class: 'stack', 'aria-label': 'Interpolants' },
      h('h3', {}, 'Interpolants'),
      this.#list,
      this.#add,
    );
  }

  draw({ list }: Fits, state: State): void {
    if (state.d !== this.#dimension) this.#offer(state.d);
    this.#dimension = state.d;
    for (const [key, card] of this.#cards) this.#opened.set(key, card.opened);
    const old = new Map(this.#cards);
    this.#cards.clear();
    for (const fit of list) {
      const { key } = fit.model;
      const [known, open] = [old.get(key), this.#opened.get(key) ?? list.length <= 2];
      this.#cards.set(key, known?.fit === fit ? known : new Card(fit, state.d, open, this.#actions));
    }
    const cards = [...this.#cards.values()];
    if (cards.some(({ element }, i) => this.#list.children[i] !== element) || cards.length !== this.#list.childElementCount)
      this.#list.replaceChildren(...cards.map(({ element }) => element));
    for (const card of cards) card.update(toleranceOf(state));
  }

  readonly #actions = {
    set: (key: number, settings: Settings) =>
      this.#replace(key, (model) => ({ ...model, settings: { ...model.settings, ...settings } })),
    setShown: (key: number, shown: boolean) => this.#replace(key, (model) => ({ ...model, shown })),
    remove: (key: number) => {
      const { m } = this.#kit.state;
      const i = m.findIndex((model) => model.key === key);
      this.#kit.emphasize();
      this.#kit.change({ m: m.filter((model) => model.key !== key) });
      requestAnimationFrame(() => this.#focusNear(i));
    },
    emphasize: (key?: number) => this.#kit.emphasize(key),
  };

  #replace(key: number, change: (model: Model) => Model): void {
    this.#kit.change({ m: this.#kit.state.m.map((model) => (model.key === key ? change(model) : model)) });
  }

  /** Where the keyboard goes when card `i` is gone. */
  #focusNear(i: number): void {
    const names = [...this.#cards.values()].map(({ name }) => name);
    focusNeighbor(names, i, this.#add.querySelector('summary'));
  }

  #offer(dimension: 1 | 2): void {
    const groups = OFFERS.map(({ group, offers }) => ({
      group,
      offers: offers.filter(({ kind }) => isOffered(kind, dimension)),
    })).filter(({ offers }) => offers.length > 0);
    this.#menu.replaceChildren(
      ...groups.map(({ group, offers }) =>
        h(
          'div',
          { role: 'group', 'aria-label': group },
          h('h4', { class: 'soft' }, group),
          h(
            'div',
            { class: 'tools' },
            ...offers.map(({ kind, settings, name }) => button(name, () => this.#choose(kind, settings))),
          ),
        ),
      ),
    );
  }

  #choose(id: string, settings: Settings): void {
    const [kind, { m }] = [kindOf(id), this.#kit.state];
    this.#add.open = false;
    if (!kind || m.length >= MOST_MODELS) {
      this.#kit.tell(tooMany());
      this.#focusNear(MOST_MODELS);
      return;
    }
    const model = modelOf(kind, settings, m);
    this.#kit.change({ m: [...m, model] });
    // The card is there after the next frame.
    requestAnimationFrame(() => {
      this.#cards.get(model.key)?.open(true);
      this.#cards.get(model.key)?.name.focus();
    });
  }
}

function tooMany(): PageError {
  return new PageError('too-many-interpolants', `There are ${MOST_MODELS} interpolants already.`, 'Remove one to add another.');
}
