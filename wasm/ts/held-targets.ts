/** What floats can hold, of targets and of the shapes that they make. */
import { HandlebodyError } from './errors.ts';

/** Numbers a handle takes in `Irbf.targets`: position xyz, quaternion xyzw, scale xyz. */
export const TARGET_SIZE = 10;
/** Where the scale begins in them. */
const SCALES = 7;

/** The largest number that the positions of a mesh can hold: they are floats. */
const FLOAT_MAX = 3.4028234663852886e38;

const REMEDY = 'Give targets of the size of the model, and scales near 1: positions are floats, which end at 3.4e38.';

/**
 * Refuses scales with which a model of this diagonal outgrows its numbers; places far away the solver refuses by itself. `kinds` is 1 for
 * a handle that turns and scales. Throws 'target-not-finite' naming the handle.
 */
export function checkScales(targets: Float64Array, kinds: Uint32Array, diagonal: number): void {
  for (let i = 0; i < targets.length; i++) {
    const scale = targets[i] as number;
    const handle = Math.floor(i / TARGET_SIZE);
    if (i % TARGET_SIZE < SCALES || !kinds[handle] || !Number.isFinite(scale)) continue;
    if (Math.abs(scale) * diagonal <= FLOAT_MAX) continue;
    throw new HandlebodyError('target-not-finite', {
      message: `Handle ${handle} has the scale ${scale}, beyond what the numbers of a shape can hold.`,
      remedy: REMEDY,
      culprit: { kind: 'handle', index: handle },
    });
  }
}

/** Refuses a shape that is not finite: of that nothing can be drawn, and files cannot hold it. */
export function checkHeld(rows: Float32Array): void {
  let sum = 0;
  for (let i = 0; i < rows.length; i++) sum += (rows[i] as number) - (rows[i] as number);
  if (sum === 0) return;
  const vertex = Math.floor(rows.findIndex((x) => !Number.isFinite(x)) / 3);
  throw new HandlebodyError('target-not-finite', {
    message: `Vertex ${vertex} goes beyond what the numbers of a shape can hold.`,
    remedy: REMEDY,
    culprit: { kind: 'vertex', index: vertex },
  });
}
