import { h } from '../../ui/dom.ts';
import { FAMILIES, type Family, METHODS, type Method, type MethodId, methodOf, saidOf } from './methods.ts';

/** Chooses the method: its family in a row, then which of it. */
export class MethodPanel {
  readonly element: HTMLElement;
  readonly #families = h('fieldset', { class: 'segmented families' }, h('legend', { class: 'unseen' }, 'Family of methods'));
  readonly #kinds = h('fieldset', { class: 'kinds' }, h('legend', { class: 'unseen' }, 'Method'));
  readonly #said = h('p', { class: 'soft small' });
  readonly #choose: (id: MethodId) => void;
  /** What was chosen of each family last. */
  readonly #last = new Map<Family, MethodId>();
  #family: Family | undefined;

  constructor(choose: (id: MethodId) => void) {
    this.#choose = choose;
    for (const { id, name } of FAMILIES) {
      const input = h('input', { type: 'radio', name: 'family', value: id, onchange: () => this.#turnTo(id) });
      this.#families.append(h('label', {}, input, h('span', {}, name)));
    }
    this.element = h(
      'section',
      { 'aria-labelledby': 'method-title' },
      h('h2', { id: 'method-title' }, 'Method'),
      this.#families,
      this.#said,
      this.#kinds,
    );
  }

  update(method: Method): void {
    this.#last.set(method.family, method.id);
    if (method.family !== this.#family) {
      this.#family = method.family;
      this.#said.textContent = FAMILIES.find(({ id }) => id === method.family)?.said ?? '';
      const rows = METHODS.filter(({ family }) => family === method.family).map((each) => {
        const input = h('input', { type: 'radio', name: 'method', value: each.id, onchange: () => this.#choose(each.id) });
        return h('label', { class: 'kind' }, input, h('span', {}, h('strong', {}, each.name), h('span', {}, saidOf(each))));
      });
      this.#kinds.replaceChildren(this.#kinds.firstElementChild as Element, ...rows);
    }
    for (const input of this.element.querySelectorAll('input'))
      input.checked = input.value === (input.name === 'family' ? method.family : method.id);
  }

  focus(): void {
    this.#families.querySelector<HTMLElement>('input:checked')?.focus();
  }

  /** To another family, with the same kind of weights where it has them. */
  #turnTo(family: Family): void {
    const now = this.#family && methodOf(this.#last.get(this.#family) ?? '');
    const same = METHODS.find((method) => method.family === family && method.kind === now?.kind);
    const id = same?.id ?? this.#last.get(family) ?? METHODS.find((method) => method.family === family)?.id;
    if (id) this.#choose(id);
  }
}
