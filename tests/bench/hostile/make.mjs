/** What hostile files are made of. */

/** @typedef {{ reader: string, make: (bytes: number) => Uint8Array }} Kind */

const encoder = new TextEncoder();
export const text = (/** @type {string} */ value) => encoder.encode(value);
export const repeat = (/** @type {string} */ unit, /** @type {number} */ bytes) =>
  unit.repeat(Math.max(Math.floor(bytes / unit.length), 1));
/** @template T @param {number} n @param {(i: number) => T} make */
export const list = (n, make) => Array.from({ length: Math.max(Math.floor(n), 1) }, (_, i) => make(i));

/** @param {object} json @param {Uint8Array} [bin] */
export function glb(json, bin) {
  const head = text(JSON.stringify({ asset: { version: '2.0' }, ...json }));
  const headRoom = Math.ceil(head.length / 4) * 4;
  const binRoom = Math.ceil((bin?.length ?? 0) / 4) * 4;
  const out = new Uint8Array(20 + headRoom + (bin ? 8 + binRoom : 0));
  const view = new DataView(out.buffer);
  [0x46546c67, 2, out.length, headRoom, 0x4e4f534a].forEach((word, i) => {
    view.setUint32(4 * i, word, true);
  });
  out.fill(32, 20, 20 + headRoom).set(head, 20);
  if (bin) {
    view.setUint32(20 + headRoom, binRoom, true);
    view.setUint32(24 + headRoom, 0x004e4942, true);
    out.set(bin, 28 + headRoom);
  }
  return out;
}

/** One triangle, and what is added to it. @param {object} more @param {number} [vertices] */
export function triangle(more, vertices = 3) {
  const positions = Float32Array.from({ length: 3 * vertices }, (_, i) => ((i * 7) % 11) + i / 1e3);
  const bin = new Uint8Array(positions.buffer);
  return glb(
    {
      buffers: [{ byteLength: bin.length }],
      bufferViews: [{ buffer: 0, byteLength: bin.length }],
      accessors: [{ bufferView: 0, componentType: 5126, type: 'VEC3', count: vertices }],
      meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
      nodes: [{ mesh: 0 }],
      scenes: [{ nodes: [0] }],
      scene: 0,
      ...more,
    },
    bin,
  );
}

export const nested = (/** @type {number} */ levels) => `${'['.repeat(levels)}${']'.repeat(levels)}`;
/** A GLB with another text in its JSON: of lists in lists that no object is written as. @param {Uint8Array} file @param {string} from @param {string} to */
export function withText(file, from, to) {
  const view = new DataView(file.buffer);
  const length = view.getUint32(12, true);
  const json = new TextDecoder().decode(file.subarray(20, 20 + length)).replace(from, () => to);
  const bin = file.subarray(20 + length);
  const head = text(json.padEnd(Math.ceil(json.length / 4) * 4));
  const out = new Uint8Array(20 + head.length + bin.length);
  out.set(file.subarray(0, 20));
  out.set(head, 20);
  out.set(bin, 20 + head.length);
  new DataView(out.buffer).setUint32(8, out.length, true);
  new DataView(out.buffer).setUint32(12, head.length, true);
  return out;
}

/** Nodes, each below the one before it, in chains of so many. @param {number} n @param {number} first @param {number} [length] */
export const chains = (n, first, length = 400) =>
  list(n, (i) => (i % length === length - 1 || i === Math.floor(n) - 1 ? {} : { children: [i + first] }));

/** @param {object} more */
export function skinned(more) {
  const bin = new Uint8Array(36 + 12 + 48);
  new Float32Array(bin.buffer, 0, 9).set([0, 0, 0, 1, 0, 0, 0, 1, 0]);
  new Float32Array(bin.buffer, 48, 12).fill(0.25);
  const accessors = [
    { bufferView: 0, componentType: 5126, type: 'VEC3', count: 3 },
    { bufferView: 1, componentType: 5121, type: 'VEC4', count: 3 },
    { bufferView: 2, componentType: 5126, type: 'VEC4', count: 3 },
  ];
  const bufferViews = [
    [0, 36],
    [36, 12],
    [48, 48],
  ].map(([byteOffset, byteLength]) => ({ buffer: 0, byteOffset, byteLength }));
  return glb(
    {
      buffers: [{ byteLength: bin.length }],
      bufferViews,
      accessors,
      meshes: [{ primitives: [{ attributes: { POSITION: 0, JOINTS_0: 1, WEIGHTS_0: 2 } }] }],
      ...more,
    },
    bin,
  );
}

/** What a body says, without its arrays. @param {object} more */
export function body(more) {
  return {
    version: 1,
    distance: 'fast-marching',
    positionsHash: '0123456789abcdef',
    arraysHash: '0123456789abcdef',
    normalization: { center: [0, 0, 0], diagonal: 1 },
    grid: { origin: [0, 0, 0], spacing: 1, dimensions: [1, 1, 1] },
    distanceScale: 1,
    ...more,
  };
}
