import type { DualQuaternion, HandlebodyRuntime, LinearBlend } from '../../../wasm/ts/runtime.ts';
import type { View } from '../../stage/view.ts';
import { leftOut, writeAddress } from '../../ui/address.ts';
import { copyLink } from '../../ui/copy-link.ts';
import { byId, h } from '../../ui/dom.ts';
import { NotFetched } from '../../ui/lazy.ts';
import { isAbort, type Messages } from '../../ui/messages.ts';
import { PageError } from '../../ui/page-error.ts';
import type { Progress } from '../../ui/progress.ts';
import { fromAddress, type State, toAddress } from './address.ts';
import type { Weights } from './messages.ts';
import { type Blend, Panel } from './panel.ts';
import { atRest, type Pose, writeTransform } from './pose.ts';
import { SkinMesh } from './skin-mesh.ts';
import { SOLIDS, type Solid } from './solids.ts';
import { computeWeights, type Method } from './weights.ts';

interface Parts {
  readonly view: View;
  readonly solver: Promise<HandlebodyRuntime>;
  readonly messages: Messages;
  readonly progress: Progress;
}

/** One solid at a time: its weights, its pose, its picture. What is shown stays until what was asked for is there. */
export class Lesson {
  readonly #parts: Parts;
  #abort = new AbortController();
  #solid: Solid | undefined;
  #mesh: SkinMesh | undefined;
  /** Of the solid at rest. */
  #diagonal = 1;
  #volume = 1;
  #panel: Panel | undefined;
  #poses: Pose[] = [];
  #chosen = 0;
  #colored = true;
  /** Of the weights that are shown, if there are any. */
  #method: Method | undefined;
  #blend: Blend = 'linear';
  #weights: Weights | undefined;
  #skins: Record<Blend, LinearBlend | DualQuaternion> | undefined;
  #waiting = false;

