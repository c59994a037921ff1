import { HandlebodyError } from '../../../wasm/ts/errors.ts';
import type { Handlebody } from '../../../wasm/ts/index.ts';
import { countFlips, meshShape, type PlaneMesh } from '../../models/mesh-shape.ts';
import type { Shape } from '../../models/shape.ts';
import { leftOut } from '../../ui/address.ts';
import { readable } from '../../ui/dom.ts';
import { explain } from '../../ui/explain.ts';
import { reducedMotion } from '../../ui/motion.ts';
import { PageError } from '../../ui/page-error.ts';
import { fromAddress, initial, toAddress } from './address.ts';
import { Deformer } from './deformer.ts';
import { Ease } from './ease.ts';
import {
  copyOf,
  type Experiment,
  type Handle,
  MOST_HANDLES,
  type Place,
  placeOf,
  point,
  resting,
  tidy,
  wrap,
} from './experiment.ts';
import { type PaintedShape, paintOwn } from './icing.ts';
import { type Method, type MethodId, methodOf, weightsOf } from './methods.ts';
import type { Picture } from './picture.ts';
import { boneIn, emptiest, restOf, spread } from './placing.ts';
import { shapeOf } from './shapes.ts';
import { drawTiles, type Tile } from './tiles.ts';

/** The parts of the page that show the experiment. */
interface Audience {
  /** Another shape or mesh. */
  mesh(): void;
  /** Handles came or went, another method: what is listed may have changed. */
  structure(): void;
  /** Drawn anew: once a frame at the most. */
  frame(): void;
  /** Something takes a while (a sentence, and how much of it is done) or has ended. */
  busy(said: string | undefined, part?: number): void;
  trouble(error: unknown): void;
  /** Nothing has moved for a while. */
  rest(): void;
}

/** Milliseconds without a change after which the page writes its address and speaks. */
const REST = 350;
/** Milliseconds of work that nobody needs to hear of. */
const PATIENCE = 400;
/** Frames for which iterations go on after the last change. */
const MOST_ROUNDS = 60;

/** The shape, its handles and their pose: every change goes through here, and is solved and drawn with the next frame. */
export class Lesson {
  readonly picture: Picture;
  experiment: Experiment;
  mesh: PlaneMesh;
  deformer: Deformer | undefined;
  /** The outline that the mesh was made of. */
  outline: Shape;
  /** Milliseconds that the last frame's deformation took. */
  took = 0;
  readonly #audience: Audience;
  #hb: Handlebody | undefined;
  /** The painting of an own shape that came with a picture. */
  #painting: PaintedShape | undefined;
  #frame = 0;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #ease: Ease | undefined;
  #good: Float32Array;
  #failed: string | undefined;
  /** Frames since something changed. */
  #rounds = 0;

  constructor(picture: Picture, audience: Audience) {
    this.picture = picture;
    this.#audience = audience;
    const { experiment, built, said } = this.#read(location.hash);
    this.experiment = experiment;
    [this.outline, this.mesh] = [built.outline, built.mesh];
    this.#good = Float32Array.from(this.mesh.positions);
    this.#show();
    if (said) audience.trouble(said);
  }

  /** The solver has come: poses can be struck. */
  connect(hb: Handlebody): void {
    this.#hb = hb;
    this.deformer = new Deformer(hb, this.mesh);
    this.deformer.setHandles(this.experiment.handles);
    this.#easeFrom(this.experiment.handles.map(resting));
    this.#audience.structure();
    this.#change();
  }

  get method(): Method {
    return methodOf(this.experiment.method) as Method;
  }

  get handles(): readonly Handle[] {
    return this.experiment.handles;
  }

  get picked(): number {
    return this.experiment.picked;
  }

  get address(): string {
    return toAddress(this.experiment);
  }

  // Shapes

