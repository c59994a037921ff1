import { callback, finite, optional, type Reader, type Readers, refused, text } from '../../../wasm/ts/arguments.ts';
import { h, match, svg, write } from '../../ui/dom.ts';
import { Chart, type Curve } from './chart.ts';
import type { Kit, Panel } from './figure.ts';
import { array, check, listed, maybe } from './given.ts';
import { Handles, type PointActions } from './handles.ts';
import { POINT_READERS, type PointEditing, type PointOptions, pointActions } from './point-actions.ts';
import { tidy } from './point-set.ts';
import { asLong, type Frame, Samples } from './samples.ts';
import { swatch } from './swatch.ts';

/** A function of one number: an interpolant, or anything that fills an array. */
export interface Evaluable {
  evaluate(xs: Float64Array, out: Float64Array): unknown;
}

/** Something to drag in a plot, besides points. */
export interface PlotHandle {
  /** "Kernel 3, weight 0.4" */
  readonly name: string;
  readonly at: readonly [x: number, y: number];
  move(x: number, y: number): void;
}

/** What a plot of curves shows. */
export interface LinePlotOptions<M, S> extends Pick<Panel<M, S>, 'shown'> {
  /** What the plot shows, for those who do not see it. */
  readonly label: string;
  /** Above it. */
  title?(state: S): string;
  /** Left, right, bottom, top. */
  readonly frame: Frame | ((state: S) => Frame);
  /** Places at which curves pass exactly, besides the even ones; the points, where this is left out. */
  through?(state: S): readonly number[];
  /** Lower than others: it goes with another one. */
  readonly low?: boolean;
  /** Points that are dragged, added by a double click and removed. */
  readonly points?: PointOptions<M, S>;
  draw(plot: LinePlot<M, S>, made: M, state: S, change: (patch: Partial<S>) => void): void;
}

const EDGES = 'Give [left, right, bottom, top], left below right and bottom below top.';
const edges = array(4, EDGES);
const frame: Reader<unknown> = (value, name) => {
  const { 0: left = 0, 1: right = 0, 2: bottom = 0, 3: top = 0 } = edges(value, name);
  if (left >= right || bottom >= top) throw refused(name, value, EDGES);
};

const evaluable: Reader<Evaluable> = (value, name) => {
  if (typeof (value as Evaluable | null)?.evaluate === 'function') return value as Evaluable;
  throw refused(name, value, 'Give an interpolant, or { evaluate(xs, out) }.');
};

const LINE_PLOT = {
  shown: maybe.callback,
  label: text,
  title: maybe.callback,
  frame: (value, name) => (typeof value === 'function' ? value : frame(value, name)),
  through: maybe.callback,
  low: maybe.flag,
  points: optional((value, name) => check(value, POINT_READERS, name, 'Give { points: "the channel of them" }.')),
  draw: callback,
} satisfies Readers<LinePlotOptions<unknown, unknown>>;

const CURVE = {
  detail: maybe.text,
  dashed: maybe.flag,
  key: maybe.number,
  slot: maybe.number,
  stale: maybe.flag,
} satisfies Readers<CurveOptions>;

const PLOT_HANDLE = { name: text, at: array(2, 'Give [x, y].'), move: callback } satisfies Readers<PlotHandle>;
const plotHandles = listed(PLOT_HANDLE, 'Give { name, at: [x, y], move(x, y) }.');

/**
 * A panel with curves over a line, and handles on it.
 *
 * ```ts
 * const panel = linePlot({
 *   label: 'A line',
 *   frame: [0, 5, 0, 5],
 *   draw: (plot) => plot.curve('Line', { evaluate: (xs, out) => out.set(xs) }),
 * });
 * ```
 */
export function linePlot<M, S>(options: LinePlotOptions<M, S>): Panel<M, S> {
  check(options, LINE_PLOT, 'options', 'Give { label, frame, draw }.');
  const { shown, draw } = options;
  return {
    ...(shown && { shown }),
    open: (kit) => {
      const plot = new LinePlot<M, S>(kit, options);
      return {
        element: plot.element,
        draw: (made, state) => {
          plot.begin(state);
          draw(plot, made, state, kit.change);
          plot.end();
        },
        dispose: () => plot.dispose(),
      };
    },
  };
}

