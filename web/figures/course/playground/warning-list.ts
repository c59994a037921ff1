import type { RbfWarning } from '../../../../wasm/ts/runtime.ts';
import { h } from '../../../ui/dom.ts';
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

/** An interpolant's error and warnings, each as a sentence, what to do about it, and buttons that do it. */
export class WarningList {
  readonly element = h('div', { class: 'warnings' });
  readonly #known: ReadonlySet<string>;
  readonly #apply: (settings: Settings) => void;
  readonly #below: HTMLElement;
  readonly #items = new Map<string, { element: HTMLElement; update(message: string, remedy: string, remedies: Remedy[]): void }>();

  /** `known`: the settings that the interpolant has; remedies that need others get no button. `below` gets the focus after the last one. */
  constructor(known: ReadonlySet<string>, apply: (settings: Settings) => void, below: HTMLElement) {
    this.#known = known;
    this.#apply = apply;
    this.#below = below;
  }

  /** `kept`: whether there is a last good picture. */
  show(problem: unknown, kept: boolean, warnings: readonly RbfWarning[]): void {
    const told = new Set<string>();
    const tell = (code: string, message: string, remedy: string, remedies: Remedy[]) => {
      told.add(code);
      let item = this.#items.get(code);
      if (!item) {
        item = this.#item(code);
        this.#items.set(code, item);
        this.element.append(item.element);
      }
      item.update(message, remedy, remedies);
    };
    if (problem !== undefined) {
      const { message, remedy } = explain(problem);
      tell('error', message, kept ? `${remedy} The picture is the last good one.` : remedy, []);
    } else {
      for (const warning of warnings) {
        const remedies = remediesOf(warning).filter(({ settings }) => Object.keys(settings).every((id) => this.#known.has(id)));
        tell(warning.code, warning.message, warning.remedy, remedies);
      }
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
    const sentence = h('p', { class: 'sentence' });
    const advice = h('p', { class: 'remedy' });
    const row = h('div', { class: 'buttons' });
    const element = h('div', { class: 'warning' }, sentence, advice, row);
    element.dataset.code = code;
    let current: Remedy[] = [];
    const update = (message: string, remedy: string, remedies: Remedy[]) => {
      if (sentence.textContent !== message) sentence.textContent = message;
      if (advice.textContent !== remedy) advice.textContent = remedy;
      current = remedies;
      row.hidden = remedies.length === 0;
      while (row.childElementCount > remedies.length) row.lastElementChild?.remove();
      while (row.childElementCount < remedies.length) {
        const i = row.childElementCount;
        row.append(
          h('button', { type: 'button', class: 'button small', onclick: () => current[i] && this.#apply(current[i].settings) }),
        );
      }
      remedies.forEach(({ words }, i) => {
        const button = row.children[i] as HTMLElement;
        if (button.textContent !== words) button.textContent = words;
      });
    };
    return { element, update };
  }
}
