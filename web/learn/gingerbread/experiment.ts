import type { Shape } from '../../models/shape.ts';
import type { MethodId } from './methods.ts';

export type Place = readonly [number, number];

/** A handle at rest (a point, or a bone from its first end to its second) and what its pose does: turn around the first end, then move. */
export interface Handle {
  readonly rest: Place;
  /** The second end of a bone. */
  readonly end?: Place;
  /** How far it is moved. */
  move: Place;
  /** Degrees, counter-clockwise. */
  turn: number;
}

export type ShapeName = 'man' | 'bar' | 'ring' | 'octopus' | 'own';

interface Show {
  /** Weight of the picked handle as colors and isolines, instead of the picture. */
  weight: boolean;
  /** The triangles. */
  mesh: boolean;
}

/** All that the page shows, and what its address says. */
export interface Experiment {
  shape: ShapeName;
  /** Of the shape 'own'. */
  outline: Shape | undefined;
  /** About how many vertices. */
  vertices: number;
  handles: Handle[];
  picked: number;
  method: MethodId;
  show: Show;
}

export const MOST_HANDLES = 24;

export const VERTICES = { low: 200, initial: 2250, high: 8000 } as const;

/** Where the first end of a handle is now. */
export function placeOf({ rest, move }: Handle): Place {
  return [rest[0] + move[0], rest[1] + move[1]];
}

/** Where the second end of a bone is now. */
export function endOf(handle: Handle): Place {
  const [x, y] = placeOf(handle);
  const [dx, dy] = handle.end ? [handle.end[0] - handle.rest[0], handle.end[1] - handle.rest[1]] : [0, 0];
  const [c, s] = turned(handle.turn);
  return [x + c * dx - s * dy, y + s * dx + c * dy];
}

/** Cosine and sine of degrees. */
function turned(degrees: number): [number, number] {
  const angle = (degrees * Math.PI) / 180;
  return [Math.cos(angle), Math.sin(angle)];
}

/** The handles' transforms, 2×3 each, row by row: T p = R (p − rest) + rest + move. */
export function writeTransforms(handles: readonly Handle[], out: Float64Array): void {
  handles.forEach((handle, i) => {
    const [c, s] = turned(handle.turn);
    const [x, y] = handle.rest;
    const [u, v] = placeOf(handle);
    out.set([c, -s, u - c * x + s * y, s, c, v - s * x - c * y], 6 * i);
  });
}

/** Into (−180, 180]. */
export function wrap(degrees: number): number {
  if (degrees > -180 && degrees <= 180) return degrees;
  const wrapped = ((((degrees + 180) % 360) + 360) % 360) - 180;
  return wrapped === -180 ? 180 : wrapped;
}

/** To a thousandth, so that addresses stay short and a place said is the place meant; what is far away has no thousandths. */
export function tidy(value: number): number {
  return Math.abs(value) < 1e12 ? Math.round(value * 1000) / 1000 + 0 : value;
}

export function atRest(handle: Handle): boolean {
  return handle.turn === 0 && handle.move[0] === 0 && handle.move[1] === 0;
}

export function point(x: number, y: number, dx = 0, dy = 0, turn = 0): Handle {
  return { rest: [x, y], move: [dx, dy], turn };
}

export function bone(from: Place, to: Place, move: Place = [0, 0], turn = 0): Handle {
  return { rest: from, end: to, move, turn };
}

/** The handle where it is at rest. */
export function resting(handle: Handle): Handle {
  return { ...handle, move: [0, 0], turn: 0 };
}

export function copyOf(handle: Handle): Handle {
  return { ...handle };
}
