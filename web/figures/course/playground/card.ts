import { button, h, write } from '../../../ui/dom.ts';
import { type PartShown, partControls } from '../../kit/controls.ts';
import { swatch } from '../../kit/swatch.ts';
import { brief, conditionText, health } from '../../kit/words.ts';
import type { Setting, Settings } from './experiment.ts';
import type { Fit } from './fit.ts';
import { kindOf } from './interpolants.ts';
import { takes } from './kind.ts';
import { WarningList } from './warning-list.ts';
import { WeightList } from './weight-list.ts';

interface CardActions {
  set(key: number, settings: Settings): void;
  setShown(key: number, shown: boolean): void;
  remove(key: number): void;
  /** Somebody looks at this one; or at none. */
  emphasize(key?: number): void;
}

let nextId = 1;

/** One interpolant in the panel: what it is, what it is worth, what can be set. */
export class Card {
  readonly element: HTMLElement;
  readonly fit: Fit;
  readonly #name = h('span', { class: 'name' });
  readonly #detail = h('span', { class: 'detail soft' });
  readonly #shown: HTMLInputElement;
  readonly #verdict = h('p', { class: 'verdict soft' });
  readonly #condition = h('span', { class: 'condition' });
  readonly #misfit = h('span');
  readonly #controls: PartShown<Settings>;
  readonly #warnings: WarningList;
  readonly #weights = new WeightList();
  readonly #body: HTMLElement;
  readonly #toggle: HTMLButtonElement;
  readonly #remove: HTMLButtonElement;

  constructor(fit: Fit, dimension: 1 | 2, open: boolean, actions: CardActions) {
    const { key, kind, slot } = fit.model;
    this.fit = fit;
    this.#shown = h('input', { type: 'checkbox', onchange: () => actions.setShown(key, this.#shown.checked) });
    const { parameters = {}, when = {} } = kindOf(kind) ?? {};
    const parts = Object.entries(parameters).map(([id, parameter]) => ({
      parameter: () => parameter,
      read: (settings: Settings) => settings[id] ?? parameter.initial,
      write: (_: Settings, value: Setting) => ({ [id]: value }),
      when: (settings: Settings) => when[id]?.(settings, dimension) ?? true,
    }));
    this.#controls = partControls<Settings>(parts, fit.model.settings, (part, value) =>
      actions.set(key, part.write({}, value as never) as Settings),
    );
    this.#warnings = new WarningList(
      (settings) => takes(parameters, settings),
      (settings) => actions.set(key, settings),
      this.#shown,
    );
    this.#verdict.append(this.#condition, this.#misfit);

    const id = `card-${nextId++}`;
    this.#body = h('div', { class: 'card-body stack', id, hidden: !open }, this.#controls.element, this.#weights.element);

    this.#toggle = button('', () => this.open(this.#body.hidden), 'dismiss chevron', { 'aria-controls': id });
    this.#toggle.ariaExpanded = String(open);
    this.#remove = button('×', () => actions.remove(key), 'dismiss');
    const head = h(
      'div',
      { class: 'card-head' },
      h('label', { class: 'card-name' }, this.#shown, swatch(slot), h('span', { class: 'card-title' }, this.#name, this.#detail)),
      this.#toggle,
      this.#remove,
    );
    this.element = h('li', { class: 'card' }, head, this.#verdict, this.#warnings.element, this.#body);
    for (const type of ['pointerenter', 'focusin']) this.element.addEventListener(type, () => actions.emphasize(key));
    for (const type of ['pointerleave', 'focusout']) this.element.addEventListener(type, () => actions.emphasize());
  }

  get opened(): boolean {
    return !this.#body.hidden;
  }

  open(open: boolean): void {
    this.#body.hidden = !open;
    this.#toggle.ariaExpanded = String(open);
    if (open) this.#fill();
  }

  /** What takes the focus for the card: the box that says its name. */
  get name(): HTMLElement {
    return this.#shown;
  }

  /** Writes what has changed; `tolerance` is how far a curve may miss its points and still pass through them. */
  update(tolerance: number): void {
    const { label, model, verdict, problem } = this.fit;
    write(this.#name, label.name);
    write(this.#detail, label.detail);
    const title = [label.name, label.detail].filter(Boolean).join(', ');
    this.#toggle.ariaLabel = `Settings of ${title}`;
    this.#remove.ariaLabel = `Remove ${title}`;
    this.#shown.checked = model.shown;
    this.element.toggleAttribute('data-off', !model.shown);
    this.element.toggleAttribute('data-failed', problem !== undefined);
    const report = verdict?.report;
    this.#verdict.hidden = !verdict || problem !== undefined;
    this.#condition.hidden = !report;
    if (report) {
      const word = health(report.condition);
      this.#condition.dataset.health = word;
      write(this.#condition, `condition ${conditionText(report.condition)}: ${word}`);
    }
    if (verdict) {
      const width = report && model.settings.fit !== 'own' && hasWidth(this.fit) ? `width ${brief(report.width)}, ` : '';
      write(
        this.#misfit,
        width + (verdict.misfit <= tolerance ? 'passes through all points' : `misses points by up to ${brief(verdict.misfit)}`),
      );
    }
    this.#warnings.show(problem, this.fit.interpolant !== undefined, report?.warnings ?? []);
    if (!this.#body.hidden) this.#fill();
  }

  #fill(): void {
    this.#controls.show(this.fit.model.settings);
    this.#weights.show(this.fit.verdict?.coefficients);
  }
}

function hasWidth({ model }: Fit): boolean {
  return kindOf(model.kind)?.when?.fit?.(model.settings, 1) ?? false;
}
