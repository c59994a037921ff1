import { byId, h } from '../ui/dom.ts';
import { MODELS } from './models.ts';

/** The radio group that chooses the model; the address remembers the choice. */
export class ModelSwitch {
  readonly #group = byId('models');
  readonly #choose: (id: string) => void;

  constructor(choose: (id: string) => void) {
    this.#choose = choose;
    for (const { id, label } of MODELS) this.#add(id, label);
    addEventListener('hashchange', () => this.#choose(this.fromAddress()));
  }

  /** The model that the address names, or the first. */
  fromAddress(): string {
    const id = location.hash.slice(1);
    return MODELS.some((model) => model.id === id) ? id : (MODELS[0]?.id ?? '');
  }

  /** Shows what is on the stage; an own model gets its own button. */
  show(id: string, label?: string): void {
    const old = this.#group.querySelector<HTMLInputElement>(`input[value="${id}"]`);
    if (!old && label) this.#add(id, label);
    else if (old && label) (old.nextElementSibling as HTMLElement).textContent = label;
    const input = this.#group.querySelector<HTMLInputElement>(`input[value="${id}"]`);
    if (input) input.checked = true;
    const address = MODELS.some((model) => model.id === id) ? `#${id}` : '';
    if (location.hash !== address) history.replaceState(null, '', address || location.pathname + location.search);
  }

  /** Nothing is on the stage: every choice is one. */
  clear(): void {
    for (const input of this.#group.querySelectorAll('input')) input.checked = false;
  }

  #add(id: string, label: string): void {
    const input = h('input', { type: 'radio', name: 'model', value: id, onchange: () => this.#choose(id) });
    this.#group.append(h('label', {}, input, h('span', {}, label)));
  }
}