type Group = 'points' | 'others';

export interface CurveOptions {
  readonly detail?: string;
  readonly dashed?: boolean;
  /** By which it is emphasized, and which color and dash it has; else its number. */
  readonly key?: number;
  readonly slot?: number;
  readonly stale?: boolean;
}

/**
 * What a figure draws with: curves and handles are named anew for each frame.
 *
 * ```ts
 * const panel = linePlot({
 *   label: 'A parabola',
 *   frame: [0, 5, 0, 25],
 *   draw: (plot: LinePlot<object, object>) => plot.curve('Parabola', { evaluate: (xs, out) => out.set(xs.map((x) => x * x)) }),
 * });
 * ```
 */
export class LinePlot<M, S> {
  readonly element: HTMLElement;
  readonly #kit: Kit<S, M>;
  readonly #options: Omit<LinePlotOptions<M, S>, 'draw'>;
  readonly #chart: Chart;
  readonly #title = h('h3', { class: 'chart-title' });
  /** Which line is whose, where there is no room beside the curves. */
  readonly #legend = h('ul', { class: 'legend', 'aria-hidden': 'true' });
  readonly #samples = new Samples();
  readonly #areas = svg('g', { class: 'kernels' });
  readonly #rows: Float64Array[] = [];
  readonly #points: PointEditing | undefined;
  readonly #groups: readonly (readonly [Group, Handles, PointActions])[];
  #handles: readonly PlotHandle[] = [];
  #curves: Curve[] = [];
  #paths: string[] = [];
  #rules: [at: string, words: string][] = [];
  #xs: Float64Array = new Float64Array();
  #used = 0;
  #listed = '';

