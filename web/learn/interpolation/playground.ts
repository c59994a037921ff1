import type { HandlebodyRuntime, OutlierReport } from '../../../wasm/ts/runtime.ts';
import { computable } from '../../ui/address.ts';
import { readable } from '../../ui/dom.ts';
import { fromAddress, toAddress } from './address.ts';
import {
  addPoint,
  clamp,
  type Experiment,
  emptiestPlace,
  fitFrame,
  MOST_MODELS,
  MOST_POINTS,
  placeOf,
  removePoint,
  type Settings,
  type Show,
  setPlace,
  tidy,
} from './experiment.ts';
import { Fit } from './fit.ts';
import { dataOf, kindOf, modelOf } from './interpolants.ts';
import { outlierText, searchOutliers, summary } from './report.ts';
import type { PlaneActions, View } from './view.ts';

/** The parts of the page that show the experiment. */
interface Audience {
  /** Something has changed, and is drawn with the next frame. */
  stir(): void;
  /** Interpolants came or went, or all is new. */
  structure(playground: Playground): void;
  /** Something moved: once a frame at the most. */
  frame(playground: Playground): void;
  /** Nothing has moved for a while. */
  rest(playground: Playground, said: string): void;
}

/** Milliseconds without a change after which the page writes its address, speaks, and draws finely. */
const REST = 350;

/** The experiment and its fits: every change goes through here, and is solved and drawn with the next frame. */
export class Playground implements PlaneActions {
  readonly hb: HandlebodyRuntime;
  experiment: Experiment;
  fits: Fit[] = [];
  view: View | undefined;
  emphasis = 0;
  found: OutlierReport | undefined;
  readonly #audience: Audience;
  /** Which fits the next frame solves: all, or those of these keys. */
  #unsolved: Set<number> | 'all' = 'all';
  #frame = 0;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #restructured = true;
  #anew = true;

  constructor(hb: HandlebodyRuntime, audience: Audience) {
    this.hb = hb;
    this.#audience = audience;
    this.experiment = fromAddress('');
  }

  start(experiment: Experiment): void {
    for (const fit of this.fits) fit.dispose();
    this.emphasis = 0;
    this.experiment = experiment;
    this.fits = experiment.models.map((model) => new Fit(model, experiment.dimension));
    this.#restructured = true;
    this.#change('all');
  }

  get address(): string {
    return toAddress(this.experiment);
  }

  /** How far a curve may miss its points and still be said to pass through them. */
  get tolerance(): number {
    const { dimension, frame, range } = this.experiment;
    return 1e-6 * (dimension === 1 ? frame[3] - frame[2] : range[1] - range[0]);
  }

  get outliers(): readonly number[] {
    return this.found?.outliers ?? [];
  }

  // Points

  get count(): number {
    return this.experiment.values.length;
  }

  get picked(): number {
    return this.experiment.picked;
  }

  placeOf(i: number): readonly [number, number] {
    return placeOf(this.experiment, i);
  }

  move(i: number, across: number, up: number): void {
    setPlace(this.experiment, i, across, up);
    this.#change('all');
  }

  hold(i: number): () => void {
    const [place, value] = [this.placeOf(i), this.experiment.values[i] as number];
    return () => {
      if (i >= this.count) return;
      setPlace(this.experiment, i, ...place);
      this.experiment.values[i] = value;
      this.#change('all');
    };
  }

  raise(i: number, hundredths: number): void {
    const { range, values, dimension } = this.experiment;
    if (dimension === 2) this.setValue(i, (values[i] as number) + ((range[1] - range[0]) * hundredths) / 100);
  }

  setValue(i: number, value: number): void {
    const { range } = this.experiment;
    this.experiment.values[i] = tidy(clamp(value, range[0], range[1]), range[1] - range[0]);
    this.#change('all');
  }

  /** A number that somebody typed: taken as it is, as far as it can be computed with, and the frame makes room for it. */
  type(i: number, column: number, typed: number): void {
    const number = computable(typed);
    const { dimension, points, values, frame, range } = this.experiment;
    if (column === dimension) values[i] = number;
    else points[i * dimension + column] = number;
    const [across, up] = this.placeOf(i);
    this.experiment.frame = [
      Math.min(frame[0], across),
      Math.max(frame[1], across),
      Math.min(frame[2], up),
      Math.max(frame[3], up),
    ];
    if (dimension === 2) this.experiment.range = [Math.min(range[0], number), Math.max(range[1], number)];
    this.#change('all');
  }

  pick(i: number): void {
    if (i === this.experiment.picked) return;
    this.experiment.picked = i;
    const { cardinal, surface } = this.experiment.show;
    this.#change(new Set(), cardinal || surface);
  }

  addAt(across: number, up: number): void {
    const { dimension, frame, values } = this.experiment;
    if (values.length >= MOST_POINTS) return;
    const x = tidy(across, frame[1] - frame[0]);
    const y = tidy(up, frame[3] - frame[2]);
    this.#added(dimension === 1 ? addPoint(this.experiment, [x], y) : addPoint(this.experiment, [x, y], this.#guess([x, y])));
  }

