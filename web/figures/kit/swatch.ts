import { svg } from '../../ui/dom.ts';

/** A piece of the curve that a model is drawn as: its color and its dash. */
export function swatch(slot: number): SVGSVGElement {
  const path = svg('path', { d: 'M2 8H34', class: 'curve' });
  path.dataset.slot = String(slot);
  return svg('svg', { class: 'swatch', viewBox: '0 0 36 16', 'aria-hidden': 'true' }, path);
}
