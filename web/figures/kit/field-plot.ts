import { h, readable, svg } from '../../ui/dom.ts';
import { Chart } from './chart.ts';
import { ColorMap } from './color-map.ts';
import { ColorScale } from './color-scale.ts';
import { FieldGrid, type FieldSource, Pace } from './field.ts';
import { FieldPanel } from './field-panel.ts';
import type { Kit, OpenPanel, Panel } from './figure.ts';
import { addPoint, movePoint, type PointSet, removePoint, tidy } from './point-set.ts';
import { asLong, type Frame } from './samples.ts';
import { pointsOn, roundRange, type SectionKind, sectionOf, sectionSamples } from './section.ts';

const SECTION_STEPS = 300;

interface FieldMap {
  readonly name: string;
  readonly detail: string;
  readonly source: FieldSource;
}

interface FieldPlotOptions<M, S> {
  /** Left, right, bottom, top. */
  readonly frame: Frame;
  /** The channel of the points. */
  readonly points: keyof S & string;
  /** Functions of the plane, a map each. */
  maps(made: M, state: S): readonly FieldMap[];
  /** Whether each map has a scale of its own, instead of one for all. */
  ownScales?(state: S): boolean;
  section?(state: S): SectionKind;
}

/** A panel with maps of functions over the plane, under one set of points, and a section through all of them. */
export function fieldPlot<M, S>(options: FieldPlotOptions<M, S>): Panel<M, S> {
  return { open: (kit) => new FieldPlot(kit, options) };
}

class FieldPlot<M, S> implements OpenPanel<M, S> {
  readonly element: HTMLElement;
  readonly #kit: Kit<S>;
  readonly #options: FieldPlotOptions<M, S>;
  readonly #maps = h('div', { class: 'fields', role: 'group', 'aria-label': 'Maps' });
  readonly #scale: ColorScale;
  readonly #chart: Chart;
  readonly #panels: FieldPanel[] = [];
  readonly #grid = new FieldGrid();
  readonly #pace = new Pace();
  readonly #rows: Float64Array[] = [];
  readonly #axis = new Float64Array(SECTION_STEPS);
  readonly #places = new Float64Array(2 * SECTION_STEPS);
  #picked = -1;

