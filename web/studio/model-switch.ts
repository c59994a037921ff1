import { byId, h } from '../ui/dom.ts';
import type { Address } from './address.ts';
import { MODELS, modelOf } from './models.ts';

/** The radio group that chooses the model; the address remembers the choice. */
export class ModelSwitch {
  readonly #group = byId('models');
  readonly #address: Address;
  readonly #choose: (id: string) => void;

  constructor(address: Address, choose: (id: string) => void) {
    [this.#address, this.#choose] = [address, choose];
    for (const { id, label } of MODELS) this.#add(id, label);
    addEventListener('hashchange', () => {
      address.read();
      this.#choose(this.fromAddress());
    });
  }

  /** The model that the address names, or the first. */
  fromAddress(): string {
    return (modelOf(this.#address.model) ?? MODELS[0])?.id ?? '';
  }

  /** Shows what is on the stage; an own model gets its own button. */
  show(id: string, label?: string): void {
    const old = this.#group.querySelector<HTMLInputElement>(`input[value="${id}"]`);
    if (!old && label) this.#add(id, label);
    else if (old && label) (old.nextElementSibling as HTMLElement).textContent = label;
    const input = this.#group.querySelector<HTMLInputElement>(`input[value="${id}"]`);
    if (input) input.checked = true;
    this.#address.model = modelOf(id)?.id ?? '';
    this.#address.write();
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
