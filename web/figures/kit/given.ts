/** What figures are made of, read or refused by name, as everywhere (wasm/ts/arguments.ts). */
import {
  callback,
  checkNames,
  finite,
  flag,
  list,
  object,
  optional,
  type Reader,
  refused,
  row,
  text,
} from '../../../wasm/ts/arguments.ts';

type Table = Readonly<Record<string, Reader<unknown>>>;

/** What may be left out. */
export const maybe = { text: optional(text), flag: optional(flag), number: optional(finite), callback: optional(callback) };

/** Reads each property, and keeps the object as it came. Allocates nothing where all is right. */
export function check(given: unknown, readers: Table, argument: string, remedy: string): void {
  const all = object(given, argument, remedy);
  checkNames(all, readers, argument);
  for (const key in readers) (readers[key] as Reader<unknown>)(all[key], key, all);
}

/** Each thing of a list, or of an object by its names; what is wrong is told with its place. */
function checkEach(all: object, argument: string, readers: Table, remedy: string): void {
  for (const [key, each] of Object.entries(all)) {
    const place = Array.isArray(all) ? `${argument}[${key}]` : `${argument}.${key}`;
    const given = object(each, place, remedy);
    checkNames(given, readers, place);
    for (const name in readers) (readers[name] as Reader<unknown>)(given[name], `${place}.${name}`);
  }
}

/** Things by their names. */
export const each =
  (readers: Table, remedy: string): Reader<unknown> =>
  (value, name) =>
    checkEach(object(value, name, remedy), name, readers, remedy);

export const listed =
  (readers: Table, remedy: string): Reader<unknown> =>
  (value, name) =>
    checkEach(
      list(value, name, 'objects', (thing) => thing),
      name,
      readers,
      remedy,
    );

export const anything: Reader<unknown> = (value) => value;
export const record: Reader<object> = (value, name) => object(value, name, 'Give an object.');

/** So many numbers in an array, which is used as it is: neither a vector nor rows. */
export const array =
  (length: number, remedy: string): Reader<ArrayLike<number>> =>
  (value, name) => {
    if (!Array.isArray(value) && !ArrayBuffer.isView(value)) throw refused(name, value, remedy);
    return row(value, name, length);
  };
