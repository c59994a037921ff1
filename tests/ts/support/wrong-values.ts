/** Things that programs pass by mistake, by what kind of argument would take them. */
export type Kind =
  | 'number'
  | 'name'
  | 'string'
  | 'boolean'
  | 'undefined'
  | 'null'
  | 'any'
  | 'function'
  | 'list'
  | 'object'
  | 'none';

interface Wrong {
  readonly told: string;
  readonly kind: Kind;
  readonly value: unknown;
}

const wrong = (kind: Kind, told: string, value: unknown): Wrong => ({ kind, told, value });

/** `none`: nothing takes these. An array is no object of options, and an object no list. */
export const WRONG: readonly Wrong[] = [
  wrong('null', 'null', null),
  wrong('undefined', 'undefined', undefined),
  wrong('number', '3', 3),
  wrong('number', '0', 0),
  wrong('number', '-1', -1),
  wrong('number', 'NaN', Number.NaN),
  wrong('number', 'Infinity', Number.POSITIVE_INFINITY),
  wrong('string', '"auto?"', 'auto?'),
  wrong('string', '"7"', '7'),
  wrong('string', '""', ''),
  wrong('string', 'a long text', 'x'.repeat(1000)),
  wrong('boolean', 'true', true),
  wrong('boolean', 'false', false),
  wrong('none', '1n', 1n),
  wrong('none', 'a symbol', Symbol('s')),
  wrong('function', 'a function', () => undefined),
  wrong('function', 'a class', class {}),
  wrong('list', '[null]', [null]),
  wrong('list', '["a"]', ['a']),
  wrong('list', '[undefined]', [undefined]),
  wrong('list', '[1n]', [1n]),
  wrong('none', '-1n', -1n),
  wrong('none', '2n ** 80n', 2n ** 80n),
  wrong('none', '0n', 0n),
  wrong('none', 'Symbol.iterator', Symbol.iterator),
  wrong('none', 'a symbol of all', Symbol.for('all')),
  wrong('none', 'an empty DataView', new DataView(new ArrayBuffer(0))),
  wrong('none', 'a BigInt64Array', new BigInt64Array(3)),
  wrong('none', 'a BigUint64Array', new BigUint64Array(1)),
  wrong('none', 'an empty BigInt64Array', new BigInt64Array()),
  wrong('none', 'a DataView', new DataView(new ArrayBuffer(24))),
  wrong('object', '{}', {}),
  wrong('object', '{ a: 1 }', { a: 1 }),
  wrong('object', 'an object without a prototype', Object.create(null)),
  wrong('object', 'a Date', new Date(0)),
  wrong('object', 'a Map', new Map([[0, 1]])),
  wrong('object', 'a RegExp', /a/),
  wrong('object', 'a promise', Promise.resolve(1)),
];
