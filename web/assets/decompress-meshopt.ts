/**
 * EXT_meshopt_compression and KHR_meshopt_compression: buffer views whose bytes are a stream of meshoptimizer's. Each is replaced by a
 * plain one, so that readers need not know of it, and so that every position keeps its bits.
 */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { damaged, entriesOf, listOf } from './fetch-resources.ts';
import { asObject, type GltfJson } from './gltf-json.ts';
import { loadDecoder } from './meshopt.ts';
import { AMPLE, AMPLIFICATION } from './verify-gltf.ts';

const NAMES = ['EXT_meshopt_compression', 'KHR_meshopt_compression'];

/** Bytes that an element may have, by the modes and filters of the extension's text. */
const STRIDES: Readonly<Record<string, (stride: number) => boolean>> = {
  ATTRIBUTES: (stride) => stride % 4 === 0 && stride >= 4 && stride <= 256,
  TRIANGLES: (stride) => stride === 2 || stride === 4,
  INDICES: (stride) => stride === 2 || stride === 4,
  NONE: () => true,
  OCTAHEDRAL: (stride) => stride === 4 || stride === 8,
  QUATERNION: (stride) => stride === 8,
  EXPONENTIAL: (stride) => stride % 4 === 0,
  COLOR: (stride) => stride === 4 || stride === 8,
};

/** No stream holds more elements a byte: a vertex block of 256 takes one at least, a triangle and an index one each. */
const ELEMENTS_PER_BYTE: Readonly<Record<string, number>> = { ATTRIBUTES: 256, TRIANGLES: 3, INDICES: 1 };

interface Stream {
  readonly view: number;
  readonly bytes: Uint8Array;
  readonly count: number;
  readonly stride: number;
  readonly mode: string;
  readonly filter: string;
}

/** The extension of a buffer view or a buffer, if it has one. */
function meshoptOf(owner: GltfJson): GltfJson | undefined {
  const extensions = asObject(owner.extensions) ?? {};
  return NAMES.map((name) => asObject(extensions[name])).find((found) => found !== undefined);
}

/**
 * Buffers that only stand for what is decoded, and need not be there: no view reads from them, neither plainly nor its stream, and the
 * extension says so of the buffer, or it has no address.
 */
export function fallbackBuffers(json: GltfJson): Set<number> {
  const needed = new Set<unknown>();
  for (const [, view] of entriesOf(json, 'bufferViews')) needed.add((meshoptOf(view) ?? view).buffer);
  const free = entriesOf(json, 'buffers').filter(([i, buffer]) => {
    const marked = meshoptOf(buffer)?.fallback === true || (buffer.uri === undefined && i > 0);
    return marked && !needed.has(i);
  });
  return new Set(free.map(([i]) => i));
}

/**
 * Decodes every compressed view. Returns the JSON without the extensions, where such views lie in a buffer of their own, the last, and that
 * buffer's bytes; undefined when nothing says that it is compressed.
 *
 * Throws 'file-invalid' naming the view, 'mesh-too-large', or 'wasm-unavailable'.
 */
