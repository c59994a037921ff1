import type { Channel } from './channel.ts';

/** Where the points of a list are in space: three numbers each, as "x,y,z;x,y,z". As many as at first, within 1e9. */
export function inSpace(initial: readonly number[]): Channel<readonly number[]> {
  return {
    initial,
    write: (numbers) => {
      const rows = Array.from({ length: numbers.length / 3 }, (_, i) =>
        numbers
          .slice(3 * i, 3 * i + 3)
          .map(short)
          .join(','),
      );
      return rows.join(';');
    },
    read: (text) => {
      const numbers = text.split(/[;,]/).map((part) => (part.trim() === '' ? Number.NaN : Number(part)));
      const sound = numbers.length === initial.length && numbers.every((number) => Math.abs(number) < 1e9);
      return sound ? numbers : undefined;
    },
  };
}

/** The list with point `i` elsewhere. */
export function placed(numbers: readonly number[], i: number, place: readonly number[]): readonly number[] {
  return numbers.map((number, k) => (Math.floor(k / 3) === i ? (place[k % 3] ?? number) : number));
}

/** Fine enough for a screen, short enough for an address. */
function short(value: number): string {
  return String(Number(value.toPrecision(5)));
}

/** n×3 numbers as n points. */
export function rows(numbers: readonly number[]): [number, number, number][] {
  return Array.from({ length: numbers.length / 3 }, (_, i) => numbers.slice(3 * i, 3 * i + 3) as [number, number, number]);
}
