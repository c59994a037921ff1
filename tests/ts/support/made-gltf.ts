/**
 * Made glTF files: the same numbers stored in the many ways that the format has. What a reader gives is known, since it went in.
 */
import { MeshoptEncoder } from 'meshoptimizer/encoder';
import { random } from './scattered.ts';

type Numbers = Float32Array | Uint8Array | Int8Array | Uint16Array | Int16Array | Uint32Array;

/** Numbers as a file has them. */
export interface MadeAccessor {
  readonly array: Numbers;
  readonly type: 'SCALAR' | 'VEC2' | 'VEC3' | 'VEC4' | 'MAT4';
  readonly normalized?: boolean;
}

export interface MadePrimitive {
  readonly mode: 0 | 4 | 5 | 6;
  readonly attributes: Readonly<Record<string, MadeAccessor>>;
  readonly indices?: MadeAccessor;
  readonly targets?: readonly Readonly<Record<string, MadeAccessor>>[];
}

/** Meshes by their primitives, nodes as in the JSON; `accessors` are what skins and the like use besides. */
export interface MadeModel {
  readonly meshes: readonly { readonly primitives: readonly MadePrimitive[]; readonly weights?: readonly number[] }[];
  readonly nodes: readonly object[];
  readonly roots: readonly number[];
  readonly skins?: readonly { readonly joints: readonly number[]; readonly inverseBindMatrices: MadeAccessor }[];
}

const COMPONENT = new Map<unknown, number>([
  [Int8Array, 5120],
  [Uint8Array, 5121],
  [Int16Array, 5122],
  [Uint16Array, 5123],
  [Uint32Array, 5125],
  [Float32Array, 5126],
]);
const SIZES = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };

/** How an accessor's numbers lie in the file. */
export const STORAGES = ['packed', 'interleaved', 'sparse', 'sparse-on-zeros', 'meshopt', 'meshopt-khr'] as const;
type Storage = (typeof STORAGES)[number];

/** Where the buffers lie. */
export const PLACES = ['glb', 'base64', 'percent', 'beside', 'mixed'] as const;
type Place = (typeof PLACES)[number];

export interface MadeFile {
  /** A GLB, or the text of a .gltf. */
  readonly bytes: Uint8Array;
  readonly isGlb: boolean;
  /** By their names, as on a disk. */
  readonly beside: ReadonlyMap<string, Uint8Array>;
}

interface Store {
  readonly seed: number;
  readonly storage: Storage;
  readonly place: Place;
}

const bytesOf = (array: Numbers) => new Uint8Array(array.buffer, array.byteOffset, array.byteLength).slice();

