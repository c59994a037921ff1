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

/** Writes the 3×4 matrix of a pose about a center: rotation about z after y after x. */
export function writeTransform(pose: Pose, center: Vec3, diagonal: number, out: Float64Array, at: number): void {
  const [a, b, c] = pose.map((degrees) => (degrees * Math.PI) / 180) as [number, number, number];
  const [ca, sa, cb, sb, cc, sc] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b), Math.cos(c), Math.sin(c)];
  const rotation = [
    [cc * cb, cc * sb * sa - sc * ca, cc * sb * ca + sc * sa],
    [sc * cb, sc * sb * sa + cc * ca, sc * sb * ca - cc * sa],
    [-sb, cb * sa, cb * ca],
  ] as const;
  rotation.forEach((row, i) => {
    out.set(row, at + 4 * i);
    const moved = row[0] * center[0] + row[1] * center[1] + row[2] * center[2];
    out[at + 4 * i + 3] = (center[i] as number) - moved + (pose[3 + i] as number) * diagonal;
  });
}
