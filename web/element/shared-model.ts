import type { Mesh, Object3D } from 'three';
import { clone } from 'three/addons/utils/SkeletonUtils.js';
import { throwIfAborted } from '../../wasm/ts/errors.ts';
import { fetchModel } from '../three/fetch-model.ts';
import { type LoadedModel, loadModel } from '../three/load-model.ts';

/** A model that is on its way or there, and how many hold it. */
interface Held {
  readonly coming: Promise<LoadedModel>;
  readonly stop: AbortController;
  readonly listeners: Set<(part: number | undefined) => void>;
  holders: number;
}

const held = new Map<string, Held>();

/** A model of one's own, whose geometry, materials and baked body are those of all that show it. */
export interface SharedModel extends LoadedModel {
  /** It is not shown any more. */
  release(): void;
}

/** Fetches and reads a model once, however many elements show it at a time. Throws what `fetchModel` and `loadModel` throw. */
export async function shareModel(
  src: URL,
  signal: AbortSignal,
  onProgress: (part: number | undefined) => void,
): Promise<SharedModel> {
  const one = held.get(src.href) ?? begin(src);
  one.holders++;
  one.listeners.add(onProgress);
  const release = once(() => {
    one.listeners.delete(onProgress);
    if (--one.holders > 0) return;
    if (held.get(src.href) === one) held.delete(src.href);
    one.stop.abort();
  });
  try {
    const left = new Promise<never>((_, reject) => signal.addEventListener('abort', () => reject(signal.reason), { once: true }));
    const model = await Promise.race([one.coming, left]);
    throwIfAborted(signal);
    return { ...copyOf(model), release };
  } catch (error) {
    release();
    throw error;
  }
}

function begin(src: URL): Held {
  const [stop, listeners] = [new AbortController(), new Set<(part: number | undefined) => void>()];
  const tell = (part: number | undefined) => {
    for (const listener of listeners) listener(part);
  };
  const coming = fetchModel(src, stop.signal, tell).then(loadModel);
  const one: Held = { coming, stop, listeners, holders: 0 };
  held.set(src.href, one);
  // It is asked for anew where it did not come.
  coming.catch(() => held.get(src.href) === one && held.delete(src.href));
  return one;
}

/** Objects of its own, so that each may move; what they are made of is shared. */
function copyOf({ object, body, space }: LoadedModel): LoadedModel {
  // Skins keep to their own bones.
  const copy = clone(object);
  if (!space) return { object: copy, body, space };
  const [from, to] = [partsOf(object), partsOf(copy)];
  return { object: copy, body, space: { ...space, meshes: space.meshes.map((mesh) => to[from.indexOf(mesh)] as Mesh) } };
}

function partsOf(object: Object3D): Object3D[] {
  const parts: Object3D[] = [];
  object.traverse((part) => parts.push(part));
  return parts;
}

function once(work: () => void): () => void {
  let done = false;
  return () => {
    if (!done) work();
    done = true;
  };
}
