import { h, readable, svg } from '../../ui/dom.ts';
import { Chart, type Curve, match } from './chart.ts';
import type { Kit, Panel } from './figure.ts';
import { Handles } from './handles.ts';
import { addPoint, movePoint, type PointSet, placeOf, removePoint, tidy } from './point-set.ts';
import { asLong, type Frame, Samples } from './samples.ts';

/** A function of one number: an interpolant, or anything that fills an array. */
interface Evaluable {
  evaluate(xs: Float64Array, out: Float64Array): unknown;
}

/** Something to drag in a plot, besides points. */
interface PlotHandle {
  /** "Kernel 3, weight 0.4" */
  readonly name: string;
  readonly at: readonly [x: number, y: number];
  move(x: number, y: number): void;
}

interface LinePlotOptions<M, S> {
  /** What the plot shows, for those who do not see it. */
  readonly label: string;
  /** Left, right, bottom, top. */
  readonly frame: Frame;
  draw(plot: LinePlot<S>, made: M, state: S, change: (patch: Partial<S>) => void): void;
}

/** A panel with curves over a line, and handles on it. */
export function linePlot<M, S>({ label, frame, draw }: LinePlotOptions<M, S>): Panel<M, S> {
  return {
    open: (kit) => {
      const plot = new LinePlot<S>(kit, label, frame);
      return {
        element: plot.element,
        draw: (made, state) => {
          plot.begin();
          draw(plot, made, state, kit.change);
          plot.end();
        },
        dispose: () => plot.dispose(),
      };
    },
  };
}

type Group = 'points' | 'others';

/** What a figure draws with: curves and handles are named anew for each frame. */
class LinePlot<S> {
  readonly element: HTMLElement;
  readonly #kit: Kit<S>;
  readonly #chart: Chart;
  readonly #samples = new Samples();
  readonly #areas = svg('g', { class: 'kernels' });
  readonly #rows: Float64Array[] = [];
  readonly #groups: Readonly<Record<Group, Handles>>;
  readonly #handles: Record<Group, readonly (PlotHandle & { remove?(): void })[]> = { points: [], others: [] };
  #add: ((x: number, y: number) => void) | undefined;
  #curves: Curve[] = [];
  #paths: string[] = [];
  #rules: [at: string, words: string][] = [];
  #xs: Float64Array = new Float64Array();
  #used = 0;
  #marks: readonly number[] = [];

  constructor(kit: Kit<S>, label: string, frame: Frame) {
    this.#kit = kit;
    this.#chart = new Chart(true, () => kit.redraw());
    this.#chart.frame = frame;
    this.#chart.under.append(this.#areas);
    this.#chart.element.classList.add('main-chart');
    this.#chart.element.role = 'group';
    this.#chart.element.ariaLabel = label;
    this.#groups = { points: this.#group('points'), others: this.#group('others') };
    this.element = h('div', { class: 'line-view' }, this.#chart.element);
  }

  /** Places at which curves pass exactly, besides the even ones. */
  through(places: readonly number[]): this {
    this.#marks = places;
    this.#xs = this.#samples.spread(this.#chart.frame, places);
    return this;
  }

  curve(name: string, f: Evaluable, { detail = '', dashed = false }: { detail?: string; dashed?: boolean } = {}): this {
    const slot = this.#curves.length;
    this.#curves.push({ key: slot + 1, slot, label: { name, detail }, xs: this.#xs, ys: this.#row(f), sum: dashed });
    return this;
  }

  /** A function with the area between it and zero. */
  area(f: Evaluable): this {
    const chart = this.#chart;
    const zero = chart.y(0).toFixed(1);
    this.#paths.push(`M0 ${zero}${chart.path(this.#xs, this.#row(f)).replace('M', 'L')}L${chart.width} ${zero}Z`);
    return this;
  }

  /** A line from below to above, and what it marks. */
  rule(x: number, words: string): this {
    const at = this.#chart.x(x).toFixed(1);
    this.#rules.push([at, words]);
    return this;
  }

  /** The points of a channel: dragged, added by a double click, removed. */
  points(key: keyof S & string): this {
    const set = this.#kit.state[key] as PointSet;
    const put = (changed: PointSet) => this.#kit.change({ [key]: changed } as Partial<S>);
    this.#handles.points = set.values.map((value, i) => ({
      name: `Point ${i}, x ${readable(set.places[i] ?? 0)}, value ${readable(value)}`,
      at: placeOf(set, i),
      move: (x, y) => put(movePoint(this.#kit.state[key] as PointSet, i, x, y)),
      ...(set.values.length > 1 && { remove: () => put(removePoint(this.#kit.state[key] as PointSet, i)) }),
    }));
    this.#add = (x, y) => put(addPoint(this.#kit.state[key] as PointSet, [x], y));
    return this;
  }

  handles(handles: readonly PlotHandle[]): this {
    this.#handles.others = handles;
    return this;
  }

  begin(): void {
    [this.#curves, this.#paths, this.#rules, this.#used] = [[], [], [], 0];
    this.#chart.measure();
    this.through(this.#marks);
  }

  end(): void {
    this.#chart.draw(this.#curves);
    match(this.#areas, 'path', this.#paths.length);
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
    for (const [kind, group] of Object.entries(this.#groups)) {
      group.draw();
      for (let i = 0; i < this.#handles[kind as Group].length; i++) group.element(i)?.setAttribute('data-kind', kind);
    }
  }

  dispose(): void {
    this.#chart.dispose();
  }

  #row(f: Evaluable): Float64Array {
    const row = asLong(this.#rows[this.#used], this.#xs.length);
    this.#rows[this.#used++] = row;
    f.evaluate(this.#xs, row);
    return row;
  }

  #group(name: Group): Handles {
    const [chart, kit] = [this.#chart, this.#kit];
    const list = () => this.#handles[name];
    const spans = () => [chart.frame[1] - chart.frame[0], chart.frame[3] - chart.frame[2]] as const;
    let picked = -1;
    const move = (i: number, x: number, y: number) => {
      const [left, right, bottom, top] = chart.frame;
      const [wide, tall] = spans();
      list()[i]?.move(tidy(Math.min(Math.max(x, left), right), wide), tidy(Math.min(Math.max(y, bottom), top), tall));
    };
    const board = {
      get size() {
        return [chart.width, chart.height] as const;
      },
      screen: (i: number) => {
        const [x, y] = list()[i]?.at ?? [0, 0];
        return [chart.x(x), chart.y(y)] as const;
      },
      place: (px: number, py: number) => chart.at(px, py),
      drag: (i: number, px: number, py: number) => move(i, ...chart.at(px, py)),
      get spans() {
        return spans();
      },
    };
    return new Handles(chart.area, board, {
      get count() {
        return list().length;
      },
      get picked() {
        return picked;
      },
      placeOf: (i) => list()[i]?.at ?? [0, 0],
      move,
      hold: () => {
        const before = kit.state;
        return () => kit.change(before);
      },
      raise: () => {},
      pick: (i) => {
        picked = i;
        kit.redraw();
      },
      addAt: (x, y) => {
        const [wide, tall] = spans();
        if (name === 'points') this.#add?.(tidy(x, wide), tidy(y, tall));
      },
      remove: (i) => list()[i]?.remove?.(),
      describe: (i) => list()[i]?.name ?? '',
      settle: () => {},
    });
  }
}
