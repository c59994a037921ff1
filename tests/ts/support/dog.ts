import { readFileSync } from 'node:fs';
import type { BodyData } from '../../../wasm/ts/index.ts';
import { readBody, readGlb } from '../../../web/assets/index.ts';
import { bounds } from './shapes.ts';

/** The dog's file as it is served. */
export function readDogBytes(): Uint8Array {
  return readFileSync(new URL('../../../public/models/dog.glb', import.meta.url));
}

/** The baked dog in it. */
export async function readDog(): Promise<BodyData> {
  const body = await readBody(await readGlb(readDogBytes()));
  if (!body) throw new Error('public/models/dog.glb carries no body');
  return body;
}

/** Vertex numbers of the six handles of the set-up: its dog looks along +x, so its left is −z. */
export function dogHandles(
  positions: ArrayLike<number>,
): Record<'leftFront' | 'rightFront' | 'leftHind' | 'rightHind' | 'nose' | 'tail', number> {
  const { low, high } = bounds(positions);
  const middle = low.map((l, axis) => (l + (high[axis] ?? 0)) / 2);
  const best = (score: (x: number, y: number, z: number) => number): number => {
    let [winner, most] = [0, -Infinity];
    for (let v = 0; v < positions.length / 3; v++) {
      const value = score(
        (positions[3 * v] ?? 0) - (middle[0] ?? 0),
        positions[3 * v + 1] ?? 0,
        (positions[3 * v + 2] ?? 0) - (middle[2] ?? 0),
      );
      if (value > most) [winner, most] = [v, value];
    }
    return winner;
  };
  const paw = (front: 1 | -1, left: boolean) =>
    best((x, y, z) => (x * front > 0 && z < 0 === left ? -y + 0.3 * front * x : -Infinity));
  return {
    leftFront: paw(1, true),
    rightFront: paw(1, false),
    leftHind: paw(-1, true),
    rightHind: paw(-1, false),
    nose: best((x) => x),
    tail: best((x) => -x),
  };
}
