/** What callers give of three.js: read, or refused by name, as everywhere (wasm/ts/arguments.ts). */
import type { Object3D, Vector3 } from 'three';
import { type Reader, refused } from '../../wasm/ts/arguments.ts';

const is =
  <T>(flag: string, remedy: string): Reader<T> =>
  (value, name) => {
    if ((value as Record<string, unknown> | null | undefined)?.[flag]) return value as T;
    throw refused(name, value, remedy);
  };

export const object3D = is<Object3D>(
  'isObject3D',
  'Give an Object3D: of a loaded file, gltf.scene; of a geometry, a Mesh that has it.',
);
export const vector3 = is<Vector3>('isVector3', 'Give a Vector3.');
export const camera = is('isCamera', 'Give a camera.');
/** Of the solver, and of what it makes, the method that is used. */
export const solver = is('poseSpace', 'Give what load() returns.');
export const deforming = is('deform', 'Give what hb.irbf(body) returns.');
export const container = is('append', 'Give an element of the page.');

/** The number of one of `count` things. Allocates nothing. */
export function numberOf(value: unknown, name: string, count: number): number {
  if (Number.isInteger(value) && (value as number) >= 0 && (value as number) < count) return value as number;
  throw refused(name, value, count > 0 ? `Give a whole number from 0 to ${count - 1}.` : 'There are none yet.');
}

/** What to pick by: a Raycaster, a hit of one, or where a pointer is. */
export const aim: Reader<object> = (value, name) => {
  const given = value as Readonly<Record<string, unknown>> | null | undefined;
  if (typeof given === 'object' && given && ('ray' in given || 'point' in given || 'clientX' in given)) return given;
  throw refused(name, value, 'Give a Raycaster, or a hit of one.');
};
