/** A glTF whose data lies anywhere and is compressed, as one that has everything inside and plain: JSON and one binary part. */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { GlbParts } from './check-glb.ts';
import { decompressMeshopt, fallbackBuffers } from './decompress-meshopt.ts';
import { inWords } from './fault.ts';
import { damaged, entriesOf, imageType, listOf, Resources } from './fetch-resources.ts';
import { type GltfJson, isObject } from './gltf-json.ts';
import { decompressed, type GltfReadOptions } from './gltf-warnings.ts';
import { verifyGltf } from './verify-gltf.ts';

/** Parts of a file, not looked into. */
interface RawParts {
  readonly json: unknown;
  readonly bin?: Uint8Array | undefined;
}

/**
 * Fetches what lies outside, decompresses it, checks the whole as `checkGltf` does, and joins it. Images that are not to be had stay
 * outside, by their names.
 *
 * Throws 'file-truncated' or 'file-unreadable' naming a buffer or image, and what `checkGltf` and `decompressMeshopt` throw.
 */
export async function plainGltf({ json: value, bin }: RawParts, options: GltfReadOptions = {}): Promise<GlbParts> {
  if (!isObject(value)) return { json: await inWords(() => verifyGltf(value)), bin };
  const resources = new Resources(options);
  const own = await fetchBuffers(value, bin, resources);
  const plain = await decompressMeshopt(value, own);
  if (plain?.bytes) options.onWarning?.(decompressed('meshopt'));
  const { json, buffers } = await fetchImages(plain?.json ?? value, plain?.bytes ? [...own, plain.bytes] : own, resources);
  const bufferLengths = buffers.map(({ length }) => length);
  const fileLength = [...new Set(buffers)].reduce((sum, { length }) => sum + length, 0);
  return join(await inWords(() => verifyGltf(json, { bufferLengths, fileLength })), buffers);
}

/** Every buffer, as long as it says or longer; one that nothing reads is empty. */
async function fetchBuffers(json: GltfJson, bin: Uint8Array | undefined, resources: Resources): Promise<Uint8Array[]> {
  const fallbacks = fallbackBuffers(json);
  const buffers: Uint8Array[] = [];
  for (const [i, { uri, byteLength }] of entriesOf(json, 'buffers')) {
    const empty = new Uint8Array();
    if (fallbacks.has(i)) buffers[i] = empty;
    else if (uri === undefined) buffers[i] = i === 0 && bin ? bin : empty;
    else buffers[i] = (await resources.get(uri, 'buffer', i))?.bytes ?? empty;
    const there = (buffers[i] as Uint8Array).length;
    if (fallbacks.has(i) || typeof byteLength !== 'number' || there >= byteLength) continue;
    const name =
      typeof uri === 'string' && !/^data:/i.test(uri) ? `"${uri.slice(0, 80)}" (buffers[${i}])` : `The data of buffers[${i}]`;
    throw new HandlebodyError('file-truncated', {
      message: `${name} is cut off: it should have ${byteLength} bytes, and ${there} are there.`,
      remedy: 'Download or export it again.',
      culprit: { kind: 'byte', index: there },
    });
  }
  // A hole is a member of the list that is no object, which checking refuses.
  return Array.from(buffers, (buffer) => buffer ?? new Uint8Array());
}

/** Images of addresses become views of buffers of their own, behind the others. */
async function fetchImages(json: GltfJson, buffers: readonly Uint8Array[], resources: Resources) {
  const all = [...buffers];
  const lists = { buffers: listOf(json, 'buffers'), bufferViews: listOf(json, 'bufferViews'), images: listOf(json, 'images') };
  const views = new Map<Uint8Array, number>();
  for (const [i, image] of entriesOf(json, 'images')) {
    if (image.uri === undefined) continue;
    const { uri, ...others } = image;
    const found = await resources.get(uri, 'image', i);
    if (!found) continue;
    const { bytes } = found;
    if (bytes.length === 0) throw damaged(`images[${i}] is empty`);
    if (!views.has(bytes)) {
      lists.bufferViews.push({ buffer: lists.buffers.length, byteLength: bytes.length });
      lists.buffers.push({ byteLength: bytes.length });
      views.set(bytes, lists.bufferViews.length - 1);
      all.push(bytes);
    }
    const mimeType = imageType(
      bytes,
      image.mimeType ?? found.mimeType ?? TYPES[/\.(\w+)$/.exec(`${uri}`)?.[1]?.toLowerCase() ?? ''],
    );
    lists.images[i] = { ...others, bufferView: views.get(bytes) as number, mimeType };
  }
  return views.size > 0 ? { json: { ...json, ...lists }, buffers: all } : { json, buffers: all };
}

/** By the ends of names, for what its bytes do not give away. */
const TYPES: Readonly<Record<string, string>> = {
  jpg: 'image/jpeg',
  jpeg: 'image/jpeg',
  webp: 'image/webp',
  avif: 'image/avif',
  ktx2: 'image/ktx2',
};

/** A sound file's buffers one behind the other, each at a multiple of 8. */
function join(json: GltfJson, buffers: readonly Uint8Array[]): GlbParts {
  if (buffers.length === 0) return { json, bin: undefined };
  // One file may be several buffers: it goes in once, as far as any of them goes.
  const ends = new Map<Uint8Array, number>();
  const lengths = ((json.buffers ?? []) as { byteLength: number }[]).map(({ byteLength }) => byteLength);
  buffers.forEach((bytes, i) => {
    ends.set(bytes, Math.max(ends.get(bytes) ?? 0, lengths[i] as number));
  });
  const starts = new Map<Uint8Array, number>();
  let length = 0;
  for (const [bytes, end] of ends) {
    starts.set(bytes, length);
    length += Math.ceil(end / 8) * 8;
  }
  if (length > MAX_BYTES) {
    throw new HandlebodyError('mesh-too-large', {
      message: `The files of the model have ${(length / 2 ** 20).toFixed(0)} MiB together, more than one GLB can hold.`,
      remedy: 'Simplify the model, or use one of its parts.',
    });
  }
  const bin = new Uint8Array(length);
  for (const [bytes, end] of ends) bin.set(bytes.subarray(0, end), starts.get(bytes));
  const views = ((json.bufferViews ?? []) as { buffer: number; byteOffset?: number }[]).map((view) => ({
    ...view,
    buffer: 0,
    byteOffset: (view.byteOffset ?? 0) + (starts.get(buffers[view.buffer] as Uint8Array) as number),
  }));
  return {
    json: { ...json, buffers: [{ byteLength: length }], ...(json.bufferViews !== undefined && { bufferViews: views }) },
    bin,
  };
}

/** What browsers and Node can hold in one piece. */
const MAX_BYTES = 2 ** 31 - 1;