  constructor(kit: Kit<S, M>, options: Omit<LinePlotOptions<M, S>, 'draw'>) {
    [this.#kit, this.#options] = [kit, options];
    this.#chart = new Chart(true, () => kit.redraw());
    this.#chart.frame = this.#frame(kit.state);
    this.#chart.under.append(this.#areas);
    this.#chart.element.classList.add(options.low ? 'low-chart' : 'main-chart');
    this.#chart.element.role = 'group';
    this.#chart.element.ariaLabel = options.label;
    this.#points = options.points && pointActions(kit, (state) => this.#frame(state), options.points);
    const groups = [...(this.#points ? [['points', this.#points] as const] : []), ['others', this.#others()] as const];
    this.#groups = groups.map(([name, actions]) => [name, this.#group(actions), actions] as const);
    this.element = h(
      'div',
      { class: 'line-view' },
      ...(options.title ? [this.#title] : []),
      this.#chart.element,
      ...(options.low ? [] : [this.#legend]),
    );
  }

  /** Places at which functions are evaluated: even ones, and the points. */
  get xs(): Float64Array {
    return this.#xs;
  }

  curve(name: string, f: Evaluable, options: CurveOptions = {}): this {
    text(name, 'name');
    evaluable(f, 'f');
    check(options, CURVE, 'options', 'Give an object of options.');
    const { detail = '', dashed, key, slot, stale } = options;
    const i = this.#curves.length;
    const label = { name, detail };
    this.#curves.push({
      key: key ?? i + 1,
      slot: slot ?? i,
      label,
      xs: this.#xs,
      ys: this.#row(f),
      sum: !!dashed,
      stale: !!stale,
    });
    return this;
  }

  /** A function with the area between it and zero. */
  area(f: Evaluable): this {
    evaluable(f, 'f');
    const chart = this.#chart;
    const zero = chart.y(0).toFixed(1);
    this.#paths.push(`M0 ${zero}${chart.path(this.#xs, this.#row(f)).replace('M', 'L')}L${chart.width} ${zero}Z`);
    return this;
  }

  /** A line from below to above, and what it marks. */
  rule(x: number, words: string): this {
    const at = this.#chart.x(finite(x, 'x')).toFixed(1);
    this.#rules.push([at, text(words, 'words')]);
    return this;
  }

  handles(handles: readonly PlotHandle[]): this {
    plotHandles(handles, 'handles');
    this.#handles = handles;
    return this;
  }

  begin(state: S): void {
    [this.#curves, this.#paths, this.#rules, this.#used] = [[], [], [], 0];
    write(this.#title, this.#options.title?.(state) ?? '');
    this.#chart.measure();
    this.#chart.frame = this.#frame(state);
    this.#xs = this.#samples.spread(this.#chart.frame, this.#options.through?.(state) ?? this.#points?.set.places ?? []);
  }

  end(): void {
    this.#chart.draw(this.#curves);
    match(this.#areas, this.#paths.length, () => svg('path'));
    this.#paths.forEach((d, i) => {
      const path = this.#areas.children[i] as SVGPathElement;
      path.setAttribute('d', d);
      path.dataset.slot = String(i % 8);
    });
    this.#chart.over.replaceChildren(
      ...this.#rules.flatMap(([at, words]) => [
        svg('path', { class: 'rule', d: `M${at} 0V${this.#chart.height}` }),
        svg('text', { x: at, y: 14, dx: 6 }, words),
      ]),
    );
    for (const [kind, handles, { count }] of this.#groups) {
      handles.draw();
      for (let i = 0; i < count; i++) {
        handles.element(i)?.setAttribute('data-kind', kind);
        handles.element(i)?.toggleAttribute('data-outlier', kind === 'points' && !!this.#points?.outliers.includes(i));
      }
    }
    this.#list();
  }

  dispose(): void {
    this.#chart.dispose();
  }

  #frame(state: S): Frame {
    const { frame } = this.#options;
    return typeof frame === 'function' ? frame(state) : frame;
  }

  #list(): void {
    this.#legend.hidden = this.#chart.named;
    const words = this.#curves.map(({ slot, label }) => [slot, [label.name, label.detail].filter(Boolean).join(', ')] as const);
    if (String(words) === this.#listed) return;
    this.#listed = String(words);
    this.#legend.replaceChildren(...words.map(([slot, text]) => h('li', {}, swatch(slot), h('span', {}, text))));
  }

  #row(f: Evaluable): Float64Array {
    const row = asLong(this.#rows[this.#used], this.#xs.length);
    this.#rows[this.#used++] = row;
    f.evaluate(this.#xs, row);
    return row;
  }

  /** What happens to handles that are no points. */
  #others(): PointActions {
    const [kit, list] = [this.#kit, () => this.#handles];
    let picked = -1;
    return {
      get count() {
        return list().length;
      },
      get picked() {
        return picked;
      },
      placeOf: (i) => list()[i]?.at ?? [0, 0],
      move: (i, x, y) => {
        const [left, right, bottom, top] = this.#chart.frame;
        const [across, up] = [Math.min(Math.max(x, left), right), Math.min(Math.max(y, bottom), top)];
        list()[i]?.move(tidy(across, right - left), tidy(up, top - bottom));
      },
      hold: () => {
        const before = kit.state;
        return () => kit.change(before);
      },
      raise: () => {},
      pick: (i) => {
        picked = i;
        kit.redraw();
      },
      addAt: () => {},
      remove: () => {},
      describe: (i) => list()[i]?.name ?? '',
    };
  }

  #group(actions: PointActions): Handles {
    const chart = this.#chart;
    return new Handles(
      chart.area,
      {
        get size() {
          return [chart.width, chart.height] as const;
        },
        screen: (i) => {
          const [x, y] = actions.placeOf(i);
          return [chart.x(x), chart.y(y)];
        },
        place: (px, py) => chart.at(px, py),
        drag: (i, px, py) => actions.move(i, ...chart.at(px, py)),
        get spans() {
          const [left, right, bottom, top] = chart.frame;
          return [right - left, top - bottom] as const;
        },
      },
      actions,
    );
  }
}
