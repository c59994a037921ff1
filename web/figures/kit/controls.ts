import { h } from '../../ui/dom.ts';
import {
  type AutoRange,
  type Channels,
  type Choice,
  isParameter,
  type Parameter,
  type Range,
  type StateOf,
  type Switch,
} from './channel.ts';
import type { Figure, PartControl } from './figure.ts';
import { fromLog, toLog } from './scale.ts';
import { brief } from './words.ts';

/** A labelled control for one parameter. */
interface Control {
  readonly element: HTMLElement;
  show(value: unknown): void;
}

/** Controls that show their parts of a state. */
export interface PartShown<S> {
  readonly element: HTMLElement;
  show(state: S): void;
}

type Change = (value: number | string | boolean) => void;

/** Positions of a slider on a logarithmic scale. */
const NOTCHES = 400;

let nextId = 1;

/** What a figure lets one set: its parameters, and then parts of other channels. */
export function partsOf<C extends Channels, M extends object>({
  parameters,
  parts = [],
}: Figure<C, M>): readonly PartControl<StateOf<C>>[] {
  const own = Object.entries(parameters).flatMap(([key, parameter]): PartControl<StateOf<C>>[] =>
    isParameter(parameter)
      ? [
          {
            parameter: () => parameter,
            read: (state) => state[key],
            write: (_, value) => ({ [key]: value }) as unknown as Partial<StateOf<C>>,
          },
        ]
      : [],
  );
  return [...own, ...parts];
}

/** The controls of several parts; seldom needed ones are behind "More settings". `change` hears every new value. */
export function partControls<S>(
  parts: readonly PartControl<S>[],
  first: S,
  change: (part: PartControl<S>, value: unknown) => void,
): PartShown<S> {
  const controls = parts.map((part) => partControl(part, first, (value) => change(part, value)));
  const of = (rare: boolean) =>
    controls.filter((_, i) => !!parts[i]?.parameter(first).rare === rare).map((control) => control.element);
  const element = seen(h('div', {}, ...of(false)));
  const rare = of(true);
  if (rare.length > 0)
    element.append(
      h(
        'details',
        { class: 'more' },
        h('summary', { class: 'soft' }, 'More settings'),
        h('div', { class: 'more-controls stack' }, ...rare),
      ),
    );
  const show = (state: S) => {
    for (const control of controls) control.show(state);
  };
  return { element, show };
}

/** Lays out its children as if they were in its place. */
function seen(element: HTMLElement): HTMLElement {
  element.style.display = 'contents';
  return element;
}

/** The control of a part; another one where the state asks for one of another kind. */
function partControl<S>({ parameter, read, when }: PartControl<S>, first: S, change: Change): PartShown<S> {
  const element = seen(h('div', {}));
  let [kind, last, control] = ['', undefined as Parameter | undefined, undefined as Control | undefined];
  const show = (state: S) => {
    element.hidden = !(when?.(state) ?? true);
    const asked = parameter(state);
    const next = asked === last ? kind : JSON.stringify(asked);
    last = asked;
    if (next !== kind) {
      const focused = element.contains(document.activeElement);
      control = controlOf(asked, change);
      element.replaceChildren(control.element);
      if (focused) element.querySelector<HTMLElement>('input, select')?.focus();
    }
    kind = next;
    control?.show(read(state));
  };
  show(first);
  return { element, show };
}

function controlOf(parameter: Parameter, change: Change): Control {
  switch (parameter.type) {
    case 'range':
      return slider(parameter, change);
    case 'auto-range':
      return autoSlider(parameter, change);
    case 'choice':
      return parameter.open ? radios(parameter, change) : select(parameter, change);
    case 'switch':
      return checkbox(parameter, change);
  }
}

function slider({ label, low, high, scale, step }: Range | AutoRange, change: Change): Control {
  const even = scale === 'even';
  const zero = scale === 'log-zero';
  const id = `control-${nextId++}`;
  const output = h('output', { for: id, class: 'amount' });
  const input = h('input', {
    type: 'range',
    id,
    min: even ? low : 0,
    max: even ? high : NOTCHES,
    step: even ? step : 1,
    oninput: () => change(read()),
  });
  const read = () => (even ? input.valueAsNumber : fromLog(input.valueAsNumber / NOTCHES, low, high, zero));
  const say = (text: string) => {
    if (output.textContent === text) return;
    output.textContent = text;
    input.setAttribute('aria-valuetext', text);
  };
  const show = (value: unknown) => {
    if (typeof value !== 'number') return say('automatic');
    // One that says this already stays where it was put: a step of a key may be less than the number is rounded by, and the next goes on from it.
    if (read() !== value) input.value = String(even ? value : Math.round(toLog(value, low, high, zero) * NOTCHES));
    say(brief(value));
  };
  return { element: h('div', { class: 'control' }, h('label', { for: id }, label), output, input), show };
}

/** The solver's own choice is a tick away; a slider that is moved takes it back. */
function autoSlider(parameter: AutoRange, change: Change): Control {
  const { element, show } = slider(parameter, change);
  const input = element.querySelector('input') as HTMLInputElement;
  const { low, high } = parameter;
  const box = checkbox({ label: `${parameter.label}: choose it for me` }, (automatic) =>
    change(automatic ? 'auto' : fromLog(input.valueAsNumber / NOTCHES, low, high)),
  );
  return {
    element: h('div', { class: 'control-group' }, element, box.element),
    show: (value) => {
      show(value);
      box.show(value === 'auto');
    },
  };
}

function select({ label, options }: Choice, change: Change): Control {
  const id = `control-${nextId++}`;
  const input = h(
    'select',
    { id, onchange: () => change(input.value) },
    ...options.map(([value, text]) => h('option', { value }, text)),
  );
  const show = (value: unknown) => {
    if (input.value !== value) input.value = String(value);
  };
  return { element: h('div', { class: 'control' }, h('label', { for: id }, label), input), show };
}

function radios({ label, options }: Choice, change: Change): Control {
  const name = `control-${nextId++}`;
  const about = h('p', { class: 'soft', hidden: true });
  const inputs = options.map(([value]) => h('input', { type: 'radio', name, value, onchange: () => change(value) }));
  const labels = inputs.map((input, i) => h('label', {}, input, h('span', {}, options[i]?.[1] ?? '')));
  const show = (value: unknown) => {
    for (const input of inputs) input.checked = input.value === value;
    about.textContent = options.find((option) => option[0] === value)?.[2] ?? '';
    about.hidden = about.textContent === '';
  };
  return { element: h('fieldset', { class: 'choices' }, h('legend', {}, label), ...labels, about), show };
}

/** A box to tick, its words beside it. */
function checkbox({ label }: Pick<Switch, 'label'>, change: (value: boolean) => void): Control {
  const input = h('input', { type: 'checkbox', onchange: () => change(input.checked) });
  const show = (value: unknown) => {
    input.checked = value === true;
  };
  return { element: h('label', { class: 'tick-box' }, input, h('span', {}, label)), show };
}