  /** Shows what an address says, as far as it can be shown; the gingerbread man stands in for an outline that is none. */
  open(hash: string): void {
    if (hash.replace(/^#/, '') === this.address) return;
    const { experiment, built, said } = this.#read(hash);
    this.#start(experiment, built, undefined);
    if (said) this.#audience.trouble(said);
  }

  #read(hash: string): { experiment: Experiment; built: Built; said: PageError | undefined } {
    const left: string[] = [];
    const read = fromAddress(hash, left);
    try {
      const built = build(read);
      if (read.shape === 'own' && !/[#&]h=/.test(hash)) read.handles = spread(built.mesh, 4);
      return { experiment: read, built, said: leftOut(left) };
    } catch (error) {
      const { method, vertices, show } = read;
      const experiment = { ...initial(), method, vertices, show };
      return { experiment, built: build(experiment), said: standIn(error) };
    }
  }

  /** Another shape, with handles of its own where it brings none. On an outline that is none the page stays as it was. */
  start(experiment: Experiment, painting?: PaintedShape): boolean {
    try {
      const built = build(experiment);
      if (experiment.handles.length === 0 && experiment.shape === 'own') experiment.handles = spread(built.mesh, 4);
      this.#start(experiment, built, painting);
      return true;
    } catch (error) {
      this.#audience.trouble(error);
      return false;
    }
  }

  #start(experiment: Experiment, { outline, mesh }: Built, painting: PaintedShape | undefined): void {
    this.#painting = painting;
    this.experiment = experiment;
    [this.outline, this.mesh] = [outline, mesh];
    this.#failed = undefined;
    this.#good = Float32Array.from(this.mesh.positions);
    this.#show();
    this.deformer?.dispose();
    this.deformer = this.#hb && new Deformer(this.#hb, this.mesh);
    this.deformer?.setHandles(experiment.handles);
    this.#easeFrom(experiment.handles.map(resting));
    this.#audience.trouble(undefined);
    this.#audience.mesh();
    this.#audience.structure();
    this.#change();
  }

  /** Says whether there is such a mesh. */
  setVertices(vertices: number): boolean {
    const made = this.start({ ...this.experiment, vertices }, this.#painting);
    if (made) this.#ease = undefined;
    return made;
  }

  #show(): void {
    const painted = this.#painting ?? (shapeOf(this.experiment.shape)?.paint ?? paintOwn)(this.outline);
    this.picture.setMesh(this.mesh, painted);
  }

  // Handles

  pick(i: number): void {
    if (i === this.experiment.picked) return;
    this.experiment.picked = i;
    this.#audience.structure();
    this.#change();
  }

  move(i: number, x: number, y: number): void {
    const handle = this.experiment.handles[i];
    if (!handle || !Number.isFinite(x) || !Number.isFinite(y)) return;
    handle.move = [tidy(x - handle.rest[0]), tidy(y - handle.rest[1])];
    this.#moved();
  }

  turn(i: number, degrees: number): void {
    const handle = this.experiment.handles[i];
    if (!handle || !Number.isFinite(degrees)) return;
    handle.turn = Math.round(wrap(degrees) * 10) / 10;
    this.#moved();
  }

  /** What puts handle `i` back to where it is now. */
  hold(i: number): () => void {
    const held = this.experiment.handles[i];
    if (!held) return () => {};
    const { move, turn } = held;
    return () => {
      const handle = this.experiment.handles[i];
      // It may be another one by now, of another shape.
      if (handle !== held) return;
      [handle.move, handle.turn] = [move, turn];
      this.#moved();
    };
  }

  /** Puts the handle back to where it is at rest. */
  relax(i: number): void {
    const handle = this.experiment.handles[i];
    if (!handle) return;
    [handle.move, handle.turn] = [[0, 0], 0];
    this.#moved();
  }

  /** Takes the handle elsewhere at rest; its pose stays relative to that. */
  sit(i: number, rest: Place, end: Place | undefined): void {
    const old = this.experiment.handles[i];
    if (!old) return;
    const handle: Handle = { rest, ...(end ? { end } : {}), move: old.move, turn: old.turn };
    this.#restructure(
      this.experiment.handles.map((other, k) => (k === i ? handle : other)),
      i,
    );
  }

  /** A handle where the shape is now drawn at a place; none where there is nothing. */
  addAt(place: Place): boolean {
    const rest = restOf(this.mesh, this.picture.positions, place);
    if (!rest || this.handles.length >= MOST_HANDLES) return false;
    const handle = point(tidy(rest[0]), tidy(rest[1]));
    handle.move = [tidy(place[0] - rest[0]), tidy(place[1] - rest[1])];
    return this.#restructure([...this.handles, handle], this.handles.length);
  }

  addPoint(): boolean {
    if (this.handles.length >= MOST_HANDLES) return false;
    return this.#restructure([...this.handles, point(...emptiest(this.mesh, this.handles))], this.handles.length);
  }

  addBone(): boolean {
    const bone = this.handles.length < MOST_HANDLES && boneIn(this.outline, emptiest(this.mesh, this.handles));
    return bone ? this.#restructure([...this.handles, bone], this.handles.length) : false;
  }

  remove(i: number): void {
    if (!this.handles[i]) return;
    this.#restructure(
      this.handles.filter((_, k) => k !== i),
      Math.min(i, this.handles.length - 2),
    );
  }

  /** Strikes a pose, or the rest pose with none. */
  strike(handles: Handle[], method?: MethodId): void {
    const from = this.handles.map(copyOf);
    const same =
      handles.length === from.length &&
      handles.every((handle, i) => `${handle.rest} ${handle.end}` === `${from[i]?.rest} ${from[i]?.end}`);
    if (method) this.experiment.method = method;
    if (!same) this.#restructure(handles, Math.min(this.picked, handles.length - 1));
    else this.experiment.handles = handles;
    this.#easeFrom(same ? from : handles.map(resting));
    this.#audience.structure();
    this.#change();
  }

  rest(): void {
    this.strike(this.handles.map(resting));
  }

  setMethod(method: MethodId): void {
    this.experiment.method = method;
    this.#audience.structure();
    this.#change();
  }

  setShow(show: Partial<Experiment['show']>): void {
    Object.assign(this.experiment.show, show);
    if (show.weight && this.picked < 0) this.experiment.picked = 0;
    this.#audience.structure();
    this.#change();
  }

