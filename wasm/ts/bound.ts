/**
 * Ties an object's methods and accessors to it, so that they find their private fields also where a framework's proxy stands for the object
 * (Vue's ref, Valtio, `new Proxy(hb, {})`): private fields cannot be reached through a proxy. They stay out of sight, as those of the class are.
 */
export function bound<T extends object>(object: T): T {
  for (const [key, { get, value }] of members(Object.getPrototypeOf(object)))
    Object.defineProperty(
      object,
      key,
      get ? { get: get.bind(object), configurable: true } : { value: value.bind(object), configurable: true },
    );
  return object;
}

const known = new WeakMap<object, (readonly [PropertyKey, PropertyDescriptor])[]>();

/** Methods and accessors of a class and of those that it extends. */
function members(prototype: object): readonly (readonly [PropertyKey, PropertyDescriptor])[] {
  const found = known.get(prototype);
  if (found) return found;
  const all = new Map<PropertyKey, PropertyDescriptor>();
  for (let at = prototype; at !== Object.prototype; at = Object.getPrototypeOf(at))
    for (const key of Reflect.ownKeys(at))
      if (key !== 'constructor' && !all.has(key)) all.set(key, Object.getOwnPropertyDescriptor(at, key) as PropertyDescriptor);
  const list = [...all];
  known.set(prototype, list);
  return list;
}
