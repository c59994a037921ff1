import { ColorMap } from '../../figures/kit/color-map.ts';
import { h, readable } from '../../ui/dom.ts';
import type { Weights } from './messages.ts';
import { atRest, type Pose } from './pose.ts';
import type { Solid } from './solids.ts';
import { METHODS, type Method } from './weights.ts';

export const BLENDS = [
  { id: 'linear', label: 'Linear' },
  { id: 'rigid', label: 'Rigid (dual quaternions)' },
] as const;

export type Blend = (typeof BLENDS)[number]['id'];

interface PanelActions {
  setMethod(method: Method): void;
  setBlend(blend: Blend): void;
  choose(handle: number): void;
  showWeight(shown: boolean): void;
  pose(handle: number, pose: Pose): void;
  reset(): void;
  preset(): void;
}

const AXES = ['x', 'y', 'z'] as const;

/** Everything that the lesson lets one set. */
export class Panel {
  readonly element: HTMLElement;
  readonly #solid: Solid;
  readonly #facts = h('dl', { class: 'facts' });
  readonly #heading = h('h3', {});
  readonly #about = h('p', { class: 'soft' });
  readonly #sliders: { input: HTMLInputElement; output: HTMLOutputElement; read: (pose: Pose) => number; unit: string }[] = [];
  readonly #inputs = new Map<string, HTMLInputElement>();

  constructor(solid: Solid, actions: PanelActions) {
    this.#solid = solid;
    let chosen = solid.chosen;
    let pose = atRest();
    const radios = (
      name: string,
      legend: string,
      entries: readonly (readonly [id: string, label: string])[],
      change: (id: string) => void,
    ) =>
      h(
        'fieldset',
        { class: 'choices' },
        h('legend', {}, legend),
        ...entries.map(([id, label]) => {
          const input = h('input', { type: 'radio', name, value: id, onchange: () => change(id) });
          this.#inputs.set(`${name} ${id}`, input);
          return h('label', {}, input, h('span', {}, label));
        }),
      );
    const slider = (label: string, part: 'shift' | 'turn', axis: number) => {
      const [most, step, unit] = part === 'turn' ? ([180, 1, '°'] as const) : ([0.5, 0.005, ''] as const);
      const output = h('output', {});
      const input = h('input', {
        type: 'range',
        min: -most,
        max: most,
        step,
        value: 0,
        'aria-label': `${label} of the chosen handle`,
      });
      input.addEventListener('input', () => {
        pose = { shift: [...pose.shift], turn: [...pose.turn] };
        pose[part][axis] = input.valueAsNumber;
        output.textContent = `${readable(input.valueAsNumber, part === 'turn' ? 0 : 3)}${unit}`;
        actions.pose(chosen, pose);
      });
      this.#sliders.push({ input, output, read: (from) => from[part][axis] as number, unit });
      return h('label', {}, h('span', { 'aria-hidden': 'true' }, label), input, output);
    };
    this.posed = (handle, next) => {
      chosen = handle;
      pose = next;
      this.#heading.textContent = `Move and turn: ${solid.handles[handle]?.name ?? ''}`;
      for (const { input, output, read, unit } of this.#sliders) {
        const value = read(next);
        input.value = String(value);
        output.textContent = `${readable(value, unit ? 0 : 3)}${unit}`;
      }
      this.#check('handle', String(handle));
    };
    const colored = h('input', { type: 'checkbox', onchange: () => actions.showWeight(colored.checked) });
    colored.checked = true;
    const ramp = h('div', {});
    ramp.style.background = new ColorMap('viridis', 0, 1).gradient;
    this.element = h(
      'div',
      { class: 'panel-content' },
      h('h2', {}, 'Weights of a solid'),
      h('p', { class: 'soft' }, 'Choose a handle to see its weight; turn it and compare how the two ways of blending follow.'),
      radios(
        'method',
        'Weights',
        METHODS.map(({ id, label }) => [id, label] as const),
        (id) => actions.setMethod(id as Method),
      ),
      this.#about,
      radios(
        'blend',
        'Blending',
        BLENDS.map(({ id, label }) => [id, label] as const),
        (id) => actions.setBlend(id as Blend),
      ),
      radios(
        'handle',
        'Handle',
        solid.handles.map(({ name }, i) => [String(i), name] as const),
        (id) => actions.choose(Number(id)),
      ),
      h('label', { class: 'check' }, colored, ' Color by its weight'),
      h('div', { class: 'scale' }, '0', ramp, '1'),
      h(
        'section',
        { class: 'sliders' },
        this.#heading,
        ...AXES.map((axis, i) => slider(`Turn ${axis}`, 'turn', i)),
        ...AXES.map((axis, i) => slider(`Move ${axis}`, 'shift', i)),
      ),
      h(
        'div',
        { class: 'buttons' },
        h(
          'button',
          { type: 'button', class: 'button', id: 'preset', onclick: () => actions.preset() },
          solid.id === 'bar' ? 'Twist by 180°' : 'Lift the paw',
        ),
        h('button', { type: 'button', class: 'button', id: 'reset', onclick: () => actions.reset() }, 'Reset'),
      ),
      h('section', {}, h('h3', {}, 'Measured'), this.#facts),
    );
  }

  /** Shows the pose of the handle that is chosen. */
  readonly posed: (handle: number, pose: Pose) => void;

  /** No method is chosen where there are no weights. */
  show(method: Method | undefined, blend: Blend): void {
    for (const { id } of METHODS) (this.#inputs.get(`method ${id}`) as HTMLInputElement).checked = id === method;
    this.#about.textContent = METHODS.find(({ id }) => id === method)?.about ?? '';
    this.#check('blend', blend);
  }

  measured({ tetrahedra, vertices, measures }: Weights, volume: number): void {
    const facts: readonly (readonly [string, string])[] = [
      ['Volume, of that at rest', `${readable(100 * volume, 1)} %`],
      ['Weights within', `${readable(measures.least, 3)} … ${readable(measures.largest, 3)}`],
      ['Sum, off 1 by', measures.sumError.toExponential(0)],
      ['Smooth', measures.holds.smooth ? 'yes' : `no: slopes jump by ${readable(100 * measures.gradientJump, 0)} %`],
      ['Tetrahedra', `${tetrahedra.toLocaleString('en')} on ${vertices.toLocaleString('en')} vertices`],
      ['Vertices of the surface', (this.#solid.positions.length / 3).toLocaleString('en')],
    ];
    this.#facts.replaceChildren(...facts.flatMap(([name, value]) => [h('dt', {}, name), h('dd', {}, value)]));
  }

  #check(name: string, id: string): void {
    const input = this.#inputs.get(`${name} ${id}`);
    if (input) input.checked = true;
  }
}
