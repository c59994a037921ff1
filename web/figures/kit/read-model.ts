import type { Mesh } from 'three';
import { loadModel } from '../../three/load-model.ts';
import { readObject } from '../../three/read-object.ts';
import { notFetched } from '../../ui/lazy.ts';

const HERE = import.meta.url;
/** Whatever page shows it: the folders of scripts lie beside that of the models, but for a development server, which serves the sources. */
const MODELS = /\.ts(\?|$)/.test(HERE) ? '../../models/' : '../models/';

const models = new Map<string, ReturnType<typeof fetchOnce>>();

/** The surface in one of the site's models, fetched once a page: "dog.glb". `what` names it in words where it does not come. */
export function fetchModel(file: string, what: string) {
  const coming = models.get(file) ?? fetchOnce(file, what);
  models.set(file, coming);
  coming.catch(() => models.delete(file));
  return coming;
}

/** Throws where the script has no folder: it is inside a page. */
const fetchBeside = async (file: string) => fetch(new URL(MODELS + file, HERE));

async function fetchOnce(file: string, what: string) {
  const response = await fetchBeside(file).catch(() => undefined);
  if (!response?.ok) throw await notFetched(what);
  const { object } = await loadModel(await response.arrayBuffer());
  const { mesh } = await readObject(object);
  object.traverse((part) => (part as Partial<Mesh>).geometry?.dispose());
  return { positions: Float32Array.from(mesh.positions), triangles: Uint32Array.from(mesh.triangles) };
}
