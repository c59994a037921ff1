import type { Handlebody } from '../../../../wasm/ts/index.ts';
import { meshShape, type PlaneMesh } from '../../../models/mesh-shape.ts';
import type { Shape } from '../../../models/shape.ts';
import { quoted } from '../../../ui/address.ts';
import { ease, reducedMotion } from '../../../ui/motion.ts';
import { PageError } from '../../../ui/page-error.ts';
import { type Channel, type StateOf, unsaid } from '../../kit/channel.ts';
import type { Wait } from '../../kit/figure.ts';
import { outline } from '../../kit/outline.ts';
import { spread } from '../../kit/placing.ts';
import { type Handle, pickedHandle, planeHandles, resting, restsOf, struck } from '../../kit/plane-handles.ts';
import type { PaintedShape } from '../../kit/shape-picture.ts';
import { Deformer } from './deformer.ts';
import { paintOwn } from './icing.ts';
import { type Method, type MethodId, methodOf, weightsOf } from './methods.ts';
import { SHAPES, type ShapeName, shapeOf } from './shapes.ts';

/** About how many vertices. */
export const VERTICES = { low: 200, initial: 2250, high: 8000 } as const;

const shape: Channel<ShapeName> = {
  initial: 'man',
  // An outline of one's own says by itself that it is shown instead.
  read: (text, _, { o }) => (text === 'own' && o ? 'man' : SHAPES.find(({ id }) => id === text)?.id),
  write: String,
};
const method: Channel<MethodId> = { initial: 'linear-bounded', read: (text) => methodOf(text)?.id, write: String };
const vertices: Channel<number> = {
  initial: VERTICES.initial,
  read: (text) => {
    const number = text === '' ? Number.NaN : Number(text);
    return number >= VERTICES.low && number <= VERTICES.high ? Math.round(number) : undefined;
  },
  write: String,
};
/** Weight of the picked handle as colors and isolines, instead of the picture; the triangles. */
const show: Channel<{ readonly weight: boolean; readonly mesh: boolean }> = {
  initial: { weight: false, mesh: false },
  read: (text, left) => {
    const words = text.split(',');
    left.push(...words.filter((word) => !['', 'weight', 'mesh'].includes(word)).map(quoted));
    return { weight: words.includes('weight'), mesh: words.includes('mesh') };
  },
  write: (shown) => (['weight', 'mesh'] as const).filter((name) => shown[name]).join(','),
};

/** Called as addresses always called them. */
export const parameters = {
  /** An outline of one's own, and the picture that it was taken from. */
  o: outline,
  shape,
  painted: unsaid<PaintedShape | undefined>(undefined),
  m: method,
  h: planeHandles('auto'),
  v: vertices,
  pick: pickedHandle(-1),
  show,
  /** Whether an outline of one's own is being drawn. */
  draw: unsaid(false),
};
export type State = StateOf<typeof parameters>;

/** Milliseconds that a pose takes to be struck. */
const DURATION = 700;
/** Frames for which iterations go on after the last change. */
const MOST_ROUNDS = 60;

/** A shape, its mesh, and what bends it. */
export class Bent {
  readonly outline: Shape;
  readonly mesh: PlaneMesh;
  readonly painted: PaintedShape;
  /** Where the vertices are now: n×2. */
  readonly positions: Float32Array;
  deformer: Deformer | undefined;
  /** Handles as they are drawn, on their way to a pose. */
  shown: readonly Handle[];
  /** The handles that the shape brings. */
  readonly #auto: readonly Handle[];
  readonly #good: Float32Array;
  readonly #of: Pick<State, 'shape' | 'o' | 'v'>;
  #way: { readonly from: readonly Handle[]; readonly start: number } | undefined;
  #target: readonly Handle[] | undefined;
  #rests: string | undefined;
  #method: MethodId | undefined;
  #hasFailed = false;
  /** Frames since something changed. */
  #rounds = 0;

