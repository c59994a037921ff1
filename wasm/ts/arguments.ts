/**
 * The one door for what callers give: plain JavaScript passes what TypeScript forbids, and data that went through JSON has null for NaN. A
 * reader returns a value as the library uses it, or throws a HandlebodyError that names the argument and says what it may be.
 */
import { type CulpritKind, type ErrorCode, HandlebodyError } from './errors.ts';
import type { TypedArray } from './types.ts';

/** Reads the value of this name. `read` are the options before it, as they were read. */
export type Reader<T> = (value: unknown, name: string, read?: Readonly<Record<string, unknown>>) => T;

/** A reader for each option, and what they read. */
export type Readers<T> = { readonly [Key in keyof T]-?: Reader<unknown> };
export type Read<R> = { readonly [Key in keyof R]: R[Key] extends Reader<infer T> ? T : never };

/** How the numbers of an array are to be told when one is wrong. */
interface Rule {
  /** Of an error about one of the numbers. */
  readonly code?: ErrorCode;
  readonly kind?: CulpritKind;
  /** Numbers that one culprit has; or the culprit of them all. */
  readonly width?: number;
  readonly index?: number;
  /** The culprit's own name. */
  readonly called?: string | undefined;
  /** False where the solver itself tells which numbers may not be finite. */
  readonly finite?: boolean;
}

/** A value in a message. */
export function told(value: unknown): string {
  if (typeof value === 'string') return JSON.stringify(value.length > 40 ? `${value.slice(0, 40)}…` : value);
  if (typeof value === 'bigint') return `the BigInt ${value}`;
  if (typeof value === 'function') return 'a function';
  if (typeof value !== 'object' || value === null) return String(value);
  if (isTyped(value))
    return `${/^[AEIOU]/.test(value[Symbol.toStringTag]) ? 'an' : 'a'} ${value[Symbol.toStringTag]} of ${value.length}`;
  return Array.isArray(value) ? `an array of ${value.length}` : 'an object';
}

/** The error about a value that is missing, or not what it may be. */
export function refused(
  name: string,
  value: unknown,
  remedy: string,
  { code = 'invalid-option' as ErrorCode, kind = 'option' as CulpritKind, index = -1 } = {},
): HandlebodyError {
  const message = `The "${name}" is ${value === undefined ? 'missing' : told(value)}.`;
  const culprit = code === 'invalid-shape' && kind === 'option' ? undefined : { kind, index };
  return new HandlebodyError(code, { message, remedy, culprit });
}

/** A number that fits. */
export function number(wanted: string, fits: (value: number) => boolean, code?: ErrorCode): Reader<number> {
  return (value, name) => {
    if (typeof value === 'number' && fits(value)) return value;
    throw refused(name, value, `Give ${wanted}.`, { code });
  };
}

export const finite = number('a finite number', Number.isFinite);
export const positive = number('a positive number', (x) => x > 0 && x < Number.POSITIVE_INFINITY);
export const notNegative = number('a number from 0 on', (x) => x >= 0 && x < Number.POSITIVE_INFINITY);

export function whole(from: number, to: number, code?: ErrorCode): Reader<number> {
  return number(`a whole number from ${from} to ${to}`, (x) => Number.isInteger(x) && x >= from && x <= to, code);
}

export const flag: Reader<boolean> = (value, name) => {
  if (typeof value === 'boolean') return value;
  throw refused(name, value, 'Give true or false.');
};

export const text: Reader<string> = (value, name) => {
  if (typeof value === 'string') return value;
  throw refused(name, value, 'Give a string.');
};

// biome-ignore lint/suspicious/noExplicitAny: what it takes and returns is for its caller to say.
export const callback: Reader<(...given: any[]) => any> = (value, name) => {
  // biome-ignore lint/suspicious/noExplicitAny: as above.
  if (typeof value === 'function') return value as (...given: any[]) => any;
  throw refused(name, value, 'Give a function.');
};

/** An AbortSignal, of this page or of another. */
export const signal: Reader<AbortSignal> = (value, name) => {
  if (typeof (value as AbortSignal | null)?.aborted === 'boolean') return value as AbortSignal;
  throw refused(name, value, "Give an AbortController's signal.");
};

/** One of these names; `or` reads what else it may be, `wanted`. */
export function named<const Name extends string>(names: readonly Name[]): Reader<Name>;
export function named<const Name extends string, T>(names: readonly Name[], or: Reader<T>, wanted: string): Reader<Name | T>;
export function named(names: readonly string[], or?: Reader<unknown>, wanted?: string): Reader<unknown> {
  return (value, name, read) => {
    if (names.includes(value as string)) return value;
    if (or && (typeof value === 'number' || typeof value === 'function' || (typeof value === 'object' && value !== null)))
      return or(value, name, read);
    throw refused(name, value, `${suggestion(value, names)}Use ${[...(wanted ? [wanted] : []), ...names.map(told)].join(', ')}.`);
  };
}

