import { h } from '../../ui/dom.ts';
import type { Kit, OpenPanel, Panel } from './figure.ts';

/** A panel of the figure, where it lies, and itself once it was shown. */
interface Slot<M, S> {
  readonly panel: Panel<M, S>;
  readonly place: HTMLElement;
  opened?: OpenPanel<M, S>;
}

/** The panels of a figure: opened when a state first shows them, in the page only while one does. */
export class Panels<M, S> {
  readonly #slots: readonly Slot<M, S>[];
  /** What the pictures are to show alone: the rest fades. */
  #emphasis: number | undefined;
  #disposed = false;

  constructor(panels: readonly Panel<M, S>[]) {
    this.#slots = panels.map((panel) => {
      const place = h('div', { hidden: true });
      place.style.display = 'contents';
      return { panel, place };
    });
  }

  /** The elements in which those lie that want this place. */
  at(wanted: Panel<M, S>['place']): readonly HTMLElement[] {
    return this.#slots.filter(({ panel }) => panel.place === wanted).map(({ place }) => place);
  }

  /** Opens those that a state shows; what has to be fetched first comes later. */
  open(kit: Kit<S, M>, state: S): Promise<unknown> | undefined {
    const coming = this.#slots.flatMap((slot) => {
      if (slot.opened || !(slot.panel.shown?.(state) ?? true)) return [];
      const opening = slot.panel.open(kit);
      const keep = (opened: OpenPanel<M, S>) => {
        if (slot.opened || this.#disposed) opened.dispose?.();
        else slot.opened = opened;
      };
      return opening instanceof Promise ? [opening.then(keep)] : (keep(opening) ?? []);
    });
    return coming.length > 0 ? Promise.all(coming) : undefined;
  }

  /** Draws those that a state shows; how many of them are pictures. */
  draw(made: M, state: S): number {
    let count = 0;
    for (const { panel, place, opened } of this.#slots) {
      const shown = opened !== undefined && (panel.shown?.(state) ?? true);
      place.hidden = !shown;
      // What is not shown is not in the page, so that nothing finds it there.
      if (!shown) place.replaceChildren();
      else if (opened.element.parentElement !== place) place.append(opened.element);
      if (shown && !panel.place) count++;
    }
    for (const { place, opened } of this.#slots) if (!place.hidden) opened?.draw(made, state);
    this.#fade();
    return count;
  }

  refine(made: M, state: S): void {
    for (const { place, opened } of this.#slots) if (!place.hidden) opened?.refine?.(made, state);
  }

  /** Lets all in the pictures fade but what has this `data-key`; nothing for none. */
  emphasize(key: number | undefined): void {
    this.#emphasis = key;
    this.#fade();
  }

  dispose(): void {
    this.#disposed = true;
    for (const { opened } of this.#slots) opened?.dispose?.();
  }

  #fade(): void {
    const key = this.#emphasis === undefined ? undefined : String(this.#emphasis);
    for (const place of this.at(undefined))
      for (const element of place.querySelectorAll<HTMLElement | SVGElement>('[data-key]'))
        element.toggleAttribute('data-faded', key !== undefined && element.dataset.key !== key);
  }
}
