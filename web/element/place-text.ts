import { PageError } from '../ui/page-error.ts';
import { wrongProperty } from './property.ts';

/** A place in a pose space by the names of its dimensions; what is left out is 0. */
export type NamedPlace = Readonly<Record<string, number>>;

/** "valence=0.6, arousal=0.4", as the command line has it. Throws a sentence that quotes what is wrong. */
export function readPlace(text: string): NamedPlace {
  const parts = text.split(',').filter((part) => part.trim() !== '');
  return Object.fromEntries(
    parts.map((part) => {
      const [name = '', value = '', ...more] = part.split('=').map((word) => word.trim());
      const number = value === '' ? Number.NaN : Number(value);
      if (name && more.length === 0 && Number.isFinite(number)) return [name, number];
      throw new PageError(
        'invalid-place',
        `The place “${part.trim()}” does not say a number of a dimension.`,
        'Write names and numbers: “valence=0.6, arousal=0.4”.',
      );
    }),
  );
}

/** A place that a program gave. Throws what it cannot be. */
export function checkPlace(place: NamedPlace): NamedPlace {
  const wanted = 'numbers by names: { valence: 0.6, arousal: 0.4 }';
  if (Object.prototype.toString.call(place) !== '[object Object]') throw wrongProperty('at', place, wanted);
  for (const [name, number] of Object.entries(place))
    if (number !== undefined && !Number.isFinite(number)) throw wrongProperty(`at.${name}`, number, wanted);
  return place;
}

/** One number a dimension, in their order. Throws where a name is none of them. */
export function placeIn(dimensions: readonly { readonly name: string }[], place: NamedPlace): number[] {
  const names = dimensions.map(({ name }) => name);
  const stranger = Object.keys(place).find((name) => !names.includes(name));
  if (stranger === undefined) return names.map((name) => place[name] ?? 0);
  throw new PageError('unknown-dimension', `The pose space has no dimension “${stranger}”.`, `It has these: ${names.join(', ')}.`);
}
