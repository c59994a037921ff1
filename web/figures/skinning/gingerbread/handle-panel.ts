import { h } from '../../ui/dom.ts';
import { type Handle, placeOf, tidy } from './experiment.ts';
import type { Lesson } from './lesson.ts';

interface Field {
  readonly label: string;
  readonly input: HTMLInputElement;
  read(handle: Handle): number;
}

/** The picked handle in numbers: whatever can be dragged can be typed. */
export class HandlePanel {
  readonly element: HTMLElement;
  readonly #lesson: Lesson;
  readonly #which: HTMLSelectElement;
  readonly #fields: Field[];
  readonly #bone: HTMLElement[];
  readonly #turn: HTMLInputElement;
  readonly #body: HTMLElement;
  readonly #none = h('p', { class: 'soft small' }, 'There is no handle. Add a point or a bone.');

  constructor(lesson: Lesson, settle: () => void) {
    this.#lesson = lesson;
    this.#which = h('select', { id: 'which', onchange: () => lesson.pick(Number(this.#which.value)) });
    const change = (make: (handle: Handle, value: number) => void) => (input: HTMLInputElement) => {
      const handle = lesson.handles[lesson.picked];
      if (!handle || !Number.isFinite(input.valueAsNumber)) return this.update();
      make(handle, input.valueAsNumber);
      settle();
    };
    const field = (label: string, read: Field['read'], set: (input: HTMLInputElement) => void, step = 0.01): Field => {
      const input: HTMLInputElement = h('input', { type: 'number', step, onchange: () => set(input), onblur: () => this.update() });
      return { label, input, read };
    };
    const i = () => lesson.picked;
    const at = (k: 0 | 1) => (handle: Handle) => placeOf(handle)[k];
    this.#fields = [
      field(
        'x',
        at(0),
        change((handle, x) => lesson.move(i(), x, placeOf(handle)[1])),
      ),
      field(
        'y',
        at(1),
        change((handle, y) => lesson.move(i(), placeOf(handle)[0], y)),
      ),
      field(
        'Turn °',
        ({ turn }) => turn,
        change((_, turn) => lesson.turn(i(), turn)),
        1,
      ),
      field(
        'Rest x',
        ({ rest }) => rest[0],
        change(({ rest, end }, x) => lesson.sit(i(), [x, rest[1]], end)),
      ),
      field(
        'Rest y',
        ({ rest }) => rest[1],
        change(({ rest, end }, y) => lesson.sit(i(), [rest[0], y], end)),
      ),
      field(
        'End x',
        ({ end }) => end?.[0] ?? 0,
        change(({ rest, end }, x) => end && lesson.sit(i(), rest, [x, end[1]])),
      ),
      field(
        'End y',
        ({ end }) => end?.[1] ?? 0,
        change(({ rest, end }, y) => end && lesson.sit(i(), rest, [end[0], y])),
      ),
    ];
    const labels = this.#fields.map(({ label, input }) => h('label', { class: 'number' }, h('span', {}, label), input));
    this.#bone = labels.slice(5);
    this.#turn = h('input', {
      type: 'range',
      id: 'turn',
      min: -180,
      max: 180,
      step: 1,
      oninput: () => lesson.turn(i(), this.#turn.valueAsNumber),
      onchange: settle,
    });
    this.#body = h(
      'div',
      { class: 'handle-body' },
      h('div', { class: 'control' }, h('label', { for: 'which' }, 'Handle'), this.#which),
      h('div', { class: 'control' }, h('label', { for: 'turn' }, 'Turn'), this.#turn),
      h('div', { class: 'numbers' }, ...labels.slice(0, 3)),
      h('div', { class: 'numbers' }, ...labels.slice(3, 5), ...this.#bone),
    );
    this.element = h(
      'section',
      { 'aria-labelledby': 'handle-title' },
      h('h2', { id: 'handle-title' }, 'Picked handle'),
      this.#none,
      this.#body,
    );
  }

  update(): void {
    const { handles, picked } = this.#lesson;
    this.#none.hidden = handles.length > 0;
    this.#body.hidden = handles.length === 0;
    if (this.#which.length !== handles.length + 1 || this.#which.dataset.kinds !== kinds(handles)) {
      this.#which.dataset.kinds = kinds(handles);
      this.#which.replaceChildren(
        h('option', { value: -1 }, 'none'),
        ...handles.map(({ end }, i) => h('option', { value: i }, `${end ? 'Bone' : 'Handle'} ${i}`)),
      );
    }
    this.#which.value = String(picked);
    const handle = handles[picked];
    for (const { input, read } of this.#fields) {
      input.disabled = !handle;
      if (input !== document.activeElement) input.value = handle ? String(tidy(read(handle))) : '';
    }
    this.#turn.disabled = !handle;
    this.#turn.value = String(handle?.turn ?? 0);
    this.#turn.setAttribute('aria-valuetext', `${Math.round(handle?.turn ?? 0)}°`);
    for (const label of this.#bone) label.hidden = !handle?.end;
  }
}

const kinds = (handles: readonly Handle[]) => handles.map(({ end }) => (end ? 'b' : 'p')).join('');
