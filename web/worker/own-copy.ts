import { copied } from '../../wasm/ts/copied.ts';

/**
 * A copy of what goes to a worker, made when the caller asks: a worker takes its time to start, and the caller's arrays may change or be handed to
 * another thread meanwhile. Functions and objects with a class of their own are not expected.
 */
export function ownCopy<T>(value: T): T {
  if (ArrayBuffer.isView(value)) return copied(value as unknown as Float64Array) as unknown as T;
  if (Array.isArray(value)) return value.map(ownCopy) as unknown as T;
  if (typeof value !== 'object' || value === null) return value;
  return Object.fromEntries(Object.entries(value).map(([name, part]) => [name, ownCopy(part)])) as T;
}

/** The typed arrays among an object's properties, each memory once. */
export function arraysOf(of: object): ArrayBufferView[] {
  const arrays = Object.values(of).filter((value) => ArrayBuffer.isView(value) && value.byteLength > 0) as ArrayBufferView[];
  return arrays.filter(({ buffer }, i) => arrays.findIndex((other) => other.buffer === buffer) === i);
}
