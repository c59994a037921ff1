import type { BakeWarning, BodyData, HandlebodyRuntime } from '../../wasm/ts/runtime.ts';
import type { SceneWarning } from '../assets/scene-choices.ts';
import type { View } from '../stage/view.ts';
import { fetchMaking } from '../three/fetch-making.ts';
import { fetchModel } from '../three/fetch-model.ts';
import { LiveBody } from '../three/live-body.ts';
import { LiveGeometry } from '../three/live-geometry.ts';
import { type LoadedModel, loadModel } from '../three/load-model.ts';
import { readObject } from '../three/read-object.ts';
import { byId } from '../ui/dom.ts';
import { isAbort, type Messages } from '../ui/messages.ts';
import { PageError } from '../ui/page-error.ts';
import type { Progress } from '../ui/progress.ts';
import { tellOf } from '../ui/solver-end.ts';
import type { Address } from './address.ts';
import { besideIt } from './beside.ts';
import { BodyScene } from './body-scene.ts';
import type { ModelSwitch } from './model-switch.ts';
import { type ModelEntry, modelOf } from './models.ts';
import { Placing } from './placing.ts';
import { Readout } from './readout.ts';
import type { StudioScene } from './scene.ts';

const OWN = 'own';
const OWN_VIEW = { azimuth: 35, elevation: 14 };
const OWN_HANDLES = 6;
/** Voxels along the longest side: a compact body fills most of its box, and 96 would take it a quarter of a minute. */
const OWN_RESOLUTION = 64;

interface StudioParts {
  readonly view: View;
  /** Another one where the last has ended. */
  readonly solver: () => Promise<HandlebodyRuntime>;
  readonly messages: Messages;
  readonly progress: Progress;
  readonly note: (words: string) => void;
  readonly address: Address;
}

/** Brings models onto the stage one at a time; the former one stays until the next is ready, and for good when that fails. */
export class Studio {
  readonly #parts: StudioParts;
  readonly #root = byId('studio');
  readonly #warn = ({ code, message, remedy }: BakeWarning | SceneWarning) =>
    void this.#warnings.push(new PageError(code, message, remedy));
  readonly #placing: Placing;
  readonly #readout = new Readout(byId('readout'));
  #switch: ModelSwitch | undefined;
  #scene: StudioScene | undefined;
  #shown = '';
  #work: AbortController | undefined;
  #ownFiles: readonly File[] = [];
  /** Of the bake that made the present scene. */
  readonly #warnings: PageError[] = [];

  constructor(parts: StudioParts) {
    this.#parts = parts;
    parts.view.onDrawn = () => this.#scene?.drawn();
    this.#placing = new Placing(parts.note, (x, y) => this.#body?.addAt(x, y) ?? false);
  }

  set modelSwitch(value: ModelSwitch) {
    this.#switch = value;
  }

