import { Chart } from '../../figures/kit/chart.ts';
import { ColorMap } from '../../figures/kit/color-map.ts';
import { ColorScale } from '../../figures/kit/color-scale.ts';
import { FieldGrid, Pace } from '../../figures/kit/field.ts';
import { FieldPanel, type Relief } from '../../figures/kit/field-panel.ts';
import { asLong } from '../../figures/kit/samples.ts';
import { type Line, pointsOn, roundRange, sectionOf, sectionSamples } from '../../figures/kit/section.ts';
import { brief } from '../../figures/kit/words.ts';
import { h, svg } from '../../ui/dom.ts';
import { lazy, NotFetched } from '../../ui/lazy.ts';
import { Trouble } from '../../ui/trouble.ts';
import type { Experiment } from './experiment.ts';
import type { Fit } from './fit.ts';
import type { Surfaces } from './surfaces.ts';
import type { Picture, PlaneActions, View } from './view.ts';

const SECTION_STEPS = 300;

const surfacesPart = lazy(() => import('./surfaces.ts'), 'The part of this page that draws surfaces');

/** Points in the plane, their interpolants as small multiples in one color scale: maps, or surfaces. */
export class PlaneView implements View {
  readonly element: HTMLElement;
  readonly named = true;
  readonly #actions: PlaneActions;
  readonly #fields = h('div', { class: 'fields', role: 'group', 'aria-label': 'Maps of the interpolants' });
  readonly #scale: ColorScale;
  readonly #sectionTitle = h('h3', { class: 'chart-title' });
  readonly #section: Chart;
  readonly #sectionPart: HTMLElement;
  readonly #note = h('p', { class: 'soft', hidden: true });
  readonly #trouble = new Trouble(this.#note, () => document.querySelector('.show-part input'));
  readonly #panels = new Map<number, FieldPanel>();
  readonly #grid = new FieldGrid();
  readonly #pace = new Pace();
  readonly #rows = new Map<number, Float64Array>();
  readonly #axis = new Float64Array(SECTION_STEPS);
  readonly #places = new Float64Array(2 * SECTION_STEPS);
  #first = 0;
  /** Whether the fields were last drawn at leisure. */
  #fine = false;
  #last: Picture | undefined;
  #surfaces: Surfaces | 'coming' | undefined;

