// A wasm module that does nothing but read memory once, sixteen bytes an instruction: what a deformation is compared with. Written byte by
// byte, since what is compared must have the same instructions at hand, and JavaScript has no vectors.

const [I32, F32, V128] = [0x7f, 0x7d, 0x7b];
const LANES = 8;

/** @param {number} n */
const unsigned = (n) => {
  const bytes = [];
  for (let rest = n; ; rest >>>= 7) {
    bytes.push(rest > 127 ? (rest & 127) | 128 : rest);
    if (rest <= 127) return bytes;
  }
};
/** @param {number[][]} items */
const vector = (...items) => [...unsigned(items.length), ...items.flat()];
/** @param {number} id @param {number[]} content */
const section = (id, content) => [id, ...unsigned(content.length), ...content];
/** @param {string} text */
const name = (text) => [...unsigned(text.length), ...Buffer.from(text)];

const get = (/** @type {number} */ local) => [0x20, local];
const set = (/** @type {number} */ local) => [0x21, local];
const load = (/** @type {number} */ offset) => [0xfd, 0x00, 4, ...unsigned(offset)];
const add = [0xfd, 0xe4, 0x01]; // f32x4.add
const sums = Array.from({ length: LANES }, (_, lane) => 2 + lane);

/** (from, to) → a number that depends on all that lies between; `to − from` a multiple of 128. Eight sums, so that none waits for another. */
const body = [
  ...vector([LANES, V128]),
  ...[0x03, 0x40], // loop
  ...sums.flatMap((local, lane) => [...get(local), ...get(0), ...load(16 * lane), ...add, ...set(local)]),
  ...[...get(0), 0x41, ...[0x80, 0x01], 0x6a, 0x22, 0], // from += 128
  ...[...get(1), 0x49, 0x0d, 0, 0x0b], // again while from < to
  ...get(2),
  ...sums.slice(1).flatMap((local) => [...get(local), ...add]),
  ...[0xfd, 0x1f, 0, 0x0b], // f32x4.extract_lane 0
];

const MODULE = Uint8Array.from([
  ...[0, 0x61, 0x73, 0x6d, 1, 0, 0, 0],
  ...section(1, vector([0x60, ...vector([I32], [I32]), ...vector([F32])])),
  ...section(2, vector([...name('e'), ...name('memory'), 2, 0, 1])),
  ...section(3, vector([0])),
  ...section(7, vector([...name('read'), 0, 0])),
  ...section(10, vector([...unsigned(body.length), ...body])),
]);

/** A function that reads that many floats once, all 1, and what it returns then. @param {number} floats @returns {{ read: () => number, expected: number }} */
export function reader(floats) {
  const bytes = Math.ceil(floats / 32) * 128;
  const memory = new WebAssembly.Memory({ initial: Math.ceil(bytes / 65_536) });
  new Float32Array(memory.buffer, 0, bytes / 4).fill(1);
  const { exports } = new WebAssembly.Instance(new WebAssembly.Module(MODULE), { e: { memory } });
  const read = /** @type {(from: number, to: number) => number} */ (exports.read);
  return { read: () => read(0, bytes), expected: bytes / 16 };
}
