import { PageError } from '../ui/page-error.ts';
import { isPlace, wrongProperty } from './property.ts';

const ASKED = 'a list of { vertex } or { at: [x, y, z] }, or text';

/** A handle as a page asks for it: a vertex of the model, or a place inside, model units. */
export type AskedHandle = ({ readonly vertex: number } | { readonly at: readonly [number, number, number] }) & {
  readonly name?: string;
};

/** "Nose: 13637, Tip: 0 1 0, 42": names are optional, one number is a vertex, three are a place. Throws a sentence that quotes what is wrong. */
export function readHandles(text: string): AskedHandle[] {
  const parts = text.split(',').filter((part) => part.trim() !== '');
  return parts.map((part) => {
    const [, name = '', words = 'none'] = /^(?:([^:]*):)?([^:]*)$/.exec(part) ?? [];
    const numbers = words.trim().split(/\s+/).map(Number);
    const named = name.trim() ? { name: name.trim() } : {};
    const [x = Number.NaN, y = 0, z = 0] = numbers;
    if (numbers.length === 1 && Number.isInteger(x) && x >= 0) return { ...named, vertex: x };
    if (numbers.length === 3 && numbers.every(Number.isFinite)) return { ...named, at: [x, y, z] };
    throw new PageError(
      'invalid-handles',
      `The handle “${part.trim()}” is neither a vertex nor a place.`,
      'Write a vertex number or three coordinates, with a name before a colon: “Nose: 13637, Tip: 0 1 0”.',
    );
  });
}

/** The inverse of `readHandles`. Throws where the property of a page is no list of handles. */
export function writeHandles(handles: readonly AskedHandle[]): string {
  if (!Array.isArray(handles)) throw wrongProperty('handles', handles, ASKED);
  return handles
    .map((handle: Partial<Record<'name' | 'vertex' | 'at', unknown>> | null | undefined, i) => {
      const { name = '', vertex, at } = handle ?? {};
      const isVertex = Number.isInteger(vertex) && (vertex as number) >= 0;
      if (typeof name !== 'string' || !(isVertex || isPlace(at))) throw wrongProperty(`handles[${i}]`, handle, ASKED);
      return `${name && `${name}: `}${isVertex ? vertex : (at as number[]).join(' ')}`;
    })
    .join(', ');
}
