import type { HandlebodyRuntime } from '../../../wasm/ts/runtime.ts';
import { Chart, type Curve, match } from '../../figures/kit/chart.ts';
import { Handles, type PointActions } from '../../figures/kit/handles.ts';
import { asLong, Samples } from '../../figures/kit/samples.ts';
import { h, svg } from '../../ui/dom.ts';
import type { Experiment } from './experiment.ts';
import type { Fit } from './fit.ts';
import { dataOf } from './interpolants.ts';
import { weightedKernels } from './kernel-curves.ts';
import type { Picture, View } from './view.ts';

/** Points on a line, their interpolants as curves through them. */
export class LineView implements View {
  readonly element: HTMLElement;
  readonly #hb: HandlebodyRuntime;
  readonly #chart: Chart;
  readonly #handles: Handles;
  readonly #kernels = svg('g', { class: 'kernels' });
  readonly #weights: Chart;
  readonly #weightsTitle = h('h3', { class: 'chart-title' });
  readonly #weightsPart: HTMLElement;
  readonly #samples = new Samples();
  readonly #ys = new Map<number, Float64Array>();
  readonly #shares = new Map<number, Float64Array>();

  /** `resized` asks for another drawing. */
  constructor(hb: HandlebodyRuntime, actions: PointActions, resized: () => void) {
    this.#hb = hb;
    this.#chart = new Chart(true, resized);
    this.#weights = new Chart(true, resized);
    this.#chart.under.append(this.#kernels);
    const board = {
      screen: (i: number) => {
        const [x, y] = actions.placeOf(i);
        return [this.#chart.x(x), this.#chart.y(y)] as const;
      },
      place: (px: number, py: number) => this.#chart.at(px, py),
      drag: (i: number, px: number, py: number) => actions.move(i, ...this.#chart.at(px, py)),
      get size() {
        return [chart.width, chart.height] as const;
      },
      get spans() {
        const [left, right, bottom, top] = chart.frame;
        return [right - left, top - bottom] as const;
      },
    };
    const chart = this.#chart;
    this.#handles = new Handles(this.#chart.area, board, actions);
    this.#chart.element.classList.add('main-chart');
    this.#chart.element.role = 'group';
    this.#chart.element.ariaLabel = 'Plot of the points and their interpolants';
    this.#weights.element.classList.add('low-chart');
    this.#weightsPart = h('div', { class: 'chart-part', hidden: true }, this.#weightsTitle, this.#weights.element);
    this.element = h('div', { class: 'line-view' }, this.#chart.element, this.#weightsPart);
  }

  get named(): boolean {
    return this.#chart.named;
  }

  handle(i: number): HTMLElement | undefined {
    return this.#handles.element(i);
  }

  draw({ experiment, fits, outliers }: Picture): void {
    this.#chart.frame = experiment.frame;
    const xs = this.#samples.spread(experiment.frame, experiment.points);
    const seen = fits.filter((fit) => fit.model.shown && fit.interpolant);
    this.#chart.draw(seen.map((fit) => this.#curve(fit, xs, experiment.show.kernels && !!fit.rbf)));
    this.#drawKernels(experiment, seen, xs);
    this.#drawWeights(experiment, seen, xs);
    this.#handles.draw();
    for (let i = 0; i < experiment.values.length; i++)
      this.#handles.element(i)?.toggleAttribute('data-outlier', outliers.includes(i));
  }

  refine(): void {}

  emphasize(key: number): void {
    this.#chart.emphasize(key);
    this.#weights.emphasize(key);
  }

  #curve(fit: Fit, xs: Float64Array, sum: boolean): Curve {
    const { key, slot } = fit.model;
    const ys = asLong(this.#ys.get(key), xs.length);
    this.#ys.set(key, ys);
    fit.interpolant?.evaluate(xs, ys);
    return { key, slot, label: fit.label, xs, ys, sum, stale: fit.problem !== undefined };
  }

  #drawKernels(experiment: Experiment, fits: readonly Fit[], xs: Float64Array): void {
    const paths: [string, number][] = [];
    if (experiment.show.kernels) {
      for (const fit of fits) {
        if (fit.problem) continue;
        const kernels = weightedKernels(this.#hb, fit, dataOf(experiment), xs);
        if (!kernels) continue;
        for (let k = 0; k < kernels.length / xs.length; k++) paths.push([this.#hump(xs, kernels, k), k]);
      }
    }
    match(this.#kernels, 'path', paths.length);
    paths.forEach(([d, k], i) => {
      const path = this.#kernels.children[i] as SVGPathElement;
      path.setAttribute('d', d);
      path.dataset.slot = String(k % 8);
    });
  }

  /** A kernel with the area between it and zero. */
  #hump(xs: Float64Array, kernels: Float64Array, k: number): string {
    const zero = this.#chart.y(0).toFixed(1);
    return `M0 ${zero}${this.#chart.path(xs, kernels, 1, k * xs.length).replace('M', 'L')}L${this.#chart.width} ${zero}Z`;
  }

  /** The chosen point's weight along the line, for each interpolant: its cardinal function. */
  #drawWeights({ show, picked, values, frame }: Experiment, fits: readonly Fit[], xs: Float64Array): void {
    const wanted = show.cardinal && picked >= 0;
    this.#weightsPart.hidden = !wanted;
    if (!wanted) return;
    this.#weightsTitle.textContent = `Weight of point ${picked}`;
    this.#weights.frame = [frame[0], frame[1], -0.5, 1.3];
    const curves = fits
      .filter((fit) => !fit.problem)
      .map((fit) => {
        const { key, slot } = fit.model;
        const ys = asLong(this.#shares.get(key), xs.length * values.length);
        this.#shares.set(key, ys);
        fit.interpolant?.weights(xs, ys);
        return { key, slot, label: fit.label, xs, ys, stride: values.length, first: picked };
      });
    this.#weights.draw(curves);
  }
}