  /** Adds a point where there are fewest. */
  add(): void {
    if (this.experiment.values.length >= MOST_POINTS) return;
    const place = emptiestPlace(this.experiment);
    this.#added(addPoint(this.experiment, place, this.#guess(place)));
  }

  remove(i: number): void {
    if (this.experiment.values.length <= 1) return;
    removePoint(this.experiment, i);
    this.#change('all');
  }

  describe(i: number): string {
    const [across, up] = this.placeOf(i);
    const { dimension, values } = this.experiment;
    const place = dimension === 1 ? `x ${readable(across)}` : `x ${readable(across)}, y ${readable(up)}`;
    return `Point ${i}, ${place}, value ${readable(values[i] ?? 0)}${this.outliers.includes(i) ? ', stands out' : ''}`;
  }

  settle(): void {
    this.#restSoon();
  }

  fitFrame(): void {
    fitFrame(this.experiment);
    this.#change('all');
  }

  // Interpolants

  addModel(id: string, settings: Settings): Fit | undefined {
    const kind = kindOf(id);
    const { models, dimension } = this.experiment;
    if (!kind || models.length >= MOST_MODELS) return undefined;
    const model = modelOf(kind, settings, models);
    models.push(model);
    const fit = new Fit(model, dimension);
    this.fits.push(fit);
    this.#restructured = true;
    this.#change(new Set([model.key]));
    return fit;
  }

  removeModel(key: number): void {
    const at = this.fits.findIndex((fit) => fit.model.key === key);
    if (at < 0) return;
    this.fits[at]?.dispose();
    this.fits.splice(at, 1);
    this.experiment.models.splice(at, 1);
    if (this.emphasis === key) this.emphasis = 0;
    this.#restructured = true;
    this.#change(new Set());
  }

  setModel(key: number, settings: Settings): void {
    const model = this.experiment.models.find((candidate) => candidate.key === key);
    if (!model) return;
    model.settings = { ...model.settings, ...settings };
    this.#change(new Set([key]));
  }

  setShown(key: number, shown: boolean): void {
    const model = this.experiment.models.find((candidate) => candidate.key === key);
    if (model) model.shown = shown;
    this.#change(new Set());
  }

  emphasize(key: number): void {
    if (this.emphasis === key) return;
    this.emphasis = key;
    this.view?.emphasize(key);
  }

  setShow(show: Partial<Show>): void {
    Object.assign(this.experiment.show, show);
    // A weight is that of a chosen point.
    if (show.cardinal && this.experiment.picked < 0) this.experiment.picked = Math.floor(this.experiment.values.length / 2);
    this.#change(new Set());
  }

  // Frames

  /** Draws with the next frame, without solving. */
  redraw(): void {
    this.#change(new Set());
  }

  #change(unsolved: Set<number> | 'all', anew = true): void {
    this.#anew ||= anew;
    this.#audience.stir();
    if (unsolved === 'all' || this.#unsolved === 'all') this.#unsolved = 'all';
    else for (const key of unsolved) this.#unsolved.add(key);
    this.#frame ||= requestAnimationFrame(() => this.#run());
    this.#restSoon();
  }

  #run(): void {
    this.#frame = 0;
    const data = dataOf(this.experiment);
    for (const fit of this.fits) if (this.#unsolved === 'all' || this.#unsolved.has(fit.model.key)) fit.solve(this.hb, data);
    this.#unsolved = new Set();
    this.found = searchOutliers(this.hb, this.experiment, this.fits);
    if (this.#restructured) this.#audience.structure(this);
    this.#restructured = false;
    const { experiment, fits, outliers } = this;
    this.view?.draw({ experiment, fits, outliers, anew: this.#anew });
    this.view?.emphasize(this.emphasis);
    this.#anew = !this.view;
    this.#audience.frame(this);
  }

  #restSoon(): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      // A slow machine has not drawn yet what is to be at rest.
      if (this.#frame !== 0) return this.#restSoon();
      this.view?.refine();
      this.#audience.rest(this, summary(this.experiment, this.fits, outlierText(this.found)));
    }, REST);
  }

  #added(i: number): void {
    this.experiment.picked = i;
    this.#change('all');
    // The handle is there after the next frame.
    requestAnimationFrame(() => this.view?.handle(i)?.focus());
  }

  /** What the first good interpolant says there. */
  #guess(place: readonly number[]): number {
    const { values, frame, dimension, range } = this.experiment;
    const value = this.fits.find(({ interpolant }) => interpolant)?.interpolant?.evaluate(place)[0] ?? Number.NaN;
    const average = values.reduce((sum, next) => sum + next, 0) / Math.max(values.length, 1);
    const [low, high] = dimension === 1 ? [frame[2], frame[3]] : range;
    return tidy(clamp(Number.isFinite(value) ? value : average, low, high), high - low);
  }
}