/** Stores a model in one way of the many. The same seed gives the same bytes. `MeshoptEncoder.ready` is awaited before. */
export function store(model: MadeModel, { seed, storage, place }: Store): MadeFile {
  const { number } = random(seed);
  const chance = (part: number) => (number() + 1) / 2 < part;
  const chunks: Uint8Array[][] = [[], ...(place === 'glb' ? [] : [[]])];
  const views: Record<string, unknown>[] = [];
  const accessors: Record<string, unknown>[] = [];
  const lengthOf = (buffer: number) => (chunks[buffer] as Uint8Array[]).reduce((sum, { length }) => sum + length, 0);
  const put = (bytes: Uint8Array): { buffer: number; byteOffset: number; byteLength: number } => {
    const buffer = chance(0.5) ? 0 : chunks.length - 1;
    // Junk before, so that an offset that is dropped shows.
    const junk = 8 - (lengthOf(buffer) % 8) + (chance(0.3) ? 16 : 0);
    chunks[buffer]?.push(new Uint8Array(junk).fill(0xa5));
    const byteOffset = lengthOf(buffer);
    chunks[buffer]?.push(bytes);
    return { buffer, byteOffset, byteLength: bytes.length };
  };
  const view = (bytes: Uint8Array, more: object = {}) => views.push({ ...put(bytes), ...more }) - 1;

  const used = new Map<MadeAccessor, number>();
  const accessor = (given: MadeAccessor, what: 'indices' | 'attribute' | 'other'): number => {
    const known = used.get(given);
    if (known !== undefined) return known;
    const { array, type, normalized } = given;
    const [components, componentType] = [SIZES[type], COMPONENT.get(array.constructor) as number];
    const [count, size] = [array.length / components, components * array.BYTES_PER_ELEMENT];
    const base = { componentType, type, count, ...(normalized && { normalized }), ...boundsOf(given) };
    const bytes = bytesOf(array);
    const stride = Math.ceil(size / 4) * 4;
    const spread = (step: number, filler = 0) => {
      const out = new Uint8Array(count * step).fill(filler);
      for (let i = 0; i < count; i++) out.set(bytes.subarray(i * size, (i + 1) * size), i * step);
      return out;
    };
    const add = (json: object) => {
      used.set(given, accessors.push({ ...base, ...json }) - 1);
      return used.get(given) as number;
    };
    if (what === 'attribute' && storage === 'interleaved') {
      // Among other numbers, which are junk here.
      const lead = chance(0.5) ? 4 : 0;
      const rows = spread(stride + 8, 0x77);
      const shifted = new Uint8Array(rows.length + lead);
      shifted.set(rows, lead);
      return add({ bufferView: view(shifted, { byteStride: stride + 8 }), ...(lead && { byteOffset: lead }) });
    }
    if (what === 'attribute' && storage.startsWith('sparse')) {
      // three.js takes the padding of rows for numbers where an accessor is sparse.
      const onZeros = storage === 'sparse-on-zeros' || stride !== size;
      const replaced = Array.from({ length: count }, (_, i) => i).filter(() => onZeros || chance(0.4));
      const Index = count <= 256 ? Uint8Array : count <= 65536 ? Uint16Array : Uint32Array;
      const lead = chance(0.5) ? 8 : 0;
      const values = new Uint8Array(replaced.length * size);
      const old = spread(stride);
      replaced.forEach((i, k) => {
        values.set(bytes.subarray(i * size, (i + 1) * size), k * size);
        old.fill(0x33, i * stride, i * stride + size);
      });
      if (replaced.length === 0) return add({ bufferView: view(spread(stride), { byteStride: stride }) });
      return add({
        ...(!onZeros && { bufferView: view(joined([new Uint8Array(lead), old])), ...(lead && { byteOffset: lead }) }),
        sparse: {
          count: replaced.length,
          indices: { bufferView: view(bytesOf(Index.from(replaced))), componentType: COMPONENT.get(Index) },
          values: { bufferView: view(values) },
        },
      });
    }
    if (storage.startsWith('meshopt') && !(what === 'indices' && size === 1)) {
      const mode = what === 'indices' ? 'INDICES' : 'ATTRIBUTES';
      const element = what === 'indices' ? size : stride;
      const stream = MeshoptEncoder.encodeGltfBuffer(what === 'indices' ? bytes : spread(stride), count, element, mode);
      const name = storage === 'meshopt' ? 'EXT_meshopt_compression' : 'KHR_meshopt_compression';
      const plain = {
        buffer: FALLBACK,
        byteOffset: 0,
        byteLength: count * element,
        ...(mode === 'ATTRIBUTES' && { byteStride: element }),
      };
      const extension = { ...put(stream), byteStride: element, count, mode, ...(chance(0.5) && { filter: 'NONE' }) };
      return add({ bufferView: views.push({ ...plain, extensions: { [name]: extension } }) - 1 });
    }
    if (what === 'attribute') return add({ bufferView: view(spread(stride), { byteStride: stride }) });
    return add({ bufferView: view(bytes) });
  };

  const attributesOf = (attributes: Readonly<Record<string, MadeAccessor>>) =>
    Object.fromEntries(Object.entries(attributes).map(([name, each]) => [name, accessor(each, 'attribute')]));
  const meshes = model.meshes.map(({ primitives, weights }) => ({
    ...(weights && { weights }),
    primitives: primitives.map(({ mode, attributes, indices, targets }) => ({
      mode,
      attributes: attributesOf(attributes),
      ...(indices && { indices: accessor(indices, 'indices') }),
      ...(targets && { targets: targets.map(attributesOf) }),
    })),
  }));
  const skins = model.skins?.map(({ joints, inverseBindMatrices }) => ({
    joints,
    inverseBindMatrices: accessor(inverseBindMatrices, 'other'),
  }));

  const own = chunks.map((parts) => joined(parts));
  const beside = new Map<string, Uint8Array>();
  const buffers: object[] = own.map((bytes, i) => {
    const where = place === 'mixed' ? (['glb', 'base64', 'percent', 'beside'] as const)[(i + seed) % 4] : place;
    if (where === 'glb' && i === 0) return { byteLength: bytes.length };
    if (where === 'beside' || where === 'glb') {
      // A file may be longer than the buffer.
      beside.set(`made data ${i}.bin`, joined([bytes, new Uint8Array(i)]));
      return { byteLength: bytes.length, uri: `made%20data%20${i}.bin` };
    }
    const uri =
      where === 'base64' ? `data:application/octet-stream;base64,${Buffer.from(bytes).toString('base64')}` : percent(bytes);
    return { byteLength: bytes.length, uri };
  });
  const compressed = storage.startsWith('meshopt');
  const name = storage === 'meshopt' ? 'EXT_meshopt_compression' : 'KHR_meshopt_compression';
  if (compressed) buffers.push({ byteLength: 1 << 20, extensions: { [name]: { fallback: true } } });
  for (const each of views) if (each.buffer === FALLBACK) each.buffer = buffers.length - 1;
  const isQuantized = model.meshes.some(({ primitives }) =>
    primitives.some(({ attributes }) => !(attributes.POSITION?.array instanceof Float32Array)),
  );
  const extensions = [...(compressed ? [name] : []), ...(isQuantized ? ['KHR_mesh_quantization'] : [])];
  const json = {
    asset: { version: '2.0' },
    ...(extensions.length > 0 && { extensionsUsed: extensions, extensionsRequired: extensions }),
    scene: 0,
    scenes: [{ nodes: model.roots }],
    nodes: model.nodes,
    meshes,
    ...(skins && { skins }),
    accessors,
    bufferViews: views,
    buffers,
  };
  const hasBin = (buffers[0] as { uri?: string }).uri === undefined;
  const bytes = hasBin ? glb(json, own[0] as Uint8Array) : new TextEncoder().encode(JSON.stringify(json));
  return { bytes, isGlb: hasBin, beside };
}