  constructor(parts: Parts) {
    this.#parts = parts;
    byId('solids').append(
      ...SOLIDS.map(({ id, label }) => {
        const input = h('input', {
          type: 'radio',
          name: 'solid',
          value: id,
          onchange: () => void this.#open({ ...this.#state, solid: id }),
        });
        return h('label', {}, input, h('span', {}, label));
      }),
    );
    copyLink(byId('copy'), byId('live'), () => this.#write());
    addEventListener('hashchange', () => this.#follow());
    this.#follow();
  }

  /** What is shown; what the page begins with where that is nothing. */
  get #state(): State {
    const first = fromAddress('');
    return { solid: this.#solid?.id ?? first.solid, method: this.#method ?? first.method, blend: this.#blend };
  }

  /** Shows what the address says, as far as it can be read. */
  #follow(): void {
    const left: string[] = [];
    void this.#open(fromAddress(location.hash, left), leftOut(left));
  }

  /** Runs long work with a bar and a way to stop it. Where it fails or is stopped, what is chosen is again what is shown. */
  async #open(next: State, said?: PageError): Promise<void> {
    this.#abort.abort(new DOMException('Something else was asked for.', 'AbortError'));
    const own = new AbortController();
    this.#abort = own;
    const { progress, messages } = this.#parts;
    byId('solid').dataset.state = 'busy';
    messages.clear();
    this.#blend = next.blend;
    this.#deform();
    this.#mark(next.solid, next.method);
    progress.begin('Getting the solid…', () => own.abort(new DOMException('Cancelled.', 'AbortError')));
    try {
      if (next.solid !== this.#solid?.id || next.method !== this.#method) await this.#bring(next, own.signal);
      if (said) messages.show(said);
    } catch (error) {
      if (this.#abort === own && !isAbort(error))
        messages.show(error, error instanceof NotFetched ? () => void this.#open(next) : undefined);
    }
    // What was asked for meanwhile tells its own end.
    if (this.#abort !== own) return;
    progress.end();
    byId('solid').dataset.state = this.#weights ? 'ready' : 'failed';
    this.#mark(this.#solid?.id, this.#method);
    if (this.#solid) this.#write();
  }

  #write(): void {
    writeAddress(toAddress(this.#state));
  }

  #mark(solid: Solid['id'] | undefined, method: Method | undefined): void {
    for (const input of byId('solids').querySelectorAll('input')) input.checked = input.value === solid;
    this.#panel?.show(method, this.#blend);
  }

  /** Weights by a method, of another solid too. */
  async #bring(next: State, signal: AbortSignal): Promise<void> {
    const { progress, messages, solver } = this.#parts;
    const solid = this.#solid?.id === next.solid ? this.#solid : await SOLIDS.find(({ id }) => id === next.solid)?.make(signal);
    signal.throwIfAborted();
    if (!solid) return;
    // The first picture does not wait for weights.
    if (!this.#solid) this.#stage(solid, next.method);
    progress.set(undefined, 'Computing weights…');
    const listener = {
      signal,
      onProgress: (part: number) => progress.set(part),
      onFallback: () => messages.show(withoutWorker()),
    };
    const [hb, weights] = await Promise.all([solver, computeWeights(solid, next.method, listener, toAddress(next))]);
    signal.throwIfAborted();
    if (solid !== this.#solid) this.#stage(solid, next.method);
    this.#skins?.linear.dispose();
    this.#skins?.rigid.dispose();
    const options = { positions: solid.positions, weights: weights.weights };
    this.#skins = { linear: hb.linearBlend(options), rigid: hb.dualQuaternion(options) };
    [this.#weights, this.#method] = [weights, next.method];
    this.#color();
    this.#deform();
  }

  /** Another solid comes on the stage, at rest, with a panel of its own. */
  #stage(solid: Solid, method: Method): void {
    this.#solid = solid;
    this.#diagonal = diagonalOf(solid.positions);
    this.#volume = volumeOf(solid.positions, solid.triangles);
    [this.#weights, this.#method] = [undefined, undefined];
    this.#poses = solid.handles.map(atRest);
    [this.#chosen, this.#colored] = [solid.chosen, true];
    this.#mesh = new SkinMesh(solid.positions, solid.triangles);
    this.#mesh.showWeight(new Float32Array(), 0, -1);
    this.#parts.view.show(this.#mesh);
    this.#parts.view.frame(this.#mesh, solid.view, true);
    this.#panel = new Panel(solid, {
      setMethod: (id) => void this.#open({ ...this.#state, method: id }),
      setBlend: (id) => {
        this.#blend = id;
        this.#write();
        this.#deform();
      },
      choose: (handle) => {
        this.#chosen = handle;
        this.#panel?.posed(handle, this.#poses[handle] ?? atRest());
        this.#color();
      },
      showWeight: (shown) => {
        this.#colored = shown;
        this.#color();
      },
      pose: (handle, pose) => {
        this.#poses[handle] = pose;
        this.#deform();
      },
      reset: () => this.#setPoses(solid.handles.map(atRest)),
      preset: () => this.#setPoses(presetOf(solid)),
    });
    const focused = byId('panel').contains(document.activeElement);
    byId('panel').replaceChildren(this.#panel.element);
    if (focused) byId('solids').querySelector<HTMLElement>(`input[value=${solid.id}]`)?.focus();
    this.#panel.show(method, this.#blend);
    this.#panel.posed(this.#chosen, atRest());
  }

  #setPoses(poses: Pose[]): void {
    this.#poses = poses;
    this.#panel?.posed(this.#chosen, poses[this.#chosen] ?? atRest());
    this.#deform();
  }

  #color(): void {
    if (!this.#weights || !this.#mesh) return;
    this.#mesh.showWeight(this.#weights.weights, this.#poses.length, this.#colored ? this.#chosen : -1);
    this.#parts.view.invalidate();
  }

  /** Once a frame at the most. */
  #deform(): void {
    if (this.#waiting) return;
    this.#waiting = true;
    requestAnimationFrame(() => {
      this.#waiting = false;
      const [solid, skin, mesh] = [this.#solid, this.#skins?.[this.#blend], this.#mesh];
      if (!solid || !skin || !mesh || !this.#weights) return;
      const { transforms } = skin;
      this.#poses.forEach((pose, j) => {
        const handle = solid.handles[j];
        if (handle) writeTransform(pose, handle.center, this.#diagonal, transforms, 12 * j);
      });
      skin.deform(mesh.positions);
      mesh.moved();
      this.#parts.view.changed();
      this.#panel?.measured(this.#weights, volumeOf(mesh.positions, solid.triangles) / this.#volume);
    });
  }
}

function withoutWorker(): PageError {
  return new PageError(
    'worker-unavailable',
    'No second thread could be started here: while weights are computed, the page does not answer.',
    'Open the page in a window of its own if it takes too long.',
  );
}

/** A twist that linear blending does not survive; a paw lifted forward. */
function presetOf(solid: Solid): Pose[] {
  return solid.handles.map((_, i): Pose => {
    if (i !== solid.chosen) return atRest();
    return solid.id === 'bar' ? { shift: [0, 0, 0], turn: [180, 0, 0] } : { shift: [0.12, 0.12, 0], turn: [0, 0, 60] };
  });
}

function diagonalOf(positions: ArrayLike<number>): number {
  const [low, high] = [
    [Infinity, Infinity, Infinity],
    [-Infinity, -Infinity, -Infinity],
  ];
  for (let i = 0; i < positions.length; i++) {
    low[i % 3] = Math.min(low[i % 3] as number, positions[i] as number);
    high[i % 3] = Math.max(high[i % 3] as number, positions[i] as number);
  }
  return Math.hypot(...high.map((x, axis) => x - (low[axis] as number)));
}

/** What a closed surface encloses. */
function volumeOf(p: ArrayLike<number>, triangles: Uint32Array): number {
  let sum = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * (triangles[t] as number), 3 * (triangles[t + 1] as number), 3 * (triangles[t + 2] as number)];
    const n = (i: number) => p[i] as number;
    sum +=
      n(a) * (n(b + 1) * n(c + 2) - n(b + 2) * n(c + 1)) +
      n(a + 1) * (n(b + 2) * n(c) - n(b) * n(c + 2)) +
      n(a + 2) * (n(b) * n(c + 1) - n(b + 1) * n(c));
  }
  return sum / 6;
}
