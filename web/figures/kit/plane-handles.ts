import { numbersOf, quoted } from '../../ui/address.ts';
import { readable } from '../../ui/dom.ts';
import type { Channel } from './channel.ts';

export type Place = readonly [number, number];

/**
 * A handle in the plane at rest (a point, or a bone from its first end to its second) and what its pose does: turn around the first end, then
 * move. Never changed in place.
 */
export interface Handle {
  readonly rest: Place;
  /** The second end of a bone. */
  readonly end?: Place;
  /** How far it is moved. */
  readonly move: Place;
  /** Degrees, counter-clockwise. */
  readonly turn: number;
}

/** 'auto' are those that a shape brings. */
export type Handles = readonly Handle[] | 'auto';

export const MOST_HANDLES = 24;

/** Handles in poses that are struck in motion, where motion is wanted; others are where they are at once. */
export const struck = new WeakSet<readonly Handle[]>();

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
export function toThousandths(value: number): number {
  return Math.abs(value) < 1e12 ? Math.round(value * 1000) / 1000 + 0 : value;
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

/** The handle at rest where its pose has it. */
export function placed(handle: Handle): Handle {
  const at = ([x, y]: Place): Place => [toThousandths(x), toThousandths(y)];
  return handle.end ? bone(at(placeOf(handle)), at(endOf(handle))) : point(...at(placeOf(handle)));
}

/** The handle with its first end at a place; as it was where that is none. */
export function movedTo(handle: Handle, x: number, y: number): Handle {
  const move: Place = [toThousandths(x - handle.rest[0]), toThousandths(y - handle.rest[1])];
  return move.every(Number.isFinite) ? { ...handle, move } : handle;
}

export function turnedTo(handle: Handle, degrees: number): Handle {
  return Number.isFinite(degrees) ? { ...handle, turn: Math.round(wrap(degrees) * 10) / 10 } : handle;
}

/** "Bone 3, x 0.50, y −0.25, turned 90°" */
export function describe(handle: Handle, i: number): string {
  const [x, y] = placeOf(handle);
  return `${handle.end ? 'Bone' : 'Handle'} ${i}, x ${readable(x)}, y ${readable(y)}, turned ${readable(handle.turn, 0)}°`;
}

/** Where handles are at rest, to be compared. */
export function restsOf(handles: readonly Handle[]): string {
  return handles.map(({ rest, end }) => `${rest} ${end}`).join(';');
}

/** A channel of handles: "p:x,y,dx,dy,turn~b:x,y,endX,endY"; what is at rest says nothing of its pose. */
export function planeHandles(initial: Handles): Channel<Handles> {
  return {
    initial,
    write: (handles) => (handles === 'auto' ? handles : handles.map(handleText).join('~')),
    read: (text, left) => {
      if (text === 'auto') return text;
      const parts = text === '' ? [] : text.split('~');
      if (parts.length > MOST_HANDLES)
        left.push(`${(parts.length - MOST_HANDLES).toLocaleString('en')} of ${parts.length.toLocaleString('en')} handles`);
      return parts.slice(0, MOST_HANDLES).flatMap((part) => {
        const handle = readHandle(part);
        if (!handle) left.push(quoted(part));
        return handle ? [handle] : [];
      });
    },
  };
}

/** A handle's number; −1 for none. Texts count from 1. */
export function pickedHandle(initial: number): Channel<number> {
  return {
    initial,
    read: (text) => (/^\d+$/.test(text) && Number(text) <= MOST_HANDLES ? Number(text) - 1 : undefined),
    write: (number) => String(number + 1),
  };
}

function handleText(handle: Handle): string {
  const { rest, end, move, turn } = handle;
  const pose = turn === 0 && move[0] === 0 && move[1] === 0 ? [] : [...move, turn];
  return `${end ? 'b' : 'p'}:${[...rest, ...(end ?? []), ...pose].join(',')}`;
}

function readHandle(text: string): Handle | undefined {
  const [kind, rest = ''] = text.split(':');
  const read = numbersOf(rest);
  const ends = kind === 'b' ? 4 : 2;
  if ((kind !== 'p' && kind !== 'b') || (read?.length !== ends && read?.length !== ends + 3)) return undefined;
  const [dx = 0, dy = 0, turn = 0] = read.slice(ends);
  const [x, y, ex, ey] = read as [number, number, number, number];
  return kind === 'b' ? bone([x, y], [ex, ey], [dx, dy], wrap(turn)) : point(x, y, dx, dy, wrap(turn));
}