  /** Loads one of the studio's models, or the own one again. */
  async choose(id: string): Promise<void> {
    if (id === this.#shown) {
      this.#work?.abort();
      // The same model, another look at it.
      this.#body?.lookInside();
      return;
    }
    if (id === OWN) {
      if (this.#ownFiles.length > 0) await this.open(this.#ownFiles);
      return;
    }
    const entry = modelOf(id);
    if (!entry) return;
    await this.#bring(id, undefined, async (signal) => {
      const { progress } = this.#parts;
      progress.begin(`Loading ${entry.label}…`);
      const buffer = await fetchModel(new URL(`../models/${entry.file}`, document.baseURI), signal, (part) => progress.set(part));
      return this.#stage(await loadModel(buffer), entry.label, signal, entry);
    });
  }

  /** Takes files of the user's: a model to show, with what it names, or handles for what is shown. */
  async open(files: readonly File[]): Promise<void> {
    const file = files.find(({ name }) => /\.gl(b|tf)$/i.test(name)) ?? files[0];
    if (!file) return;
    if (/\.json$/i.test(file.name)) return this.#takeHandles(file);
    const name = file.name.replace(/\.[^.]*$/, '') || 'Your model';
    await this.#bring(OWN, name, async (signal) => {
      this.#parts.progress.begin(`Reading ${file.name}…`, () => this.#work?.abort());
      const model = await loadModel(await file.arrayBuffer(), { resource: (uri) => besideIt(uri, file, files) });
      const scene = await this.#stage(model, name, signal);
      this.#ownFiles = files;
      return scene;
    });
  }

  reset(): void {
    this.#scene?.reset();
  }

  get #body(): BodyScene | undefined {
    return this.#scene instanceof BodyScene ? this.#scene : undefined;
  }

  /** Runs what makes a scene and swaps it in. */
  async #bring(id: string, label: string | undefined, make: (signal: AbortSignal) => Promise<StudioScene>): Promise<void> {
    this.#work?.abort();
    const work = new AbortController();
    this.#work = work;
    this.#placing.end();
    this.#warnings.length = 0;
    const { messages, progress } = this.#parts;
    try {
      const scene = await make(work.signal);
      if (work.signal.aborted) {
        scene.dispose();
        throw work.signal.reason;
      }
      messages.clear();
      this.#swap(scene, id);
      const [warning] = this.#warnings;
      if (warning) messages.show(warning);
      this.#switch?.show(id, label);
    } catch (error) {
      if (work.signal.aborted && this.#work !== work) return;
      if (!isAbort(error)) this.#fail(error, () => this.#bring(id, label, make));
      if (this.#shown) this.#switch?.show(this.#shown);
      else this.#switch?.clear();
    } finally {
      if (this.#work === work) {
        this.#work = undefined;
        progress.end();
      }
    }
  }

  #fail(error: unknown, again: () => Promise<void>): void {
    const { messages } = this.#parts;
    const code = (error as { code?: unknown }).code;
    if (code === 'wasm-unavailable') {
      this.#root.dataset.state = 'failed';
      messages.showInstead(error);
    } else {
      if (!this.#shown) this.#root.dataset.state = 'empty';
      this.#tell(error, again);
    }
  }

  /** Where the solver has ended, `restore` makes what it made again; that is the present scene. */
  #tell(error: unknown, restore = async () => this.#scene?.renew(await this.#parts.solver())): void {
    tellOf(error, (told, again) => this.#parts.messages.show(told, again), restore);
  }

  #swap(scene: StudioScene, id: string): void {
    this.#scene?.dispose();
    this.#scene = scene;
    this.#shown = id;
    const { view } = this.#parts;
    view.show(scene.object);
    this.#body?.lookInside();
    byId('panel').replaceChildren(scene.panel);
    this.#root.dataset.model = id;
    this.#root.dataset.kind = scene.kind;
    this.#root.dataset.state = 'ready';
  }

  async #stage(model: LoadedModel, title: string, signal: AbortSignal, entry?: ModelEntry): Promise<StudioScene> {
    const { view, solver, messages } = this.#parts;
    const angles = entry?.view ?? OWN_VIEW;
    if (!this.#shown && entry) {
      // The first picture does not wait for the solver.
      view.show(model.object);
      view.frame(model.object, angles, !model.space);
    }
    const common = { view, object: model.object, title, onError: (e: unknown) => this.#tell(e), onGood: () => messages.clear() };
    const scene = model.space
      ? new (await import('./pose-scene.ts')).PoseScene({ ...common, solver: await solver(), space: model.space })
      : await this.#stageBody(model, common, signal, entry);
    if (!signal.aborted && (this.#shown || !entry)) view.frame(scene.object, angles, scene.grounded);
    return scene;
  }

  async #stageBody(
    model: LoadedModel,
    common: Pick<ConstructorParameters<typeof BodyScene>[0], 'view' | 'object' | 'title' | 'onError' | 'onGood'>,
    signal: AbortSignal,
    entry: ModelEntry | undefined,
  ): Promise<BodyScene> {
    const reading = model.body && (model.body.mesh.reading ?? {});
    const { mesh, parts, normals } = await readObject(model.object, reading ? { reading } : { onWarning: this.#warn });
    const body = model.body ?? (await this.#bake(mesh, signal));
    const points = (body.handles ?? (await spreadHandles(body))).map(({ name, ...handle }) => ({ name, handle }));
    const [solver, making] = await Promise.all([this.#parts.solver(), fetchMaking(model.object)]);
    const live = new LiveBody(solver, body, normals);
    const shown = new LiveGeometry(parts, making);
    try {
      return new BodyScene({
        ...common,
        body: live,
        shown,
        invitation: entry?.invitation ?? 'Drag a handle',
        points,
        overlay: byId('handles'),
        readout: this.#readout,
        address: this.#parts.address,
        onPlace: () => this.#placing.begin(),
      });
    } catch (error) {
      shown.dispose();
      live.dispose();
      throw error;
    }
  }

  async #bake(mesh: BodyData['mesh'], signal: AbortSignal): Promise<BodyData> {
    const { progress } = this.#parts;
    progress.begin('Finding the inside of your model…', () => this.#work?.abort());
    const { bakeInWorker } = await import('../worker/index.ts');
    const options = { resolution: OWN_RESOLUTION, signal, onProgress: (part: number) => progress.set(part), onWarning: this.#warn };
    try {
      return await bakeInWorker(mesh, options);
    } catch (error) {
      // A sheet has no inside to measure in; distances through the air serve it, with a warning that says so.
      if ((error as { code?: unknown }).code !== 'mesh-no-interior') throw error;
      return bakeInWorker(mesh, { ...options, distance: 'euclidean' });
    }
  }

  async #takeHandles(file: File): Promise<void> {
    const { messages } = this.#parts;
    try {
      const { readHandles } = await import('./handles-json.ts');
      const orders = readHandles(await file.text());
      if (!this.#body) {
        throw new PageError(
          'no-body',
          'Handles from a file need a body, and there is none on the stage.',
          'Choose the dog, or open a GLB first.',
        );
      }
      this.#body.order(orders);
    } catch (error) {
      messages.show(error);
    }
  }
}

/** Of a model that names none. */
async function spreadHandles({ mesh }: BodyData) {
  const { farthestVertices } = await import('../three/farthest.ts');
  return farthestVertices(mesh, OWN_HANDLES).map((vertex, i) => ({ name: `Handle ${i + 1}`, vertex }));
}