export async function decompressMeshopt(
  json: GltfJson,
  buffers: readonly Uint8Array[],
): Promise<{ json: GltfJson; bytes: Uint8Array | undefined } | undefined> {
  const streams = entriesOf(json, 'bufferViews').flatMap(([i, view]) => {
    const stream = meshoptOf(view);
    return stream ? [checkStream(i, view, stream, buffers)] : [];
  });
  const used = (name: string) => Array.isArray(json[name]) && (json[name] as unknown[]).some((n) => NAMES.includes(n as string));
  if (streams.length === 0 && !used('extensionsUsed') && !used('extensionsRequired')) return undefined;

  const room = streams.map(({ count, stride }) => Math.ceil((count * stride) / 8) * 8);
  const total = room.reduce((sum, length) => sum + length, 0);
  const given = buffers.reduce((sum, { length }) => sum + length, 0);
  if (total > Math.max(AMPLE, AMPLIFICATION * given)) {
    throw new HandlebodyError('mesh-too-large', {
      message: `The compressed file stands for ${(total / 2 ** 20).toFixed(0)} MiB of data, far more than its own size.`,
      remedy: 'Simplify the model, or export it without compression.',
      culprit: { kind: 'byte', index: 0 },
    });
  }
  const decoder = await loadDecoder();
  const bytes = new Uint8Array(total);
  const [views, behind] = [listOf(json, 'bufferViews'), listOf(json, 'buffers').length];
  let offset = 0;
  streams.forEach(({ view, bytes: source, count, stride, mode, filter }, k) => {
    const length = count * stride;
    try {
      decoder.decodeGltfBuffer(bytes.subarray(offset, offset + length), count, stride, source, mode, filter);
    } catch (cause) {
      throw damaged(`the compressed data of bufferViews[${view}] cannot be decoded`, cause);
    }
    const { extensions, ...plain } = views[view] as GltfJson;
    views[view] = { ...plain, ...without(extensions), buffer: behind, byteOffset: offset };
    offset += room[k] as number;
  });
  const fallbacks = fallbackBuffers(json);
  const own = listOf(json, 'buffers').map((buffer, i) => {
    const { extensions, ...plain } = asObject(buffer) ?? {};
    return asObject(buffer) ? { ...plain, ...without(extensions), ...(fallbacks.has(i) && { byteLength: 0 }) } : buffer;
  });
  const names = (list: unknown) => (Array.isArray(list) ? list.filter((name) => !NAMES.includes(name)) : list);
  return {
    json: {
      ...json,
      ...(json.extensionsUsed !== undefined && { extensionsUsed: names(json.extensionsUsed) }),
      ...(json.extensionsRequired !== undefined && { extensionsRequired: names(json.extensionsRequired) }),
      ...(streams.length > 0 && { buffers: [...own, { byteLength: total }], bufferViews: views }),
    },
    bytes: streams.length > 0 ? bytes : undefined,
  };
}

function checkStream(view: number, owner: GltfJson, stream: GltfJson, buffers: readonly Uint8Array[]): Stream {
  const fail = (what: string) => damaged(`the compressed bufferViews[${view}] ${what}`);
  const { buffer, byteOffset = 0, byteLength, byteStride: stride, count, mode, filter = 'NONE' } = stream;
  const source = isWhole(buffer) ? buffers[buffer] : undefined;
  if (!source) throw fail('names no buffer');
  if (!isWhole(byteOffset) || !isWhole(byteLength) || byteOffset + byteLength > source.length)
    throw fail('lies outside its buffer');
  if (!isWhole(count) || !isWhole(stride)) throw fail('has no count or no stride');
  const known = (name: unknown, names: readonly string[]) => typeof name === 'string' && names.includes(name);
  if (!known(mode, ['ATTRIBUTES', 'TRIANGLES', 'INDICES'])) throw fail('is of no known mode');
  if (!known(filter, ['NONE', 'OCTAHEDRAL', 'QUATERNION', 'EXPONENTIAL', 'COLOR'])) throw fail('has no known filter');
  if (filter !== 'NONE' && mode !== 'ATTRIBUTES') throw fail('filters indices');
  if (!STRIDES[mode as string]?.(stride) || !STRIDES[filter as string]?.(stride)) throw fail(`has elements of ${stride} bytes`);
  if (mode === 'TRIANGLES' && count % 3 !== 0) throw fail(`has ${count} indices, which make no whole triangles`);
  if (count > byteLength * (ELEMENTS_PER_BYTE[mode as string] as number))
    throw fail(`says ${count} elements are in ${byteLength} bytes`);
  const length = owner.byteLength;
  if (!isWhole(length) || length > count * stride) throw fail('is longer than what its stream holds');
  const bytes = source.subarray(byteOffset, byteOffset + byteLength);
  return { view, bytes, count, stride, mode: mode as string, filter: filter as string };
}

/** What other extensions say stays. */
function without(extensions: unknown): { extensions?: GltfJson } {
  const others = Object.entries(asObject(extensions) ?? {}).filter(([name]) => !NAMES.includes(name));
  return others.length > 0 ? { extensions: Object.fromEntries(others) } : {};
}

function isWhole(value: unknown): value is number {
  return Number.isSafeInteger(value) && (value as number) >= 0;
}
