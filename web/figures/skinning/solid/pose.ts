import { Euler, MathUtils, Matrix4 } from 'three';
import type { Vec3 } from '../../../../wasm/ts/types.ts';
import type { Channel } from '../../kit/channel.ts';

/** Of one handle: turns about x, y and z in degrees, and a shift in parts of the solid's diagonal. */
export type Pose = readonly [turnX: number, turnY: number, turnZ: number, shiftX: number, shiftY: number, shiftZ: number];

/** By the handle's number; those that are not here are at rest. */
type Poses = Readonly<Record<number, Pose>>;

const REST: Pose = [0, 0, 0, 0, 0, 0];
const MOST: Pose = [180, 180, 180, 0.5, 0.5, 0.5];

export function poseOf(poses: Poses, handle: number): Pose {
  return poses[handle] ?? REST;
}

/** "1:180,0,0,0,0,0;3:…" */
export function posesOf(handles: number): Channel<Poses> {
  return {
    initial: {},
    write: (poses) =>
      Object.entries(poses)
        .filter(([, pose]) => pose.some((number) => number !== 0))
        .map(([handle, pose]) => `${handle}:${pose.join(',')}`)
        .join(';'),
    read: (text) => {
      const rows = text.split(';').map((row) => /^(\d+):(.+)$/.exec(row));
      const poses: Record<number, Pose> = {};
      for (const row of text === '' ? [] : rows) {
        const [handle, numbers] = [Number(row?.[1] ?? Number.NaN), (row?.[2] ?? '').split(',').map(Number)];
        if (!(handle < handles) || numbers.length !== REST.length || !numbers.every(Number.isFinite)) return undefined;
        poses[handle] = numbers.map((number, i) => Math.min(Math.max(number, -(MOST[i] ?? 0)), MOST[i] ?? 0)) as unknown as Pose;
      }
      return poses;
    },
  };
}

const [turn, back, angles] = [new Matrix4(), new Matrix4(), new Euler()];

/** Writes the 3×4 matrix of a pose about a center: rotation about z after y after x. */
export function writeTransform(pose: Pose, center: Vec3, diagonal: number, out: Float64Array, at: number): void {
  const [a, b, c] = pose.map(MathUtils.degToRad) as [number, number, number];
  const [x, y, z] = center.map((place, i) => place + (pose[3 + i] as number) * diagonal) as [number, number, number];
  back.makeTranslation(-center[0], -center[1], -center[2]);
  turn
    .makeRotationFromEuler(angles.set(a, b, c, 'ZYX'))
    .setPosition(x, y, z)
    .multiply(back);
  // three.js goes down the columns.
  for (let i = 0; i < 12; i++) out[at + i] = turn.elements[4 * (i % 4) + Math.floor(i / 4)] as number;
}