const FALLBACK = -1;

function joined(parts: readonly Uint8Array[]): Uint8Array {
  return new Uint8Array(Buffer.concat(parts));
}

function percent(bytes: Uint8Array): string {
  const escaped = [...bytes].map((byte) => `%${byte.toString(16).padStart(2, '0')}`);
  return `data:application/gltf-buffer,${escaped.join('')}`;
}

/** Of positions alone, where the format wants them. */
function boundsOf({ array, type }: MadeAccessor): object {
  if (type !== 'VEC3') return {};
  const along = (axis: number) => [...array].filter((_, i) => i % 3 === axis);
  return { min: [0, 1, 2].map((axis) => Math.min(...along(axis))), max: [0, 1, 2].map((axis) => Math.max(...along(axis))) };
}

/** JSON and a binary chunk as a GLB. */
export function glb(json: unknown, bin?: Uint8Array): Uint8Array {
  const pad = (bytes: Uint8Array, filler: number) => joined([bytes, new Uint8Array(-bytes.length & 3).fill(filler)]);
  const text = pad(new TextEncoder().encode(JSON.stringify(json)), 0x20);
  const chunks = [joined([bytesOf(Uint32Array.of(text.length, 0x4e4f534a)), text])];
  if (bin) chunks.push(joined([bytesOf(Uint32Array.of(Math.ceil(bin.length / 4) * 4, 0x004e4942)), pad(bin, 0)]));
  const body = joined(chunks);
  return joined([bytesOf(Uint32Array.of(0x46546c67, 2, 12 + body.length)), body]);
}
