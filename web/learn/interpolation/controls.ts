import { fromLog, toLog } from '../../figures/kit/scale.ts';
import { brief } from '../../figures/kit/words.ts';
import { h } from '../../ui/dom.ts';
import type { Setting } from './experiment.ts';
import type { Choice, Parameter, Range, Switch } from './parameter.ts';

/** A labelled control for one setting. */
export interface Control {
  readonly element: HTMLElement;
  show(setting: Setting): void;
}

/** Positions of a slider on a logarithmic scale. */
const NOTCHES = 400;

let nextId = 1;

/** The control that a parameter asks for; `change` hears every new setting, while a slider moves too. */
export function controlOf(parameter: Parameter, change: (setting: Setting) => void): Control {
  if (parameter.type === 'range') return slider(parameter, change);
  return parameter.type === 'choice' ? select(parameter, change) : checkbox(parameter, change);
}

function slider({ label, low, high, scale, step = 0.1 }: Range, change: (setting: number) => void): Control {
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
  const show = (setting: Setting) => {
    const number = setting as number;
    const at = even ? number : Math.round(toLog(number, low, high, zero) * NOTCHES);
    if (input.valueAsNumber !== at) input.value = String(at);
    const text = brief(number);
    if (output.textContent === text) return;
    output.textContent = text;
    input.setAttribute('aria-valuetext', text);
  };
  return { element: h('div', { class: 'control' }, h('label', { for: id }, label), output, input), show };
}

function select({ label, options }: Choice, change: (setting: string) => void): Control {
  const id = `control-${nextId++}`;
  const input = h(
    'select',
    { id, onchange: () => change(input.value) },
    ...options.map(([value, text]) => h('option', { value }, text)),
  );
  const show = (setting: Setting) => {
    if (input.value !== setting) input.value = String(setting);
  };
  return { element: h('div', { class: 'control' }, h('label', { for: id }, label), input), show };
}

/** A box to tick, its words beside it. */
export function checkbox({ label }: Pick<Switch, 'label'>, change: (setting: boolean) => void): Control {
  const input = h('input', { type: 'checkbox', onchange: () => change(input.checked) });
  const show = (setting: Setting) => {
    input.checked = Boolean(setting);
  };
  return { element: h('label', { class: 'tick-box' }, input, h('span', {}, label)), show };
}
