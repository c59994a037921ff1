import { h } from '../../../ui/dom.ts';
import type { Panel } from '../../kit/figure.ts';
import { type Handle, movedTo, type Place, placeOf, toThousandths, turnedTo } from '../../kit/plane-handles.ts';
import type { Bent, State } from './bent.ts';

type Set = (handle: Handle, value: number) => Handle;

const sit = (handle: Handle, rest: Place, end = handle.end): Handle => ({ ...handle, rest, ...(end && { end }) });

/** What can be dragged, and where handles rest. */
const FIELDS: readonly (readonly [label: string, read: (handle: Handle) => number, set: Set])[] = [
  ['x', (handle) => placeOf(handle)[0], (handle, x) => movedTo(handle, x, placeOf(handle)[1])],
  ['y', (handle) => placeOf(handle)[1], (handle, y) => movedTo(handle, placeOf(handle)[0], y)],
  ['Turn °', ({ turn }) => turn, turnedTo],
  ['Rest x', ({ rest }) => rest[0], (handle, x) => sit(handle, [x, handle.rest[1]])],
  ['Rest y', ({ rest }) => rest[1], (handle, y) => sit(handle, [handle.rest[0], y])],
  ['End x', ({ end }) => end?.[0] ?? 0, (handle, x) => sit(handle, handle.rest, handle.end && [x, handle.end[1]])],
  ['End y', ({ end }) => end?.[1] ?? 0, (handle, y) => sit(handle, handle.rest, handle.end && [handle.end[0], y])],
];

/** The picked handle in numbers: whatever can be dragged can be typed. */
export const handlePanel: Panel<Bent, State> = {
  place: 'below',
  open: (kit) => {
    let handles: readonly Handle[] = [];
    const put = (set: Set, value: number) => {
      const handle = handles[kit.state.pick];
      if (handle && Number.isFinite(value)) kit.change({ h: handles.with(kit.state.pick, set(handle, value)) });
      else kit.redraw();
    };
    const which = h('select', { onchange: () => kit.change({ pick: Number(which.value) }) });
    const turn = h('input', {
      type: 'range',
      min: -180,
      max: 180,
      step: 1,
      oninput: () => put(turnedTo, turn.valueAsNumber),
    });
    const fields = FIELDS.map(([label, read, set]) => {
      const input = h('input', {
        type: 'number',
        step: label === 'Turn °' ? 1 : 0.01,
        onchange: () => put(set, input.valueAsNumber),
        onblur: () => kit.redraw(),
      });
      return { label: h('label', { class: 'number' }, h('span', { class: 'soft' }, label), input), input, read };
    });
    const labels = fields.map(({ label }) => label);
    const none = h('p', { class: 'soft' }, 'There is no handle. Add a point or a bone.');
    const body = h(
      'div',
      { class: 'handle-body stack' },
      h('label', { class: 'control' }, 'Handle', which),
      h('label', { class: 'control' }, 'Turn', turn),
      h('div', { class: 'numbers' }, ...labels.slice(0, 3)),
      h('div', { class: 'numbers' }, ...labels.slice(3)),
    );
    let kinds = '?';
    return {
      element: h('section', { class: 'stack', 'aria-label': 'Picked handle' }, h('h3', {}, 'Picked handle'), none, body),
      draw: (bent, state) => {
        handles = bent.handles(state);
        none.hidden = handles.length > 0;
        body.hidden = !none.hidden;
        const now = handles.map(({ end }) => (end ? 'Bone' : 'Handle'));
        if (now.join() !== kinds) {
          kinds = now.join();
          const options = now.map((kind, i) => h('option', { value: i }, `${kind} ${i}`));
          which.replaceChildren(h('option', { value: -1 }, 'none'), ...options);
        }
        const handle = handles[state.pick];
        which.value = String(handle ? state.pick : -1);
        for (const { input, read } of fields) {
          input.disabled = !handle;
          if (input !== document.activeElement) input.value = handle ? String(toThousandths(read(handle))) : '';
        }
        turn.disabled = !handle;
        turn.value = String(handle?.turn ?? 0);
        turn.setAttribute('aria-valuetext', `${Math.round(handle?.turn ?? 0)}°`);
        for (const label of labels.slice(5)) label.hidden = !handle?.end;
      },
    };
  },
};
