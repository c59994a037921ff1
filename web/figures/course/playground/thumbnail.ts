import type { HandlebodyRuntime } from '../../../../wasm/ts/runtime.ts';
import { svg } from '../../../ui/dom.ts';
import { curvePath } from '../../kit/path.ts';
import { dataOf } from '../../kit/point-set.ts';
import type { State } from './channels.ts';
import { kindOf } from './interpolants.ts';

const [WIDTH, HEIGHT] = [96, 54];
const STEPS = 96;

/** Curves through the points; in the plane, curves along a section through the middle. */
export function thumbnail(hb: HandlebodyRuntime, { d, p, m, in: frame, range }: State): SVGSVGElement {
  const picture = svg('svg', { class: 'thumb', viewBox: `0 0 ${WIDTH} ${HEIGHT}`, 'aria-hidden': 'true' });
  const [left, right, bottom, top] = frame;
  const [low, high] = d === 1 ? [bottom, top] : range;
  const xs = new Float64Array(STEPS).map((_, i) => left + ((right - left) * i) / (STEPS - 1));
  const places = d === 1 ? xs : new Float64Array(2 * STEPS).map((_, i) => (i % 2 === 0 ? (xs[i / 2] as number) : 0));
  const [ax, ay] = [WIDTH / (right - left), HEIGHT / (high - low)];
  for (const { kind, settings, slot } of m) {
    try {
      const made = kindOf(kind)?.make(hb, dataOf(p), settings);
      if (!made) continue;
      const path = svg('path', { class: 'curve', d: curvePath(xs, made.evaluate(places), [ax, -left * ax, -ay, high * ay]) });
      path.dataset.slot = String(slot);
      picture.append(path);
      made.dispose();
    } catch {
      // A preset whose method refuses it says so when it is opened.
    }
  }
  if (d === 1)
    p.values.forEach((value, i) => {
      const [cx, cy] = [((p.places[i] as number) - left) * ax, (high - value) * ay];
      picture.append(svg('circle', { cx: cx.toFixed(1), cy: cy.toFixed(1), r: 1.8 }));
    });
  return picture;
}