/** What may be left out. */
export function optional<T>(reader: Reader<T>): Reader<T | undefined> {
  return (value, name, read) => (value === undefined ? undefined : reader(value, name, read));
}

/** Anything that has properties. */
export function object(value: unknown, name: string, remedy: string): Readonly<Record<string, unknown>> {
  if (typeof value === 'object' && value !== null && !Array.isArray(value) && !ArrayBuffer.isView(value))
    return value as Readonly<Record<string, unknown>>;
  throw refused(name, value, remedy);
}

/**
 * The options that a caller gave, with `defaults` where one is undefined. Misspelt ones are refused: they would count for nothing. What is no
 * name like those of the readers' is left alone, as it comes with objects that say more than is read here.
 */
export function options<R extends Readonly<Record<string, Reader<unknown>>>>(
  given: unknown,
  readers: R,
  defaults: Partial<Read<R>> = {},
  argument = 'options',
): Read<R> {
  const all = object(given, argument, 'Give an object of options.');
  checkNames(all, readers, argument);
  const read: Record<string, unknown> = {};
  for (const key in readers) {
    const value = all[key];
    const inPlace = value === undefined ? defaults[key] : undefined;
    read[key] = inPlace ?? (readers[key] as Reader<unknown>)(value, key, read);
  }
  return read as Read<R>;
}

/** Refuses names that are nearly those of readers. Allocates nothing where there are none. */
export function checkNames(all: object, readers: object, argument: string): void {
  for (const key in all) {
    if (Object.hasOwn(readers, key) || all[key as keyof typeof all] === undefined) continue;
    const remedy = suggestion(key, Object.keys(readers));
    if (!remedy) continue;
    throw new HandlebodyError('invalid-option', {
      message: `The "${argument}" has no "${key}".`,
      remedy,
      culprit: { kind: 'option', index: -1 },
    });
  }
}

/** The name nearest to what was written, where one is near. */
function suggestion(written: unknown, names: readonly string[]): string {
  if (typeof written !== 'string' || written.length > 40) return '';
  const word = written.toLowerCase();
  let nearest = '';
  let least = 1 + word.length / 4;
  for (const name of names) {
    const far = editDistance(word, name.toLowerCase());
    if (far < least) [nearest, least] = [name, far];
  }
  return nearest && `Did you mean "${nearest}"? `;
}

/** Letters to change, add or leave out to make one word of another. */
function editDistance(a: string, b: string): number {
  let row = Array.from({ length: b.length + 1 }, (_, j) => j);
  for (let i = 1; i <= a.length; i++) {
    const next = [i];
    for (let j = 1; j <= b.length; j++) {
      const changed = (row[j - 1] as number) + (a[i - 1] === b[j - 1] ? 0 : 1);
      next.push(Math.min(changed, (row[j] as number) + 1, (next[j - 1] as number) + 1));
    }
    row = next;
  }
  return row[b.length] as number;
}

/** Whether it is an array of numbers by its type: neither a DataView nor one of BigInts. */
function isTyped(value: unknown): value is TypedArray {
  return ArrayBuffer.isView(value) && !/^(Big|Data)/.test((value as TypedArray)[Symbol.toStringTag]);
}

/** An array of numbers, checked, or undefined where the value is of another kind. What three.js calls an attribute or a vector is read too. */
function asList(value: unknown): ArrayLike<unknown> | undefined {
  if (isTyped(value) || Array.isArray(value)) return value;
  if (typeof value !== 'object' || value === null || ArrayBuffer.isView(value)) return undefined;
  const { count, itemSize, getComponent, x, y, z, w, length } = value as Partial<Attribute & Record<string, unknown>>;
  if (getComponent && count !== undefined && itemSize !== undefined)
    return Float64Array.from({ length: count * itemSize }, (_, i) =>
      (value as Attribute).getComponent(Math.floor(i / itemSize), i % itemSize),
    );
  if (x !== undefined) return w !== undefined ? [x, y, z, w] : z !== undefined ? [x, y, z] : [x, y];
  return Number.isInteger(length) && (length as number) >= 0 ? (value as ArrayLike<unknown>) : undefined;
}

/** What is read of three.js' BufferAttribute. */
export interface Attribute {
  readonly count: number;
  readonly itemSize: number;
  getComponent(index: number, component: number): number;
}

/** What is read of three.js' vectors and quaternions. */
export type Vector = { readonly x: number; readonly y: number } & { readonly z?: number; readonly w?: number };

/** Numbers as they may be given: in one array, row-major; in rows; as an attribute of three.js, or one vector. */
export type Numbers = ArrayLike<number> | ArrayLike<ArrayLike<number> | Vector> | Attribute | Vector;

