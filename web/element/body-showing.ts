import type { BodyData } from '../../wasm/ts/runtime.ts';
import type { Mesh } from '../../wasm/ts/types.ts';
import { Draggable, type DraggableMaking } from '../three/draggable.ts';
import { fetchMaking } from '../three/fetch-making.ts';
import { BareHandles } from '../three/handles.ts';
import { LiveGeometry } from '../three/live-geometry.ts';
import { readObject } from '../three/read-object.ts';
import type { Progress } from '../ui/progress.ts';
import type { AskedHandle } from './handles-text.ts';
import type { ModelOptions, ModelShowing } from './model-element.ts';
import { runtime } from './runtime.ts';
import { type SharedModel, shareModel } from './shared-model.ts';
import { type CameraState, ViewFrame } from './view-frame.ts';
import type { Views } from './views-text.ts';

type Place = readonly [x: number, y: number, z: number];

/** A handle was moved: the detail of the event "change". */
export interface HandleChange {
  readonly index: number;
  readonly name: string;
  /** Where it is to go, in the model's own units. */
  readonly to: readonly [x: number, y: number, z: number];
}

/** All that is kept of a body that is given back. */
export interface BodyState {
  readonly handles: readonly AskedHandle[];
  readonly targets: readonly Place[];
  readonly camera: CameraState;
}

interface BodyOptions extends ModelOptions {
  readonly handles: readonly AskedHandle[] | undefined;
  readonly state: BodyState | undefined;
  readonly onChange: (change: HandleChange) => void;
  readonly onGood: () => void;
}

const VIEW = { azimuth: 40, elevation: 14 };

/** Fetches a model, shows it, bakes it where it is not baked, and lets it be dragged. Throws what is to be told; nothing is left behind then. */
export async function showBody(options: BodyOptions): Promise<BodyShowing> {
  const { src, signal, progress } = options;
  const tell = (part: number | undefined) => {
    progress.set(part);
    options.onPart(part);
  };
  progress.begin('Loading the model…');
  const model = await shareModel(src, signal, tell);
  let showing: BodyShowing | undefined;
  try {
    showing = new BodyShowing(model, options);
    // The first picture waits for nothing else.
    options.onFirst();
    const { object } = model;
    const body = model.body ?? (await bake((await readObject(object)).mesh, progress, signal, tell));
    const reading = body.mesh.reading ?? {};
    const [hb, making, read] = await Promise.all([runtime(), fetchMaking(object), readObject(object, { reading })]);
    signal.throwIfAborted();
    showing.bring(hb, body, {
      makeGeometry: (parts) => new LiveGeometry(parts, making),
      read: () => read,
    });
    return showing;
  } catch (error) {
    showing?.dispose();
    model.release();
    throw error;
  }
}

async function bake(mesh: Mesh, progress: Progress, signal: AbortSignal, onProgress: (part: number) => void): Promise<BodyData> {
  progress.begin('Finding the inside of the model…');
  const { bakeInWorker } = await import('../worker/bake-in-worker.ts');
  try {
    return await bakeInWorker(mesh, { signal, onProgress });
  } catch (error) {
    // A sheet has no inside to measure in; distances through the air serve it.
    if ((error as { code?: unknown }).code !== 'mesh-no-interior') throw error;
    return bakeInWorker(mesh, { signal, onProgress, distance: 'euclidean' });
  }
}

/** A model on the page, in a view of its own. */
export class BodyShowing implements ModelShowing {
  readonly #options: BodyOptions;
  readonly #model: SharedModel;
  readonly #frame: ViewFrame;
  #drag: Draggable | undefined;
  readonly #step = () => this.#advance();

  constructor(model: SharedModel, options: BodyOptions) {
    [this.#model, this.#options] = [model, options];
    this.#frame = new ViewFrame(options.stage, options);
    this.#frame.view.onDrawn = () => this.#drag?.place();
    this.#frame.view.show(model.object);
    this.look(options.camera);
    if (options.state) this.#frame.recall(options.state.camera);
  }

  /** What is not seen draws nothing. */
  see(seen: boolean): void {
    this.#frame.view.sleep(!seen);
  }

  set alt(words: string) {
    this.#frame.alt = words;
  }

  set controls(shown: boolean) {
    this.#frame.controls = shown;
  }

  set views(views: Views) {
    this.#frame.views = views;
  }

  get handles(): readonly AskedHandle[] {
    return this.#drag?.handles ?? this.#options.state?.handles ?? this.#options.handles ?? [];
  }

  get state(): BodyState {
    const drag = this.#drag;
    const targets = drag ? drag.handles.map((_, i) => drag.target(i).toArray() as Place) : [];
    return { handles: this.handles, targets, camera: this.#frame.camera };
  }

  /** From where it is seen: azimuth and height, degrees. */
  look(angles: readonly number[]): void {
    this.#frame.look(this.#model.object, angles, VIEW, true);
  }

  /** The body has come: from now on it can be dragged. */
  bring(hb: Awaited<ReturnType<typeof runtime>>, body: BodyData, making: Pick<DraggableMaking, 'makeGeometry' | 'read'>): void {
    const { state, handles, onError } = this.#options;
    const asked = state?.handles ?? handles;
    const drag = new Draggable(this.#model.object, body, {
      hb,
      // The element's own style sheet is their style.
      makeOverlay: (overlay) => new BareHandles(overlay),
      ...making,
      camera: this.#frame.view.camera,
      container: this.#frame.overlay,
      onWake: () => this.#frame.view.animate(this.#step),
      onMove: (i) => this.#moved(i),
      onSelect: () => this.#frame.view.invalidate(),
      onError,
      ...(asked && { handles: asked }),
    });
    this.#drag = drag;
    this.#name(drag);
    if (state) this.move(state.targets);
    this.#frame.view.animate(this.#step);
  }

  /** Other handles, at rest. Throws what the solver throws, and the former ones stay. */
  hold(handles: readonly AskedHandle[]): void {
    this.#drag?.setHandles(handles);
    if (this.#drag) this.#name(this.#drag);
  }

  move(targets: readonly Place[]): void {
    const drag = this.#drag;
    if (!drag) return;
    for (const [i, place] of targets.entries()) if (i < drag.handles.length) drag.setTarget(i, drag.target(i).set(...place));
  }

  reset(): void {
    this.#drag?.reset();
  }

  vertex(v: number): Place | undefined {
    return this.#drag?.vertex(v).toArray();
  }

  dispose(): void {
    this.#drag?.dispose();
    this.#frame.dispose();
    this.#model.release();
  }

  /** Tells style sheets and those who do not see them what the handles are. */
  #name({ handles, overlay }: Draggable): void {
    for (let i = 0; i < handles.length; i++) overlay.element(i)?.setAttribute('part', 'handle');
    this.#frame.parts = `Handles: ${handles.map(({ name }, i) => name ?? `Handle ${i + 1}`).join(', ')}.`;
  }

  #advance(): boolean {
    const goesOn = this.#drag?.advance() ?? false;
    this.#frame.view.changed();
    return goesOn;
  }

  #moved(i: number): void {
    const drag = this.#drag;
    if (!drag) return;
    this.#options.onGood();
    const name = drag.handles[i]?.name ?? `Handle ${i + 1}`;
    const to = drag.target(i).toArray() as Place;
    this.#options.onChange({ index: i, name, to });
    this.#frame.say(() => `${name}: ${drag.overlay.description(i)}.`);
  }
}
