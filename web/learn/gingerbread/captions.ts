import { ColorMap } from '../../figures/kit/color-map.ts';
import { h } from '../../ui/dom.ts';
import type { Handle } from './experiment.ts';
import type { Method } from './methods.ts';

/** What goes after a method's name under the picture. */
export function captionOf(method: Method, handles: readonly Handle[]): string {
  if (handles.length === 0) return 'without a handle: the shape rests.';
  const turned = handles.some(({ turn }) => Math.abs(turn) > 120);
  if (method.family === 'linear')
    return `weights, transformations blended linearly.${turned ? ' Where a turn fades out, the shape collapses: look at Rigid.' : ''}`;
  if (method.family === 'rigid') return `weights, rotations blended as rotations.${turned ? ' Nothing collapses.' : ''}`;
  return method.family === 'energy' ? 'under the same handles, without weights.' : 'on the shape as a thin slab.';
}

/** What the colors of weights mean. */
export function legend(): HTMLElement {
  const strip = h('span', { class: 'legend-strip' });
  strip.style.background = new ColorMap('viridis', 0, 1).gradient;
  return h(
    'p',
    { class: 'legend', hidden: true },
    h('span', {}, '0'),
    strip,
    h('span', {}, '1'),
    h('span', { class: 'hatch below' }),
    h('span', {}, 'below 0'),
    h('span', { class: 'hatch above' }),
    h('span', {}, 'above 1'),
  );
}
