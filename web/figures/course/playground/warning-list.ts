import type { RbfWarning } from '../../../../wasm/ts/runtime.ts';
import { button, h, match, write } from '../../../ui/dom.ts';
import { explain } from '../../../ui/explain.ts';
import { focusNeighbor } from '../../../ui/focus.ts';
import { brief } from '../../kit/words.ts';
import type { Settings } from './experiment.ts';

interface Remedy {
  readonly words: string;
  readonly settings: Settings;
}

/** What a warning suggests, as settings that a button can apply. */
export function remediesOf({ suggestion }: Pick<RbfWarning, 'suggestion'>): Remedy[] {
  const remedies: Remedy[] = [];
  if (suggestion?.width !== undefined)
    remedies.push({ words: `Use width ${brief(suggestion.width)}`, settings: { fit: 'own', width: suggestion.width } });
  if (suggestion?.smoothing !== undefined)
    remedies.push({ words: `Use smoothing ${brief(suggestion.smoothing)}`, settings: { smoothing: suggestion.smoothing } });
  return remedies;
}

interface Told {
  readonly message: string;
  readonly remedy: string;
  readonly remedies: readonly Remedy[];
}

/** An interpolant's error and warnings, each as a sentence, what to do about it, and buttons that do it. */
export class WarningList {
  readonly element = h('div', { class: 'warnings' });
  readonly #known: ReadonlySet<string>;
  readonly #apply: (settings: Settings) => void;
  readonly #below: HTMLElement;
  readonly #items = new Map<string, { readonly element: HTMLElement; show(told: Told): void }>();

  /** `known`: the settings that the interpolant has; remedies that need others get no button. `below` gets the focus after the last one. */
  constructor(known: ReadonlySet<string>, apply: (settings: Settings) => void, below: HTMLElement) {
    [this.#known, this.#apply, this.#below] = [known, apply, below];
  }

  /** `kept`: whether there is a last good picture. */
  show(problem: unknown, kept: boolean, warnings: readonly RbfWarning[]): void {
    const told = new Map<string, Told>();
    if (problem !== undefined) {
      const { message, remedy } = explain(problem);
      told.set('error', { message, remedy: kept ? `${remedy} The picture is the last good one.` : remedy, remedies: [] });
    } else
      for (const warning of warnings) {
        const remedies = remediesOf(warning).filter(({ settings }) => Object.keys(settings).every((id) => this.#known.has(id)));
        told.set(warning.code, { ...warning, remedies });
      }
    for (const [code, words] of told) {
      const item = this.#items.get(code) ?? this.#item(code);
      item.show(words);
    }
    for (const [code, { element }] of this.#items) {
      if (told.has(code)) continue;
      const focused = element.contains(document.activeElement);
      element.remove();
      this.#items.delete(code);
      if (focused) focusNeighbor(this.element.querySelectorAll('button'), 0, this.#below);
    }
  }

  /** One sentence; its elements stay while numbers in it change, so that a button can be pressed in the midst of a drag. */
  #item(code: string) {
    const [sentence, advice, row] = [h('p', { class: 'sentence' }), h('p', { class: 'remedy' }), h('div', { class: 'tools' })];
    const element = h('div', { class: 'warning', 'data-code': code }, sentence, advice, row);
    let current: readonly Remedy[] = [];
    const remedyButton = (i: number) => button('', () => current[i] && this.#apply(current[i].settings));
    const show = ({ message, remedy, remedies }: Told) => {
      current = remedies;
      write(sentence, message);
      write(advice, remedy);
      row.hidden = remedies.length === 0;
      match(row, remedies.length, remedyButton);
      remedies.forEach(({ words }, i) => {
        write(row.children[i] as Element, words);
      });
    };
    const item = { element, show };
    this.#items.set(code, item);
    this.element.append(element);
    return item;
  }
}
