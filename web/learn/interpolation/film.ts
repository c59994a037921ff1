import type { HandlebodyRuntime } from '../../../wasm/ts/runtime.ts';
import { curvePath } from '../../figures/kit/path.ts';
import { h, svg } from '../../ui/dom.ts';
import type { Experiment } from './experiment.ts';
import { dataOf, kindOf } from './interpolants.ts';
import { PRESETS } from './presets.ts';

const [WIDTH, HEIGHT] = [96, 54];
const STEPS = 96;

/** The row of presets: links with a small picture each, drawn when there is time. */
export class Film {
  readonly element = h('ul', { class: 'film' });
  readonly #links = new Map<string, HTMLAnchorElement>();

  constructor(hb: HandlebodyRuntime) {
    const waiting: (() => void)[] = [];
    for (const preset of PRESETS) {
      const experiment = preset.make();
      const picture = svg('svg', { class: 'thumb', viewBox: `0 0 ${WIDTH} ${HEIGHT}`, 'aria-hidden': 'true' });
      const link = h('a', { href: `#${preset.id}`, title: preset.title }, picture, h('span', {}, preset.mark));
      this.#links.set(preset.id, link);
      this.element.append(h('li', {}, link));
      waiting.push(() => draw(hb, experiment, picture));
    }
    const next = () => {
      waiting.shift()?.();
      if (waiting.length > 0) whenIdle(next);
    };
    whenIdle(next);
  }

  show(id: string): void {
    for (const [preset, link] of this.#links) {
      if (preset === id) link.setAttribute('aria-current', 'true');
      else link.removeAttribute('aria-current');
    }
    const [row, link] = [this.element, this.#links.get(id)];
    if (!link) return;
    // Along the row only: the page does not move.
    const [from, to] = [link.offsetLeft - row.offsetLeft, link.offsetLeft - row.offsetLeft + link.offsetWidth];
    if (from < row.scrollLeft || to > row.scrollLeft + row.clientWidth)
      row.scrollLeft = from - (row.clientWidth - link.offsetWidth) / 2;
  }
}

function whenIdle(run: () => void): void {
  if ('requestIdleCallback' in globalThis) requestIdleCallback(run);
  else setTimeout(run, 50);
}

/** Curves through the points; in the plane, curves along a section through the middle. */
function draw(hb: HandlebodyRuntime, experiment: Experiment, picture: SVGSVGElement): void {
  const { dimension, frame, range, points, values } = experiment;
  const [left, right, bottom, top] = frame;
  const [low, high] = dimension === 1 ? [bottom, top] : range;
  const xs = new Float64Array(STEPS).map((_, i) => left + ((right - left) * i) / (STEPS - 1));
  const places = dimension === 1 ? xs : new Float64Array(2 * STEPS).map((_, i) => (i % 2 === 0 ? (xs[i / 2] as number) : 0));
  const [ax, ay] = [WIDTH / (right - left), HEIGHT / (high - low)];
  for (const { kind, settings, slot } of experiment.models) {
    try {
      const made = kindOf(kind)?.make(hb, dataOf(experiment), settings);
      if (!made) continue;
      const path = svg('path', { class: 'curve', d: curvePath(xs, made.evaluate(places), [ax, -left * ax, -ay, high * ay]) });
      path.dataset.slot = String(slot);
      picture.append(path);
      made.dispose();
    } catch {
      // A preset whose method refuses it says so when it is opened.
    }
  }
  if (dimension === 2) return;
  values.forEach((value, i) => {
    const x = ((points[i] as number) - left) * ax;
    picture.append(svg('circle', { cx: x.toFixed(1), cy: ((high - value) * ay).toFixed(1), r: 1.8 }));
  });
}
