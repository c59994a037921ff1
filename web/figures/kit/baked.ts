import type { BakeOptions, BodyData, Mesh } from '../../../wasm/ts/types.ts';
import { bakeInWorker } from '../../worker/bake-in-worker.ts';
import type { Work } from './figure.ts';

const bodies = new Map<string, Promise<BodyData>>();

/** A body, baked off the main thread once a page; `name` stands for the mesh and the options. */
export async function baked(name: string, mesh: () => Mesh, options: BakeOptions, work: Work): Promise<BodyData> {
  const known = bodies.get(name);
  if (known) return known;
  work.progress(0, 'Preparing the body…');
  const { signal } = work;
  const body = bakeInWorker(mesh(), { ...options, signal, onProgress: (part) => work.progress(part), onFallback: work.alone });
  bodies.set(name, body);
  body.catch(() => bodies.delete(name));
  return body;
}
