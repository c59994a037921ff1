import { h } from '../../ui/dom.ts';
import { focusNeighbor } from '../../ui/focus.ts';
import { Card, type CardActions } from './card.ts';
import type { Settings } from './experiment.ts';
import type { Fit } from './fit.ts';
import { isOffered, OFFERS } from './interpolants.ts';

interface ModelActions extends CardActions {
  add(kind: string, settings: Settings): void;
}

/** The interpolants on the page, a card each, and the menu that adds more. */
export class ModelList {
  readonly element: HTMLElement;
  readonly #list = h('ul', { class: 'cards' });
  readonly #menu = h('div', { class: 'offers' });
  readonly #add: HTMLDetailsElement;
  readonly #actions: ModelActions;
  readonly #cards = new Map<number, Card>();
  /** Which cards somebody opened or closed. */
  readonly #opened = new Map<number, boolean>();
  #dimension: 1 | 2 = 1;

  constructor(actions: ModelActions) {
    this.#actions = actions;
    this.#add = h('details', { class: 'add' }, h('summary', { class: 'button' }, 'Add an interpolant'), this.#menu);
    this.#add.addEventListener('keydown', (event) => {
      if (event.key !== 'Escape' || !this.#add.open) return;
      this.#add.open = false;
      this.#add.querySelector('summary')?.focus();
    });
    this.element = h(
      'section',
      { 'aria-labelledby': 'models-title' },
      h('h2', { id: 'models-title' }, 'Interpolants'),
      this.#list,
      this.#add,
    );
  }

  /** Makes the cards anew where interpolants came, went or changed their dimension. */
  list(fits: readonly Fit[], dimension: 1 | 2): void {
    if (dimension !== this.#dimension || this.#menu.childElementCount === 0) {
      this.#dimension = dimension;
      this.#offer();
    }
    for (const [key, card] of this.#cards) this.#opened.set(key, card.opened);
    const kept = new Map<number, Card>();
    for (const fit of fits) {
      const { key } = fit.model;
      const old = this.#cards.get(key);
      const open = this.#opened.get(key) ?? fits.length <= 2;
      kept.set(key, old?.fit === fit ? old : new Card(fit, dimension, open, this.#actions));
    }
    this.#cards.clear();
    for (const [key, card] of kept) this.#cards.set(key, card);
    const elements = [...kept.values()].map(({ element }) => element);
    if (elements.some((element, i) => this.#list.children[i] !== element) || elements.length !== this.#list.childElementCount)
      this.#list.replaceChildren(...elements);
  }

  update(tolerance: number): void {
    for (const card of this.#cards.values()) card.update(tolerance);
  }

  /** Opens a card and takes the keyboard there. */
  reveal(key: number): void {
    this.#cards.get(key)?.open(true);
    this.#cards.get(key)?.name.focus();
  }

  /** Where the keyboard goes when card `i` is gone. */
  focusNear(i: number): void {
    const names = [...this.#cards.values()].map(({ name }) => name);
    focusNeighbor(names, i, this.#add.querySelector('summary'));
  }

  #offer(): void {
    const groups = OFFERS.map(({ group, offers }) => ({
      group,
      offers: offers.filter(({ kind }) => isOffered(kind, this.#dimension)),
    })).filter(({ offers }) => offers.length > 0);
    this.#menu.replaceChildren(
      ...groups.map(({ group, offers }) =>
        h(
          'div',
          { role: 'group', 'aria-label': group },
          h('h3', {}, group),
          h(
            'div',
            { class: 'offer-row' },
            ...offers.map(({ kind, settings, name }) =>
              h('button', { type: 'button', class: 'chip', onclick: () => this.#choose(kind, settings) }, name),
            ),
          ),
        ),
      ),
    );
  }

  #choose(kind: string, settings: Settings): void {
    this.#add.open = false;
    this.#actions.add(kind, settings);
  }
}
