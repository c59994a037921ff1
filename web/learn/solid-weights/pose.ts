import type { Vec3 } from '../../../wasm/ts/types.ts';

/** What the sliders say of one handle: a shift in parts of the solid's diagonal, and turns about x, y and z in degrees. */
export interface Pose {
  readonly shift: [number, number, number];
  readonly turn: [number, number, number];
}

export const atRest = (): Pose => ({ shift: [0, 0, 0], turn: [0, 0, 0] });

/** Writes the 3×4 matrix of a pose about a center: rotation about z after y after x. */
export function writeTransform({ shift, turn }: Pose, center: Vec3, diagonal: number, out: Float64Array, at: number): void {
  const [a, b, c] = turn.map((degrees) => (degrees * Math.PI) / 180) as [number, number, number];
  const [ca, sa, cb, sb, cc, sc] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b), Math.cos(c), Math.sin(c)];
  const rotation = [
    [cc * cb, cc * sb * sa - sc * ca, cc * sb * ca + sc * sa],
    [sc * cb, sc * sb * sa + cc * ca, sc * sb * ca - cc * sa],
    [-sb, cb * sa, cb * ca],
  ] as const;
  rotation.forEach((row, i) => {
    out.set(row, at + 4 * i);
    const moved = row[0] * center[0] + row[1] * center[1] + row[2] * center[2];
    out[at + 4 * i + 3] = (center[i] as number) - moved + (shift[i] as number) * diagonal;
  });
}