  describe(i: number): string {
    const handle = this.handles[i] as Handle;
    const [x, y] = placeOf(handle);
    return `${handle.end ? 'Bone' : 'Handle'} ${i}, x ${readable(x)}, y ${readable(y)}, turned ${readable(handle.turn, 0)}°`;
  }

  /** How many triangles are turned over as the shape is drawn. */
  get flips(): number {
    return countFlips(this.picture.positions, this.mesh.triangles);
  }

  /** Handles as they are drawn, on their way to a pose. */
  get shown(): readonly Handle[] {
    return this.#ease?.at(this.experiment.handles) ?? this.experiment.handles;
  }

  // Frames

  redraw(): void {
    this.#change();
  }

  /** Draws methods' answers to the pose into small pictures; the large one is drawn again after them. */
  drawTiles(next: () => Tile | undefined): void {
    if (!this.deformer) return;
    drawTiles(this.picture, this.deformer, this.experiment.handles, next);
    this.repaint();
  }

  /** Draws the shape as it is, at once. */
  repaint(): void {
    const { show, picked } = this.experiment;
    const kind = weightsOf(this.method);
    let weights: Float64Array | undefined;
    if (show.weight && kind && this.deformer && this.handles.length > 0 && !this.#failed)
      weights = this.deformer.weights(kind).weights;
    this.picture.setWeight(weights, Math.max(picked, 0), this.handles.length);
    this.picture.showLines(show.mesh);
    this.picture.render();
  }

  #moved(): void {
    this.#ease = undefined;
    this.#change();
  }

  #restructure(handles: Handle[], picked: number): boolean {
    this.#ease = undefined;
    this.experiment.handles = handles;
    this.experiment.picked = picked;
    this.deformer?.setHandles(handles);
    this.#audience.structure();
    this.#change();
    return true;
  }

  #easeFrom(from: Handle[]): void {
    this.#ease = reducedMotion() ? undefined : new Ease(from);
  }

  #change(): void {
    this.#rounds = 0;
    this.#next();
  }

  #next(): void {
    this.#frame ||= requestAnimationFrame(() => this.#run());
    this.#restSoon();
  }

  #run(): void {
    this.#frame = 0;
    this.#draw();
    if (this.method.kind === 'bounded') void this.finishBounded();
  }

  /** Bounds the bounded weights, if that is still to do; the page hears of it when it takes a while. */
  async finishBounded(): Promise<void> {
    const { deformer } = this;
    if (!deformer || deformer.isFinishing) return;
    const begun = performance.now();
    try {
      const changed = await deformer.finishBounded((part) => {
        if (this.method.kind === 'bounded' && performance.now() - begun > PATIENCE)
          this.#audience.busy('Bounding the weights …', part);
      });
      this.#audience.busy(undefined);
      if (deformer !== this.deformer) return;
      if (changed) this.#change();
    } catch (error) {
      this.#audience.busy(undefined);
      if (deformer === this.deformer && this.method.kind === 'bounded') this.#audience.trouble(error);
      this.#change();
    }
  }

  #draw(): void {
    const begun = performance.now();
    if (this.#ease?.isOver) this.#ease = undefined;
    const { positions } = this.picture;
    let unfinished = false;
    try {
      unfinished = this.deformer?.deform(this.method, this.shown, positions) ?? false;
      if (positions.some((value) => !Number.isFinite(value))) throw notFinite();
      this.#good.set(positions);
      if (this.#failed) this.#audience.trouble(undefined);
      this.#failed = undefined;
    } catch (error) {
      // The last good picture stays.
      positions.set(this.#good);
      const said = String(error);
      if (said !== this.#failed) this.#audience.trouble(error);
      this.#failed = said;
    }
    this.took = performance.now() - begun;
    this.picture.moved();
    this.repaint();
    this.#audience.frame();
    // Iterations go on for a while when the handles stand still.
    if (this.#ease || (unfinished && this.#rounds++ < MOST_ROUNDS)) this.#next();
  }

  #restSoon(): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      if (this.#frame !== 0) return this.#restSoon();
      this.#audience.rest();
    }, REST);
  }
}

interface Built {
  readonly outline: Shape;
  readonly mesh: PlaneMesh;
}

/** Throws on an outline that is none. */
function build({ shape, outline: own, vertices }: Experiment): Built {
  const outline = shapeOf(shape)?.outline() ?? own ?? [];
  return { outline, mesh: meshShape(outline, { vertices }) };
}

function standIn(error: unknown): PageError {
  return new PageError(
    'link-not-whole',
    `The outline in this link cannot be shown, and the gingerbread man stands in for it: ${explain(error).message}`,
    'Check that the link was copied whole, or draw the outline again.',
  );
}

function notFinite(): HandlebodyError {
  return new HandlebodyError('target-not-finite', {
    message: 'The deformed shape has places that are no numbers.',
    remedy: 'Take the last handle back with Esc, or strike a pose.',
  });
}
