import { h } from '../ui/dom.ts';
import type { View } from './view.ts';

const TURN = Math.PI / 8;
const ZOOM = 1.25;

/** Ways to move the camera without dragging: buttons, and keys while the view has the focus. */
export function cameraTools(view: View, frame: HTMLElement): HTMLElement {
  const actions: readonly [label: string, icon: string, act: () => void][] = [
    ['Turn left', 'M8 4 3 9l5 5M3 9h8a5 5 0 0 1 5 5v1', () => view.turn(-TURN, 0)],
    ['Turn right', 'm12 4 5 5-5 5m5-5H9a5 5 0 0 0-5 5v1', () => view.turn(TURN, 0)],
    ['Zoom in', 'M10 4v12M4 10h12', () => view.turn(0, 0, ZOOM)],
    ['Zoom out', 'M4 10h12', () => view.turn(0, 0, 1 / ZOOM)],
    ['Show all again', 'M4 8V4h4M12 4h4v4M16 12v4h-4M8 16H4v-4', () => view.home()],
  ];
  const keys: Record<string, () => void> = {
    ArrowLeft: () => view.turn(-TURN / 2, 0),
    ArrowRight: () => view.turn(TURN / 2, 0),
    ArrowUp: () => view.turn(0, TURN / 2),
    ArrowDown: () => view.turn(0, -TURN / 2),
    '+': () => view.turn(0, 0, ZOOM),
    '=': () => view.turn(0, 0, ZOOM),
    '-': () => view.turn(0, 0, 1 / ZOOM),
    Home: () => view.home(),
  };
  frame.tabIndex = 0;
  const press = (event: KeyboardEvent) => {
    if (event.target !== frame || event.ctrlKey || event.metaKey || event.altKey) return;
    const act = keys[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  };
  frame.addEventListener('keydown', press, { signal: view.signal });
  const icon = (path: string) => {
    const template = document.createElement('template');
    template.innerHTML = `<svg viewBox="0 0 20 20" aria-hidden="true"><path d="${path}"/></svg>`;
    return template.content;
  };
  return h(
    'div',
    { class: 'camera-tools', role: 'group', 'aria-label': 'Camera' },
    ...actions.map(([label, path, act]) => {
      const button = h('button', { type: 'button', class: 'tool', 'aria-label': label, title: label, onclick: act });
      button.append(icon(path));
      return button;
    }),
  );
}
