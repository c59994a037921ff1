import type { DualQuaternion, HandlebodyRuntime, LinearBlend } from '../../../wasm/ts/runtime.ts';
import type { View } from '../../stage/view.ts';
import { byId, h } from '../../ui/dom.ts';
import { isAbort, type Messages } from '../../ui/messages.ts';
import type { Progress } from '../../ui/progress.ts';
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

/** One solid at a time: its weights, its pose, its picture. */
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
  #method: Method = 'biharmonic';
  #blend: Blend = 'linear';
  #weights: Weights | undefined;
  #skins: Record<Blend, LinearBlend | DualQuaternion> | undefined;
  #waiting = false;

  constructor(parts: Parts) {
    this.#parts = parts;
    const first = SOLIDS.find(({ id }) => location.hash === `#${id}`)?.id ?? 'bar';
    byId('solids').append(
      ...SOLIDS.map(({ id, label }) => {
        const input = h('input', { type: 'radio', name: 'solid', value: id, onchange: () => void this.open(id) });
        input.checked = id === first;
        return h('label', {}, input, h('span', {}, label));
      }),
    );
    void this.open(first);
  }

  async open(id: Solid['id']): Promise<void> {
    await this.#attempt('Getting the solid…', async (signal) => {
      const solid = await SOLIDS.find((entry) => entry.id === id)?.make(signal);
      if (!solid || signal.aborted) return;
      history.replaceState(null, '', `#${id}`);
      this.#solid = solid;
      this.#diagonal = diagonalOf(solid.positions);
      this.#volume = volumeOf(solid.positions, solid.triangles);
      this.#weights = undefined;
      this.#poses = solid.handles.map(atRest);
      this.#chosen = solid.chosen;
      this.#mesh = new SkinMesh(solid.positions, solid.triangles);
      this.#mesh.showWeight(new Float32Array(), 0, -1);
      this.#parts.view.show(this.#mesh);
      this.#parts.view.frame(this.#mesh, solid.view, true);
      this.#panel = new Panel(solid, {
        setMethod: (method) => {
          this.#method = method;
          this.#panel?.show(method, this.#blend);
          void this.#attempt('Computing weights…', (inner) => this.#compute(inner));
        },
        setBlend: (blend) => {
          this.#blend = blend;
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
      byId('panel').replaceChildren(this.#panel.element);
      this.#panel.show(this.#method, this.#blend);
      this.#panel.posed(this.#chosen, atRest());
      await this.#compute(signal);
    });
  }

  /** Runs long work with a bar, a way to stop it, and a sentence where it fails; what is shown stays. */
  async #attempt(label: string, work: (signal: AbortSignal) => Promise<void>): Promise<void> {
    this.#abort.abort(new DOMException('Something else was asked for.', 'AbortError'));
    const own = new AbortController();
    this.#abort = own;
    const { progress, messages } = this.#parts;
    byId('solid').dataset.state = 'busy';
    messages.clear();
    progress.begin(label, () => own.abort(new DOMException('Cancelled.', 'AbortError')));
    try {
      await work(own.signal);
    } catch (error) {
      if (!isAbort(error)) messages.show(error);
    }
    if (this.#abort !== own) return;
    progress.end();
    byId('solid').dataset.state = this.#weights ? 'ready' : 'failed';
  }

  async #compute(signal: AbortSignal): Promise<void> {
    const solid = this.#solid as Solid;
    this.#parts.progress.set(undefined, 'Computing weights…');
    const [hb, weights] = await Promise.all([
      this.#parts.solver,
      computeWeights(solid, this.#method, signal, (part) => this.#parts.progress.set(part)),
    ]);
    if (signal.aborted) return;
    this.#skins?.linear.dispose();
    this.#skins?.rigid.dispose();
    const options = { positions: solid.positions, weights: weights.weights };
    this.#skins = { linear: hb.linearBlend(options), rigid: hb.dualQuaternion(options) };
    this.#weights = weights;
    this.#color();
    this.#deform();
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
