import type { Object3D } from 'three';
import type { SceneChoices } from '../assets/scene-choices.ts';
import type { ObjectMesh } from './object-part.ts';
import { asksForMore, plainObject } from './plain-object.ts';

/** What `meshFromObject` gives, with less to fetch where the object is plain. Who wants warnings fetches all of it. */
export async function readObject(object: Object3D, choices: SceneChoices = {}): Promise<ObjectMesh> {
  const plain = asksForMore(choices) ? undefined : plainObject(object, choices.reading?.origin);
  return plain ?? (await import('./geometry.ts')).meshFromObject(object, choices);
}