  /** Throws on an outline that is none. Where `before` is the same shape in another mesh, its handles are where they were. */
  constructor({ shape, o, v, painted, h }: State, before?: Bent) {
    const known = shapeOf(shape);
    this.#of = { shape, o, v };
    this.outline = o ?? known.outline();
    this.mesh = meshShape(this.outline, { vertices: v });
    this.painted = painted ?? (o ? paintOwn : known.paint)(this.outline);
    this.positions = Float32Array.from(this.mesh.positions);
    this.#good = this.positions.slice();
    this.#auto = o ? spread(this.mesh, 4) : (known.poses[0]?.handles() ?? []);
    const same = before && before.#of.o === o && before.#of.shape === shape;
    if (same) this.#target = before.#target;
    this.shown = same ? before.shown : (h === 'auto' ? this.#auto : h).map(resting);
  }

  isOf({ shape, o, v }: State): boolean {
    return this.#of.shape === shape && this.#of.o === o && this.#of.v === v;
  }

  start(hb: Handlebody): Deformer {
    this.deformer ??= new Deformer(hb, this.mesh);
    return this.deformer;
  }

  handles({ h }: State): readonly Handle[] {
    return h === 'auto' ? this.#auto : h;
  }

  /** Brings the shape a frame nearer to what the state says; whether there is more to do. The last good places stay. */
  move(state: State, wait: Wait): boolean {
    const { deformer, positions } = this;
    if (!deformer) return false;
    const [handles, to] = [this.handles(state), methodOf(state.m) as Method];
    this.#aim(handles, state.h === 'auto' || struck.has(handles), deformer);
    if (state.m !== this.#method) this.#rounds = 0;
    this.#method = state.m;
    const part = this.#way ? (performance.now() - this.#way.start) / DURATION : 1;
    if (part >= 1) this.#way = undefined;
    this.shown = this.#way ? between(this.#way.from, handles, ease(part)) : handles;
    let isUnfinished = false;
    try {
      isUnfinished = deformer.deform(to, this.shown, positions);
      if (!positions.every(Number.isFinite)) throw notFinite();
      this.#good.set(positions);
      this.#hasFailed = false;
    } catch (error) {
      positions.set(this.#good);
      [this.#hasFailed, this.#way, this.shown] = [true, undefined, handles];
      throw error;
    }
    this.#bound(deformer, to, wait);
    return this.#way !== undefined || (isUnfinished && this.#rounds++ < MOST_ROUNDS);
  }

  /** The weights under the method in use. */
  weights(state: State): Float64Array | undefined {
    const kind = weightsOf(methodOf(state.m) as Method);
    if (!kind || this.#hasFailed || this.handles(state).length === 0) return undefined;
    return this.deformer?.weights(kind).weights;
  }

  dispose(): void {
    this.deformer?.dispose();
  }

  #aim(handles: readonly Handle[], isPose: boolean, deformer: Deformer): void {
    if (handles !== this.#target) {
      const same = restsOf(handles) === restsOf(this.shown);
      const inMotion = (isPose || !this.#target) && !reducedMotion();
      this.#way = inMotion ? { from: same ? this.shown : handles.map(resting), start: performance.now() } : undefined;
      this.#target = handles;
      this.#rounds = 0;
    }
    if (restsOf(handles) === this.#rests) return;
    this.#rests = restsOf(handles);
    deformer.setHandles(handles);
  }

  /** Bounds the bounded weights, if that is still to do, for whoever asks for them next. */
  #bound(deformer: Deformer, { kind }: Method, wait: Wait): void {
    try {
      if (!deformer.isUnbounded) return;
    } catch {
      // The method itself says why when it is chosen.
      return;
    }
    wait('Bounding the weights…', (progress) => deformer.finishBounded(kind === 'bounded' ? progress : () => {}));
  }
}

function between(from: readonly Handle[], to: readonly Handle[], part: number): readonly Handle[] {
  const mixed = (a: number, b: number) => a + (b - a) * part;
  return to.map((handle, i) => {
    const { move, turn } = from[i] ?? handle;
    return {
      ...handle,
      move: [mixed(move[0], handle.move[0]), mixed(move[1], handle.move[1])] as const,
      turn: mixed(turn, handle.turn),
    };
  });
}

function notFinite(): PageError {
  return new PageError(
    'target-not-finite',
    'The deformed shape has places that are no numbers.',
    'Take the last handle back with Esc, or strike a pose.',
  );
}
