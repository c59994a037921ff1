import { HandlebodyError } from './errors.ts';

/** Leads to the object itself. A function, since frameworks hand out objects behind further proxies, but not functions. */
const RAW = Symbol('the object itself');

interface Tied {
  readonly [RAW]?: () => object;
}

/**
 * Makes an object's methods and accessors find their private fields also where a framework's proxy stands for the object (Vue's ref, Valtio,
 * `new Proxy(hb, {})`): private fields cannot be reached through a proxy. A class is prepared once, an object gets one property.
 */
export function bound<T extends object>(object: T): T {
  for (let at = Object.getPrototypeOf(object); at !== Object.prototype && !prepared.has(at); at = Object.getPrototypeOf(at))
    prepare(at);
  return Object.defineProperty(object, RAW, { value: () => object, configurable: true });
}

const prepared = new WeakSet<object>();

/** Methods and accessors of a class are called on the object itself from now on. */
function prepare(prototype: object): void {
  prepared.add(prototype);
  for (const key of Reflect.ownKeys(prototype)) {
    if (key === 'constructor') continue;
    const { get, set, value, ...rest } = Object.getOwnPropertyDescriptor(prototype, key) as PropertyDescriptor;
    const name = String(key);
    if (get) Object.defineProperty(prototype, key, { ...rest, get: onRaw(get, name), ...(set && { set: onRaw(set, name) }) });
    else if (typeof value === 'function') Object.defineProperty(prototype, key, { ...rest, value: onRaw(value, name) });
  }
}

function onRaw<A extends unknown[], R>(method: (...given: A) => R, name: string): (this: Tied, ...given: A) => R {
  const wrapped = function (this: Tied | undefined, ...given: A): R {
    if (this === undefined)
      throw new HandlebodyError('invalid-option', {
        message: `"${name}" was called without its object.`,
        remedy: `Call it as object.${name}(…), or hand on () => object.${name}(…).`,
      });
    return method.apply(this[RAW]?.() ?? this, given);
  };
  return Object.defineProperties(wrapped, { name: { value: name }, length: { value: method.length } });
}
