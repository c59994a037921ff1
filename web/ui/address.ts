import { PageError } from './page-error.ts';

/** What pages read from what stands behind "#" in their address, and write there. */

/** Larger numbers overflow as soon as something is computed with them, and what is smaller than their inverse loses its digits. */
const LARGEST = 1e300;

/** A number that can be computed with. */
export function computable(number: number): number {
  return Math.abs(number) < 1 / LARGEST ? 0 : Math.min(Math.max(number, -LARGEST), LARGEST);
}

/** "1,2.5"; nothing where one of them is no number, or too large. */
export function numbersOf(text: string): number[] | undefined {
  const read = text.split(',').map((part) => (part.trim() === '' ? Number.NaN : Number(part)));
  return read.every((number) => Math.abs(number) <= LARGEST) ? read.map(computable) : undefined;
}

/** Makes the address say a state; with `push` a step back leads to before it. */
export function writeAddress(state: string, push = false): void {
  if (`#${state}` === location.hash) return;
  try {
    history[push ? 'pushState' : 'replaceState'](null, '', `#${state}`);
  } catch {
    // Browsers refuse it when it is done too often; the next change writes it.
  }
}

export function quoted(text: string): string {
  return `“${text.length > 40 ? `${text.slice(0, 39)}…` : text}”`;
}

/** What to say of a link of which these parts were left out; nothing where there are none. */
export function leftOut(parts: readonly string[]): PageError | undefined {
  if (parts.length === 0) return undefined;
  const more = parts.length > 4 ? `, and ${parts.length - 4} more` : '';
  return new PageError(
    'link-not-whole',
    `Left out of this link, because this page cannot show it: ${parts.slice(0, 4).join(', ')}${more}.`,
    'The rest is shown. Check that the link was copied whole.',
  );
}