/** Numbers in one array: the one that was given, or a new one where it came in rows or as an object of three.js. */
export function numbers(value: unknown, name: string, rule: Rule = {}): ArrayLike<number> {
  const list = asList(value);
  if (!list) throw refused(name, value, 'Give an array of numbers.', { code: 'invalid-shape' });
  if (list.length === 0 && isTyped(list)) checkThere(list, name);
  if (typeof list[0] === 'object' && list[0] !== null) return flatten(list, name, rule);
  const { finite = true } = rule;
  if (finite || !isTyped(list))
    for (let i = 0; i < list.length; i++) {
      const x = list[i];
      if (typeof x !== 'number' || (finite && !Number.isFinite(x)))
        throw notNumber(`${name}[${i}]`, x, i / (rule.width ?? 1), rule);
    }
  return list as ArrayLike<number>;
}

/** An array whose memory went to another thread says that it is empty, and cannot even be read as that. */
function checkThere({ buffer }: TypedArray, name: string): void {
  try {
    new Uint8Array(buffer);
  } catch (cause) {
    throw new HandlebodyError('invalid-shape', {
      message: `The memory of "${name}" was handed to another thread.`,
      remedy: 'Give a copy, made before it is handed over.',
      cause,
    });
  }
}

/** Rows of equal length as one array. */
function flatten(rows: ArrayLike<unknown>, name: string, rule: Rule): Float64Array {
  const width = asList(rows[0])?.length ?? 0;
  const flat = new Float64Array(rows.length * width);
  for (let i = 0; i < rows.length; i++) {
    const row = asList(rows[i]);
    if (row?.length !== width) {
      throw new HandlebodyError('invalid-shape', {
        message: `The "${name}[${i}]" is ${row ? `a row of ${row.length}` : told(rows[i])}.`,
        remedy: `Give rows of equal length, ${width} numbers each as in the first, or all numbers in one array.`,
        culprit: rule.kind && { kind: rule.kind, index: rule.index ?? i },
      });
    }
    for (let j = 0; j < width; j++) {
      const x = row[j];
      if (typeof x !== 'number' || (rule.finite !== false && !Number.isFinite(x)))
        throw notNumber(`${name}[${i}][${j}]`, x, i, rule);
      flat[i * width + j] = x;
    }
  }
  return flat;
}

/** The error about one of an array's numbers. */
export function notNumber(place: string, value: unknown, at: number, rule: Rule): HandlebodyError {
  const { code = 'invalid-shape', kind, index = Math.floor(at), called } = rule;
  const which = kind ? ` (${kind} ${index}${called === undefined ? '' : `, ${told(called)}`})` : '';
  return new HandlebodyError(code, {
    message: `The "${place}"${which} is ${told(value)}.`,
    remedy: 'Give finite numbers only: JSON makes null of those that are none.',
    culprit: kind && { kind, index },
  });
}

/** One place, or another row of so many numbers. */
export function row(value: unknown, name: string, length: number, rule: Rule = {}): ArrayLike<number> {
  const list = numbers(value, name, rule);
  if (list.length === length) return list;
  throw new HandlebodyError('invalid-shape', {
    message: `The "${name}"${rule.called === undefined ? '' : ` of ${told(rule.called)}`} has ${list.length} numbers instead of ${length}.`,
    remedy: `Give ${length}.`,
    culprit: rule.kind && { kind: rule.kind, index: rule.index ?? -1 },
  });
}

/** A list of things that are read one by one. */
export function list<T>(
  value: unknown,
  name: string,
  wanted: string,
  read: (value: unknown, name: string, index: number) => T,
): T[] {
  if (!Array.isArray(value)) throw refused(name, value, `Give an array of ${wanted}.`);
  return Array.from(value, (each, index) => read(each, `${name}[${index}]`, index));
}

/** Numbers of vertices, and of whatever else is counted from 0: whole, and below `count` where that is told. */
export function indices(value: unknown, name: string, rule: Rule = {}, count = 2 ** 32): ArrayLike<number> {
  const list = numbers(value, name, { ...rule, finite: false });
  // What an array cannot hold need not be looked for.
  if (isTyped(list) && list[Symbol.toStringTag].startsWith('U') && 2 ** (8 * list.BYTES_PER_ELEMENT) <= count) return list;
  for (let i = 0; i < list.length; i++) {
    const x = list[i] as number;
    if (x >= 0 && x < count && Number.isInteger(x)) continue;
    throw notIndex(`${name}[${i}]`, x, i / (rule.width ?? 1), rule, count);
  }
  return list;
}

function notIndex(place: string, value: number, at: number, rule: Rule, count: number): HandlebodyError {
  const error = notNumber(place, value, at, { code: 'mesh-index-out-of-range', ...rule });
  const range = count < 2 ** 32 ? `0 to ${count - 1}` : '0 on';
  return new HandlebodyError(error.code, {
    message: error.message,
    remedy: `Use whole numbers from ${range}.`,
    culprit: error.culprit,
  });
}

/** Checks the place for `length` results: whole numbers would cut them off. */
export function checkRoom(room: unknown, name: string, length: number): void {
  if (isTyped(room) && room.length === length && room[Symbol.toStringTag].startsWith('Float')) return;
  throw refused(name, room, `Give a Float32Array or a Float64Array of ${length} numbers.`, { code: 'invalid-shape' });
}
