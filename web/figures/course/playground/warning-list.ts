import type { RbfWarning } from '../../../../wasm/ts/runtime.ts';
import { button, h, match, write } from '../../../ui/dom.ts';
import { explain } from '../../../ui/explain.ts';
import { focusNeighbor } from '../../../ui/focus.ts';
import type { Settings } from './experiment.ts';

interface Remedy {
  readonly words: string;
  readonly settings: Settings;
}

/** What a warning suggests, as settings that a button can apply. Its words have the number that the warning's sentence has. */
export function remediesOf({ suggestion = {} }: Pick<RbfWarning, 'suggestion'>): Remedy[] {
  const { width, smoothing, weightDecay, normalized } = suggestion;
  return [
    ...(width === undefined ? [] : [{ words: `Use width ${asTold(width)}`, settings: { fit: 'own', width } }]),
    ...(smoothing === undefined ? [] : [{ words: `Use smoothing ${asTold(smoothing)}`, settings: { smoothing } }]),
    ...(weightDecay === undefined ? [] : [{ words: `Use weight decay ${asTold(weightDecay)}`, settings: { decay: weightDecay } }]),
    ...(normalized ? [{ words: 'Use normalized kernels', settings: { normalized } }] : []),
  ];
}

const asTold = (number: number) => (number >= 1e-3 && number < 1e5 ? String(number) : number.toExponential());

interface Told {
  readonly message: string;
  readonly remedy: string;
  readonly remedies: readonly Remedy[];
}

/** An interpolant's error and warnings, each as a sentence, what to do about it, and buttons that do it. */
export class WarningList {
  readonly element = h('div', { class: 'warnings' });
  readonly #takes: (settings: Settings) => boolean;
  readonly #apply: (settings: Settings) => void;
  readonly #below: HTMLElement;
  readonly #items = new Map<string, { readonly element: HTMLElement; show(told: Told): void }>();

  /** `takes`: whether the interpolant has such settings, as they are; other remedies get no button. `below` gets the focus after the last one. */
  constructor(takes: (settings: Settings) => boolean, apply: (settings: Settings) => void, below: HTMLElement) {
    [this.#takes, this.#apply, this.#below] = [takes, apply, below];
  }

  /** `kept`: whether there is a last good picture. */
  show(problem: unknown, kept: boolean, warnings: readonly RbfWarning[]): void {
    const told = new Map<string, Told>();
    if (problem !== undefined) {
      const { message, remedy } = explain(problem);
      told.set('error', { message, remedy: kept ? `${remedy} The picture is the last good one.` : remedy, remedies: [] });
    } else
      for (const warning of warnings) {
        const remedies = remediesOf(warning).filter(({ settings }) => this.#takes(settings));
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