  constructor(actions: PlaneActions) {
    this.#actions = actions;
    this.#scale = new ColorScale((value) => actions.setValue(actions.picked, value));
    this.#section = new Chart(true, () => actions.redraw());
    this.#section.element.classList.add('section-chart');
    this.#sectionPart = h('div', { class: 'chart-part', hidden: true }, this.#sectionTitle, this.#section.element);
    this.element = h('div', { class: 'plane-view' }, this.#fields, this.#note, this.#scale.element, this.#sectionPart);
  }

  handle(i: number): HTMLElement | undefined {
    return this.#panels.get(this.#first)?.handle(i);
  }

  draw(picture: Picture): void {
    this.#last = picture;
    this.#draw(picture, false);
  }

  refine(): void {
    if (this.#last && !this.#fine) this.#draw(this.#last, true);
  }

  emphasize(key: number): void {
    for (const [own, panel] of this.#panels) panel.faded = key !== 0 && key !== own;
    this.#section.emphasize(key);
  }

  #draw({ experiment, fits, outliers, anew }: Picture, resting: boolean): void {
    const { show, picked, range } = experiment;
    const seen = fits.filter(({ model, interpolant }) => model.shown && interpolant);
    this.#arrange(seen, experiment);
    const cardinal = show.cardinal && picked >= 0;
    const colors = cardinal ? new ColorMap('around-zero', -1, 1) : new ColorMap(show.colors, range[0], range[1]);
    const line = sectionOf(experiment);
    if (anew || resting) {
      this.#paint(seen, experiment, colors, cardinal, line, resting);
      this.#fine = resting;
    }
    for (const panel of this.#panels.values())
      panel.points(experiment.values, cardinal ? new ColorMap(show.colors, range[0], range[1]) : colors, outliers);

    const title = cardinal
      ? `Weight of point ${picked}`
      : picked < 0
        ? 'Value (choose a point to change its own)'
        : `Value of point ${picked}: ${brief(experiment.values[picked] ?? 0)}`;
    this.#scale.show(colors, title, picked < 0 || cardinal ? undefined : experiment.values[picked]);
    this.#drawSection(seen, line, experiment);
  }

  #paint(
    fits: readonly Fit[],
    experiment: Experiment,
    colors: ColorMap,
    cardinal: boolean,
    line: Line | undefined,
    resting: boolean,
  ): void {
    const { show, frame, picked } = experiment;
    const surfaces = show.surface ? this.#wantSurfaces() : undefined;
    this.element.toggleAttribute('data-surface', !!surfaces);
    this.element.toggleAttribute('data-flat', !!surfaces && cardinal);
    const start = performance.now();
    this.#grid.lay(frame, this.#pace.size(resting));
    const { size, queries } = this.#grid;
    for (const fit of fits) {
      const panel = this.#panels.get(fit.model.key);
      panel?.measure();
      if (!panel || panel.side === 0) continue;
      panel.name(fit.label, fit.model.slot);
      panel.stale = fit.problem !== undefined;
      panel.relief = surfaces && !cardinal ? this.#relief(surfaces, experiment) : undefined;
      panel.field.sample(fit.interpolant, queries, cardinal && !fit.problem ? picked : -1, experiment.values.length);
      if (surfaces) surfaces.paint(panel.context, panel.field.values, size, colors, experiment, cardinal);
      else panel.paint(size, colors, show.isolines, line?.ends);
    }
    if (fits.length > 0) this.#pace.took(performance.now() - start, size);
  }

  /** A panel for each interpolant, in their order. */
  #arrange(fits: readonly Fit[], experiment: Experiment): void {
    const wanted = new Set(fits.map(({ model }) => model.key));
    const first = fits[0]?.model.key ?? 0;
    for (const [key, panel] of this.#panels) {
      // Whose handles the keyboard reaches is decided when a panel is made.
      if (wanted.has(key) && !(key === first) === !(key === this.#first)) continue;
      panel.dispose();
      this.#panels.delete(key);
      this.#rows.delete(key);
    }
    this.#first = first;
    for (const { model } of fits) {
      if (this.#panels.has(model.key)) continue;
      const panel = new FieldPanel({
        slot: model.slot,
        first: model.key === first,
        frame: () => (this.#last?.experiment ?? experiment).frame,
        actions: this.#actions,
        resized: () => this.#actions.redraw(),
      });
      this.#panels.set(model.key, panel);
    }
    fits.forEach(({ model }, i) => {
      const element = this.#panels.get(model.key)?.element;
      if (element && this.#fields.children[i] !== element) this.#fields.insertBefore(element, this.#fields.children[i] ?? null);
    });
    this.#fields.dataset.count = String(fits.length);
  }

  /** Points over a surface of what is drawn last. */
  #relief(surfaces: Surfaces, experiment: Experiment): Relief {
    const present = () => this.#last?.experiment ?? experiment;
    return {
      screen: (i) => surfaces.screen(present(), i),
      value: (i, down) => surfaces.value(present(), i, down),
    };
  }

  #drawSection(fits: readonly Fit[], line: Line | undefined, experiment: Experiment): void {
    this.#sectionPart.hidden = !line;
    if (!line) return;
    this.#sectionTitle.textContent = line.title;
    sectionSamples(line, this.#places, this.#axis);
    const curves = fits.map((fit) => {
      const { key, slot } = fit.model;
      const ys = asLong(this.#rows.get(key), SECTION_STEPS);
      this.#rows.set(key, ys);
      fit.interpolant?.evaluate(this.#places, ys);
      return { key, slot, label: fit.label, xs: this.#axis, ys, stale: fit.problem !== undefined };
    });
    const [low, high] = roundRange(
      curves.map(({ ys }) => ys),
      Math.min(...experiment.values),
      Math.max(...experiment.values),
    );
    this.#section.frame = [line.along[0], line.along[1], low, high];
    this.#section.draw(curves);
    this.#section.over.replaceChildren(
      ...pointsOn(line, experiment).map(({ at, point }) =>
        svg('circle', {
          class: 'mark',
          cx: this.#section.x(at).toFixed(1),
          cy: this.#section.y(experiment.values[point] ?? 0).toFixed(1),
          r: 5,
        }),
      ),
    );
  }

  /** three.js comes when somebody asks for surfaces, not before. */
  #wantSurfaces(): Surfaces | undefined {
    if (this.#surfaces === undefined) {
      this.#surfaces = 'coming';
      this.#say('The surfaces are coming …');
      surfacesPart(this.#actions.address)
        .then(({ Surfaces }) => {
          this.#surfaces = new Surfaces(
            () => this.#actions.redraw(),
            (words) => this.#say(words),
          );
          this.#fields.after(this.#surfaces.controls);
          this.#say('');
          this.#actions.redraw();
        })
        .catch((error) => {
          // The maps stay, and the box says so.
          this.#surfaces = undefined;
          this.#actions.setShow({ surface: false });
          if (error instanceof NotFetched) this.#trouble.tell(error, () => this.#actions.setShow({ surface: true }));
          else this.#say('Surfaces need WebGL 2, which this browser does not give. The maps stay.');
        });
    }
    return typeof this.#surfaces === 'object' ? this.#surfaces : undefined;
  }

  #say(text: string): void {
    this.#note.textContent = text;
    this.#note.hidden = text === '';
  }
}
