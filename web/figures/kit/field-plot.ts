import { ColorMap } from '../../ui/color-map.ts';
import { h, svg } from '../../ui/dom.ts';
import { lazy, NotFetched } from '../../ui/lazy.ts';
import { Trouble } from '../../ui/trouble.ts';
import { Chart } from './chart.ts';
import { ColorScale } from './color-scale.ts';
import { FieldGrid, type FieldSource, Pace } from './field.ts';
import { FieldPanel, type Relief } from './field-panel.ts';
import type { Kit, OpenPanel, Panel } from './figure.ts';
import { type PointEditing, type PointOptions, pointActions } from './point-actions.ts';
import { asLong, type Frame } from './samples.ts';
import { type Line, pointsOn, roundRange, type SectionKind, sectionOf, sectionSamples } from './section.ts';
import type { Surfaces } from './surfaces.ts';
import { brief } from './words.ts';

const SECTION_STEPS = 300;

const surfacesPart = lazy(() => import('./surfaces.ts'), 'The part of this page that draws surfaces');

interface FieldMap {
  readonly name: string;
  readonly detail: string;
  readonly source: FieldSource;
  /** By which it is emphasized, and which color and dash it has in the section; else its number. */
  readonly key?: number;
  readonly slot?: number;
  /** Not of the present data, because those were refused. */
  readonly stale?: boolean;
}

interface FieldPlotOptions<M, S> extends PointOptions<M, S>, Pick<Panel<M, S>, 'shown'> {
  /** Left, right, bottom, top. */
  readonly frame: Frame | ((state: S) => Frame);
  /** Functions of the plane, a map each. */
  maps(made: M, state: S): readonly FieldMap[];
  /** The colors of all maps, over the range of `PointOptions`; else around zero, over what is drawn. */
  colors?(state: S): 'viridis' | 'around-zero';
  /** Whether each map has a scale of its own, instead of one for all. */
  ownScales?(state: S): boolean;
  /** The point whose weight is shown instead of the functions; −1 for none. */
  weightOf?(state: S): number;
  isolines?(state: S): boolean;
  /** Surfaces instead of maps; `set` says so where they do not come. */
  readonly surfaces?: { on(state: S): boolean; set(state: S, on: boolean): Partial<S> };
  section?(state: S): SectionKind;
  /** Where it lies, in units of the points. */
  sectionAt?(state: S): number;
}

/** A panel with maps of functions over the plane, or surfaces, under one set of points, and a section through all of them. */
export function fieldPlot<M, S>(options: FieldPlotOptions<M, S>): Panel<M, S> {
  const { shown } = options;
  return { ...(shown && { shown }), open: (kit) => new FieldPlot(kit, options) };
}

class FieldPlot<M, S> implements OpenPanel<M, S> {
  readonly element: HTMLElement;
  readonly #kit: Kit<S, M>;
  readonly #options: FieldPlotOptions<M, S>;
  readonly #points: PointEditing;
  readonly #maps = h('div', { class: 'fields', role: 'group', 'aria-label': 'Maps' });
  readonly #scale: ColorScale;
  readonly #sectionTitle = h('h3', { class: 'chart-title' });
  readonly #chart: Chart;
  readonly #sectionPart: HTMLElement;
  readonly #note = h('p', { class: 'soft', hidden: true });
  readonly #trouble = new Trouble(this.#note, () => null);
  readonly #panels: FieldPanel[] = [];
  readonly #grid = new FieldGrid();
  readonly #pace = new Pace();
  readonly #rows: Float64Array[] = [];
  readonly #axis = new Float64Array(SECTION_STEPS);
  readonly #places = new Float64Array(2 * SECTION_STEPS);
  #surfaces: Surfaces | 'coming' | undefined;
  /** What was painted last, and whether at leisure. */
  #painted: { readonly made: M; readonly state: S; readonly fine: boolean } | undefined;

