import { button, h } from '../../ui/dom.ts';
import { Progress } from '../../ui/progress.ts';
import { Trouble } from '../../ui/trouble.ts';
import type { AnyFigure, Told } from './figure.ts';
import type { Panels } from './panels.ts';
import { brief } from './words.ts';

/** What somebody can ask for beside the controls. */
interface Wishes {
  /** A preset by its name, or the other side. */
  begin(preset: string): void;
  turnTo(side: number): void;
  reset(): void;
  save(kind: 'svg' | 'png'): void;
  /** How to have it in a page of one's own, where the page knows. */
  embed?(): void;
}

let nextSides = 1;

/** Brings one of a row into view, along the row only: the page does not move. */
export function bringIntoRow(element: HTMLElement): void {
  const row = element.parentElement;
  if (!row) return;
  const from = element.offsetLeft - row.offsetLeft;
  if (from < row.scrollLeft || from + element.offsetWidth > row.scrollLeft + row.clientWidth)
    row.scrollLeft = from - (row.clientWidth - element.offsetWidth) / 2;
}

/** A figure's elements: its words, its presets, and where its panels and controls lie. */
export class Layout {
  readonly element = h('section', { class: 'figure stack' });
  readonly pictures = h('div', { class: 'panels stack' });
  readonly #said = h('p', { class: 'trouble', role: 'alert', hidden: true });
  readonly trouble = new Trouble(this.#said, () => this.element.querySelector('button'));
  readonly #notice = h('p', { class: 'notice', role: 'status', hidden: true });
  /** What of a link could not be read, until something is changed. */
  readonly note = new Trouble(this.#notice, () => this.element.querySelector('button'));
  readonly busy = h('div', { class: 'progress', hidden: true });
  readonly progress = new Progress(this.busy);
  readonly #title = h('h2', { class: 'figure-title' });
  readonly #caption = h('p', { class: 'caption' });
  readonly #facts = h('dl', { class: 'facts' });
  readonly #spoken = h('p', { class: 'unseen', role: 'status' });
  readonly #presets: ReadonlyMap<string, HTMLButtonElement>;
  readonly #sides: readonly HTMLInputElement[];
  #chosen = '';

  constructor(figure: AnyFigure, controls: HTMLElement, panels: Pick<Panels<never, never>, 'at'>, wishes: Wishes) {
    const { presets, sides, heading, thumbnail } = figure;
    this.#presets = new Map(presets.map(({ id, name }) => [id, button(name, () => wishes.begin(id))]));
    const row = h('div', { class: 'presets', role: 'group', 'aria-label': 'Presets' }, ...this.#presets.values());
    row.toggleAttribute('data-film', thumbnail !== undefined);
    const tools = h(
      'div',
      { class: 'tools' },
      button('Reset', wishes.reset, 'button small quiet'),
      button('SVG', () => wishes.save('svg'), 'button small quiet'),
      button('PNG', () => wishes.save('png'), 'button small quiet'),
      ...(wishes.embed ? [button('Embed', wishes.embed, 'button small quiet')] : []),
    );
    const name = `sides-${nextSides++}`;
    const inputs = (sides?.options ?? []).map((_, side) =>
      h('input', { type: 'radio', name, onchange: () => wishes.turnTo(side) }),
    );
    this.#sides = inputs;
    const labels = inputs.map((input, i) => h('label', {}, input, h('span', {}, sides?.options[i]?.[0] ?? '')));
    const choice = h('fieldset', { class: 'segmented' }, h('legend', { class: 'unseen' }, sides?.label ?? ''), ...labels);
    this.pictures.append(...panels.at(undefined));
    const foot = h('div', { class: 'figure-foot' }, row, tools);
    const stage = h('div', { class: 'figure-stage stack' }, this.pictures, this.busy, this.#caption, foot);
    const beside = [
      ...panels.at('above'),
      ...(heading ? [h('h3', {}, heading)] : []),
      controls,
      ...panels.at('below'),
      this.#facts,
    ];
    this.element.append(
      h(
        'div',
        { class: 'figure-head' },
        this.#title,
        ...(sides ? [choice] : []),
        h('div', { class: 'tools' }, ...panels.at('tools')),
      ),
      this.#said,
      this.#notice,
      h('div', { class: 'figure-body' }, stage, h('div', { class: 'controls stack' }, ...beside)),
      this.#spoken,
    );
  }

  get title(): string {
    return this.#title.textContent ?? '';
  }

  /** Says which preset is shown, and on which side. */
  show(preset: AnyFigure['presets'][number], title: string, side: number | undefined): void {
    this.#title.textContent = title;
    for (const [i, input] of this.#sides.entries()) input.checked = i === side;
    for (const [id, button] of this.#presets) button.ariaPressed = String(id === preset.id);
    if (preset.id === this.#chosen) return;
    this.#chosen = preset.id;
    const { look = '', attempt } = preset;
    this.#caption.replaceChildren(look, ...(attempt ? [h('strong', {}, ' Try: '), attempt] : []));
    this.bringChosen();
  }

  /** Brings the preset's button into view. */
  bringChosen(): void {
    const button = [...this.#presets.values()].find(({ ariaPressed }) => ariaPressed === 'true');
    if (button) bringIntoRow(button);
  }

  /** A small picture on a preset's button. */
  picture(preset: string, picture: SVGSVGElement): void {
    this.#presets.get(preset)?.prepend(picture);
  }

  /** Numbers in a table, and read aloud as `say` has them. */
  tell(told: readonly Told[], say: string | undefined): void {
    const words = told.map(([name, value]) => [name, typeof value === 'number' ? brief(value) : value] as const);
    this.#facts.replaceChildren(...words.flatMap(([name, value]) => [h('dt', {}, name), h('dd', {}, value)]));
    this.#spoken.textContent = say ?? words.map(([name, value]) => `${name}: ${value}.`).join(' ');
  }
}