  constructor(kit: Kit<S>, options: FieldPlotOptions<M, S>) {
    [this.#kit, this.#options] = [kit, options];
    this.#scale = new ColorScale((value) => this.#setValue(this.#picked, value));
    this.#chart = new Chart(true, () => kit.redraw());
    this.#chart.element.classList.add('section-chart');
    this.element = h('div', { class: 'plane-view' }, this.#maps, this.#scale.element, this.#chart.element);
  }

  draw(made: M, state: S): void {
    this.#draw(made, state, false);
  }

  refine(made: M, state: S): void {
    this.#draw(made, state, true);
  }

  dispose(): void {
    for (const panel of this.#panels) panel.dispose();
    this.#chart.dispose();
  }

  get #points(): PointSet {
    return this.#kit.state[this.#options.points] as PointSet;
  }

  #draw(made: M, state: S, resting: boolean): void {
    const { frame, maps, ownScales, section } = this.#options;
    const list = maps(made, state);
    const { values, places } = this.#points;
    const line = sectionOf({ frame, show: { section: section?.(state) ?? 'off', sectionAt: 0 } });
    while (this.#panels.length > list.length) this.#panels.pop()?.dispose();
    while (this.#panels.length < list.length) this.#add();
    const start = performance.now();
    this.#grid.lay(frame, this.#pace.size(resting));
    const { size, queries } = this.#grid;
    const fields = list.map(({ source }, i) => {
      this.#panels[i]?.measure();
      return this.#panels[i]?.field.sample(source, queries) ?? new Float64Array();
    });
    const [low, high] = [Math.min(...values), Math.max(...values)];
    const all = new ColorMap('around-zero', ...roundRange(fields, low, high));
    list.forEach(({ name, detail }, i) => {
      const [panel, field] = [this.#panels[i], fields[i]];
      if (!panel || !field || panel.side === 0) return;
      const colors = ownScales?.(state) ? new ColorMap('around-zero', ...roundRange([field], field[0] ?? 0, field[0] ?? 0)) : all;
      panel.name({ name, detail }, i);
      panel.paint(size, colors, true, line?.ends);
      panel.points(values, colors);
    });
    this.#pace.took(performance.now() - start, size);
    const picked = values[this.#picked];
    this.#scale.show(
      all,
      picked === undefined ? 'Value (choose a point to change its own)' : `Value of point ${this.#picked}`,
      picked,
    );
    this.#scale.element.hidden = ownScales?.(state) ?? false;
    this.#chart.element.hidden = !line;
    if (!line) return;
    sectionSamples(line, this.#places, this.#axis);
    const curves = list.map(({ name, detail, source }, i) => {
      const ys = asLong(this.#rows[i], SECTION_STEPS);
      this.#rows[i] = ys;
      source.evaluate(this.#places, ys);
      return { key: i + 1, slot: i, label: { name, detail }, xs: this.#axis, ys };
    });
    this.#chart.frame = [
      ...line.along,
      ...roundRange(
        curves.map(({ ys }) => ys),
        low,
        high,
      ),
    ];
    this.#chart.draw(curves);
    this.#chart.over.replaceChildren(
      ...pointsOn(line, { points: places, values, frame }).map(({ at, point }) =>
        svg('circle', { class: 'mark', cx: this.#chart.x(at).toFixed(1), cy: this.#chart.y(values[point] ?? 0).toFixed(1), r: 5 }),
      ),
    );
  }

  #put(set: PointSet): void {
    this.#kit.change({ [this.#options.points]: set } as Partial<S>);
  }

  #setValue(i: number, value: number): void {
    const set = this.#points;
    const span = Math.max(...set.values) - Math.min(...set.values) || 1;
    if (set.values[i] !== undefined) this.#put({ ...set, values: set.values.with(i, tidy(value, span)) });
  }

  #add(): void {
    const { frame } = this.#options;
    const [left, right, bottom, top] = frame;
    const points = () => this.#points;
    const picked = () => this.#picked;
    const panel = new FieldPanel({
      slot: this.#panels.length,
      first: this.#panels.length === 0,
      frame: () => frame,
      resized: () => this.#kit.redraw(),
      actions: {
        get count() {
          return points().values.length;
        },
        get picked() {
          return picked();
        },
        placeOf: (i) => [points().places[2 * i] ?? 0, points().places[2 * i + 1] ?? 0],
        move: (i, x, y) => {
          const [across, up] = [Math.min(Math.max(x, left), right), Math.min(Math.max(y, bottom), top)];
          this.#put(movePoint(points(), i, tidy(across, right - left), tidy(up, top - bottom)));
        },
        hold: () => {
          const before = this.#kit.state;
          return () => this.#kit.change(before);
        },
        raise: (i, hundredths) => this.#setValue(i, (points().values[i] ?? 0) + hundredths / 100),
        setValue: (i, value) => this.#setValue(i, value),
        pick: (i) => {
          this.#picked = i;
          this.#kit.redraw();
        },
        addAt: (x, y) => this.#put(addPoint(points(), [tidy(x, right - left), tidy(y, top - bottom)], 0)),
        remove: (i) => {
          if (points().values.length > 1) this.#put(removePoint(points(), i));
        },
        describe: (i) => {
          const { places, values } = points();
          return `Point ${i}, x ${readable(places[2 * i] ?? 0)}, y ${readable(places[2 * i + 1] ?? 0)}, value ${readable(values[i] ?? 0)}`;
        },
        settle: () => {},
      },
    });
    this.#panels.push(panel);
    this.#maps.append(panel.element);
    this.#maps.dataset.count = String(this.#panels.length);
  }
}