  constructor(kit: Kit<S, M>, options: FieldPlotOptions<M, S>) {
    [this.#kit, this.#options] = [kit, options];
    this.#points = pointActions(kit, (state) => this.#frame(state), options);
    this.#scale = new ColorScale((value) => this.#points.setValue(this.#points.picked, value));
    this.#chart = new Chart(true, () => kit.redraw());
    this.#chart.element.classList.add('section-chart');
    this.#sectionPart = h('div', { class: 'chart-part' }, this.#sectionTitle, this.#chart.element);
    this.element = h('div', { class: 'plane-view' }, this.#maps, this.#note, this.#scale.element, this.#sectionPart);
  }

  draw(made: M, state: S): void {
    this.#draw(made, state, false);
  }

  refine(made: M, state: S): void {
    if (!this.#painted?.fine) this.#draw(made, state, true);
  }

  dispose(): void {
    for (const panel of this.#panels) panel.dispose();
    this.#chart.dispose();
    if (typeof this.#surfaces === 'object') this.#surfaces.dispose();
  }

  #frame(state: S): Frame {
    const { frame } = this.#options;
    return typeof frame === 'function' ? frame(state) : frame;
  }

  #draw(made: M, state: S, resting: boolean): void {
    const { maps, ownScales, section, sectionAt, colors, range, weightOf } = this.#options;
    const frame = this.#frame(state);
    const list = maps(made, state);
    const { values } = this.#points.set;
    const { picked, outliers } = this.#points;
    const weight = weightOf?.(state) ?? -1;
    const line = sectionOf(frame, section?.(state) ?? 'off', sectionAt?.(state) ?? 0);
    while (this.#panels.length > list.length) this.#panels.pop()?.dispose();
    while (this.#panels.length < list.length) this.#add();
    this.#maps.dataset.count = String(list.length);
    const resized = this.#panels.filter((panel) => panel.measure()).length > 0;
    const anew = resting || resized || this.#changed(made, state, weight >= 0);
    if (anew) this.#sample(list, frame, resting, weight);
    const valueColors =
      colors && range
        ? new ColorMap(colors(state), ...range(state))
        : new ColorMap('around-zero', ...this.#rangeOf(this.#panels.map(({ field }) => field.values)));
    const all = weight < 0 ? valueColors : new ColorMap('around-zero', -1, 1);
    const own = (i: number) => {
      const field = this.#panels[i]?.field.values ?? new Float64Array();
      return ownScales?.(state) ? new ColorMap('around-zero', ...roundRange([field], field[0] ?? 0, field[0] ?? 0)) : all;
    };
    if (anew) this.#paint(list, state, own, line, weight >= 0);
    this.#painted = { made, state, fine: resting || (!anew && !!this.#painted?.fine) };
    for (const [i, panel] of this.#panels.entries()) panel.points(values, weight < 0 ? own(i) : valueColors, outliers);
    const value = values[picked];
    this.#scale.show(
      all,
      weight >= 0
        ? `Weight of point ${weight}`
        : value === undefined
          ? 'Value (choose a point to change its own)'
          : `Value of point ${picked}: ${brief(value)}`,
      weight < 0 ? value : undefined,
    );
    this.#scale.element.hidden = ownScales?.(state) ?? false;
    this.#drawSection(list, line, frame);
  }

  /** Whether the maps look different from the last time: else it is only a point that was chosen. */
  #changed(made: M, state: S, ofPoint: boolean): boolean {
    const { picked, surfaces } = this.#options;
    const last = this.#painted;
    if (last?.made !== made || ofPoint || surfaces?.on(state)) return true;
    const same = (key: string) => key === picked || last.state[key as keyof S] === state[key as keyof S];
    return !Object.keys(state as object).every(same);
  }

  #rangeOf(fields: readonly Float64Array[]): [number, number] {
    const { values } = this.#points.set;
    return roundRange(fields, Math.min(...values), Math.max(...values));
  }

  #sample(list: readonly FieldMap[], frame: Frame, resting: boolean, weight: number): void {
    const start = performance.now();
    this.#grid.lay(frame, this.#pace.size(resting));
    const { size, queries } = this.#grid;
    list.forEach(({ source, stale }, i) => {
      this.#panels[i]?.field.sample(source, queries, stale ? -1 : weight, this.#points.count);
    });
    if (list.length > 0) this.#pace.took(performance.now() - start, size);
  }

  #paint(list: readonly FieldMap[], state: S, own: (i: number) => ColorMap, line: Line | undefined, ofPoint: boolean): void {
    const surfaces = this.#options.surfaces?.on(state) ? this.#wantSurfaces() : undefined;
    this.element.toggleAttribute('data-surface', !!surfaces);
    this.element.toggleAttribute('data-flat', !!surfaces && ofPoint);
    const { size } = this.#grid;
    list.forEach((map, i) => {
      const panel = this.#panels[i];
      if (!panel || panel.side === 0) return;
      panel.name(map, map.slot ?? i, map.key ?? i + 1);
      panel.stale = !!map.stale;
      panel.relief = surfaces && !ofPoint ? this.#relief(surfaces) : undefined;
      if (surfaces) surfaces.paint(panel.canvas, panel.field.values, size, own(i), this.#ground, ofPoint);
      else panel.paint(size, own(i), this.#options.isolines?.(state) ?? true, line?.ends);
    });
  }

  /** What surfaces stand over. */
  get #ground() {
    return { frame: this.#frame(this.#kit.state), ...this.#points.set, picked: this.#points.picked };
  }

  /** Points over a surface of what is drawn last. */
  #relief(surfaces: Surfaces): Relief {
    return {
      screen: (i) => surfaces.screen(this.#ground, i),
      value: (i, down) => surfaces.value(this.#ground, i, down),
    };
  }

  #drawSection(list: readonly FieldMap[], line: Line | undefined, frame: Frame): void {
    this.#sectionPart.hidden = !line;
    if (!line) return;
    this.#sectionTitle.textContent = line.title;
    sectionSamples(line, this.#places, this.#axis);
    const curves = list.map(({ name, detail, source, key = 0, slot, stale }, i) => {
      const ys = asLong(this.#rows[i], SECTION_STEPS);
      this.#rows[i] = ys;
      source.evaluate(this.#places, ys);
      return { key: key || i + 1, slot: slot ?? i, label: { name, detail }, xs: this.#axis, ys, stale: !!stale };
    });
    this.#chart.frame = [...line.along, ...this.#rangeOf(curves.map(({ ys }) => ys))];
    this.#chart.draw(curves);
    const { values, places: points } = this.#points.set;
    this.#chart.over.replaceChildren(
      ...pointsOn(line, { points, values, frame }).map(({ at, point }) =>
        svg('circle', { class: 'mark', cx: this.#chart.x(at).toFixed(1), cy: this.#chart.y(values[point] ?? 0).toFixed(1), r: 5 }),
      ),
    );
  }

  #add(): void {
    const [frame, redraw] = [() => this.#frame(this.#kit.state), () => this.#kit.redraw()];
    const panel = new FieldPanel(this.#panels.length === 0, frame, this.#points, redraw);
    this.#panels.push(panel);
    this.#maps.append(panel.element);
  }

  /** three.js comes when somebody asks for surfaces, not before. */
  #wantSurfaces(): Surfaces | undefined {
    if (typeof this.#surfaces === 'object') return this.#surfaces;
    if (this.#surfaces === 'coming') return undefined;
    this.#surfaces = 'coming';
    this.#say('The surfaces are coming …');
    const turn = (on: boolean) => this.#kit.change(this.#options.surfaces?.set(this.#kit.state, on) ?? {});
    const again = () => {
      this.#painted = undefined;
      this.#kit.redraw();
    };
    surfacesPart(this.#kit.address)
      .then(({ Surfaces }) => {
        if (!this.element.isConnected) return;
        this.#surfaces = new Surfaces(again, (words) => this.#say(words));
        this.#maps.after(this.#surfaces.controls);
        this.#say('');
        again();
      })
      .catch((error) => {
        // The maps stay, and the box says so.
        this.#surfaces = undefined;
        turn(false);
        if (error instanceof NotFetched) this.#trouble.tell(error, () => turn(true));
        else this.#say('Surfaces need WebGL 2, which this browser does not give. The maps stay.');
      });
    return undefined;
  }

  #say(text: string): void {
    this.#note.textContent = text;
    this.#note.hidden = text === '';
  }
}
