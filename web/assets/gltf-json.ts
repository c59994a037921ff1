/** An object of a glTF's JSON, of which nothing is known yet. */
export type GltfJson = Record<string, unknown>;

/** Asks that the number at `path` be a whole one from 0 to below `end`, and returns it. */
export type CheckIndex = (value: unknown, end: number, path: string) => number;

export function isObject(value: unknown): value is GltfJson {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

export function asObject(value: unknown): GltfJson | undefined {
  return isObject(value) ? value : undefined;
}

export function isNumber(value: unknown): value is number {
  return typeof value === 'number' && Number.isFinite(value);
}

/** A value as a message shows it, cut short. Lists and objects are not: they may be nested deeper than can be written. */
export function show(value: unknown): string {
  if (Array.isArray(value)) return `a list of ${value.length}`;
  return isObject(value) ? 'an object' : `${JSON.stringify(value)}`.slice(0, 40);
}

/** Deeper trees overflow the stack of readers that recurse; real ones have some tens of levels. */
export const MAX_DEPTH = 512;

/** Whether objects and lists lie in each other deeper than that: then no reader or writer goes through them. */
export function isDeep(value: unknown, depth = 0): boolean {
  if (typeof value !== 'object' || value === null) return false;
  if (depth > MAX_DEPTH) return true;
  for (const member of Array.isArray(value) ? value : Object.values(value)) if (isDeep(member, depth + 1)) return true;
  return false;
}

/** The same of a JSON that is text still: parsing one that nests to no end takes a hundred times as long, and its memory. */
export function isDeepText(text: string): boolean {
  let depth = 0;
  for (let i = 0; i < text.length; i++) {
    const letter = text[i];
    if (letter === '"') {
      do i = text.indexOf('"', i + 1);
      while (i > 0 && isEscaped(text, i));
      if (i < 0) return false;
    } else if (letter === '[' || letter === '{') {
      if (depth++ > MAX_DEPTH) return true;
    } else if (letter === ']' || letter === '}') depth--;
  }
  return false;
}

/** Whether an odd number of backslashes stands before it. */
function isEscaped(text: string, at: number): boolean {
  let from = at;
  while (text[from - 1] === '\\') from--;
  return (at - from) % 2 === 1;
}
