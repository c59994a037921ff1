/** Random choices by a seed (mulberry32), and damage to bytes and to JSON. */

const NUMBERS = [-1, 0, 1, 2, 3, 0.5, 255, 256, 65535, 65536, 2 ** 31 - 1, 2 ** 31, 2 ** 32 - 1, 2 ** 53, 1e300, -1e-300];
const VALUES = [null, true, '', 'a', '__proto__', 'constructor', [], {}, [[]], [0, 0, 0], [null], { a: 1 }];
const WORDS = [
  '0',
  '-1',
  '1e39',
  '1e400',
  'nan',
  '4294967296',
  '#',
  '\\\n',
  '\n',
  ' ',
  '/',
  '//',
  'f 1 2 3\n',
  'element vertex 99999999\n',
  'list',
  '\0',
];

export class Random {
  /** @param {number} seed */
  constructor(seed) {
    this.state = seed >>> 0;
  }

  /** @param {number} end */
  below(end) {
    this.state = (this.state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(this.state ^ (this.state >>> 15), 1 | this.state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) % end;
  }

  /** @template T @param {readonly T[]} list @returns {T} */
  pick(list) {
    return /** @type {T} */ (list[this.below(list.length)]);
  }

  /** The same JSON with one or two of its values others, gone, or there twice. @template {object} T @param {T} json @param {readonly unknown[]} [values] @returns {T} */
  damage(json, values = VALUES) {
    const copy = structuredClone(json);
    for (let edits = 1 + this.below(2); edits > 0; edits--) {
      const places = /** @type {[Record<string, unknown>, string][]} */ ([]);
      const visit = (/** @type {unknown} */ owner) => {
        if (typeof owner !== 'object' || owner === null) return;
        for (const key of Object.keys(owner)) {
          const within = /** @type {Record<string, unknown>} */ (owner);
          places.push([within, key]);
          visit(within[key]);
        }
      };
      visit(copy);
      if (places.length === 0) break;
      const [owner, key] = this.pick(places);
      const kind = this.below(5);
      if (kind === 0) delete owner[key];
      else if (kind === 1 && Array.isArray(owner)) owner.push(structuredClone(owner[Number(key)]));
      else owner[key] = kind < 4 ? this.pick(NUMBERS) : structuredClone(this.pick(values));
    }
    return copy;
  }

  /** The same bytes with a few others, gone, or there twice. @param {Uint8Array} bytes */
  bytes(bytes) {
    let out = Buffer.from(bytes);
    for (let edits = this.below(4); edits > 0 && out.length > 0; edits--) {
      const at = this.below(out.length);
      const end = Math.min(at + 1 + this.below(8), out.length);
      const kind = this.below(6);
      if (kind === 0) out[at] = this.below(256);
      else if (kind === 1) out = Buffer.concat([out.subarray(0, at), out.subarray(end)]);
      else if (kind === 2) out = Buffer.concat([out.subarray(0, end), out.subarray(at)]);
      else if (kind === 3) out = Buffer.concat([out.subarray(0, at), Buffer.from(this.pick(WORDS)), out.subarray(at)]);
      else if (kind === 4) out = Buffer.concat([out.subarray(0, at), Buffer.from(this.pick(WORDS)), out.subarray(end)]);
      else if (this.below(8) === 0) out = out.subarray(0, at);
    }
    return new Uint8Array(out);
  }
}
