import { h } from '../../ui/dom.ts';
import type { Choice, Parameter, Range, Switch } from './channel.ts';
import { fromLog, toLog } from './scale.ts';
import { brief } from './words.ts';

/** A labelled control for one parameter. */
export interface Control {
  readonly element: HTMLElement;
  show(value: unknown): void;
}

/** Positions of a slider on a logarithmic scale. */
const NOTCHES = 400;

let nextId = 1;

/** The control that a parameter asks for; `change` hears every new value, while a slider moves too. */
export function controlOf(parameter: Parameter, change: (value: number | string | boolean) => void): Control {
  if (parameter.type === 'range') return slider(parameter, change);
  return parameter.type === 'choice' ? select(parameter, change) : checkbox(parameter, change);
}

function slider({ label, low, high, scale, step }: Range, change: (value: number) => void): Control {
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
    oninput: () => change(even ? input.valueAsNumber : fromLog(input.valueAsNumber / NOTCHES, low, high, zero)),
  });
  const show = (value: unknown) => {
    const number = value as number;
    const at = even ? number : Math.round(toLog(number, low, high, zero) * NOTCHES);
    if (input.valueAsNumber !== at) input.value = String(at);
    const text = brief(number);
    if (output.textContent === text) return;
    output.textContent = text;
    input.setAttribute('aria-valuetext', text);
  };
  return { element: h('div', { class: 'control' }, h('label', { for: id }, label), output, input), show };
}

function select({ label, options }: Choice, change: (value: string) => void): Control {
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

/** A box to tick, its words beside it. */
function checkbox({ label }: Switch, change: (value: boolean) => void): Control {
  const input = h('input', { type: 'checkbox', onchange: () => change(input.checked) });
  const show = (value: unknown) => {
    input.checked = value === true;
  };
  return { element: h('label', { class: 'tick-box' }, input, h('span', {}, label)), show };
}
