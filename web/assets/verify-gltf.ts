/**
 * The structure of a glTF's JSON: that every number points at something that is there, and that the node graph is a forest. Readers
 * trust these things; a file that breaks them makes them read past the end or walk in circles.
 */
import { type Fail, Fault } from './fault.ts';
import { type CheckIndex, type GltfJson, isDeep, isObject, MAX_DEPTH } from './gltf-json.ts';
import { verifyNodes } from './verify-nodes.ts';

export interface CheckGltfOptions {
  /** Bytes of the GLB's binary chunk; undefined when it has none. */
  readonly binLength?: number | undefined;
  /** Bytes of every buffer, where they were fetched from wherever they lie. */
  readonly bufferLengths?: readonly number[];
  /** Bytes of the whole file: how much data it may stand for is measured by it. */
  readonly fileLength?: number;
  /** Where the JSON and the binary chunk begin in the file, to name the byte at fault. */
  readonly jsonStart?: number;
  readonly binStart?: number;
}

// Maps, since a file may ask an object for its "constructor".
const COMPONENT_BYTES = new Map<unknown, number>(
  Object.entries({ 5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4 }).map(([type, n]) => [Number(type), n]),
);
const TYPE_SIZES = new Map<unknown, number>(Object.entries({ SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT2: 4, MAT3: 9, MAT4: 16 }));
const LISTS = [
  'accessors',
  'animations',
  'buffers',
  'bufferViews',
  'cameras',
  'images',
  'materials',
  'meshes',
  'nodes',
  'samplers',
];

/**
 * Accessors may share bytes, or have none but a few sparse ones, so a file can stand for more data than it has, as floats; this much more is
 * taken for an attack or a defect. Faces of a hundred sparse morph targets stand for some thirty times their bytes. A stream of Draco's says
 * nothing of how much is in it.
 */
export const AMPLIFICATION = 64;
export const AMPLE = 1 << 20;
const AMPLE_DRACO = 1 << 26;

/** Each member costs a reader of objects ten times its bytes and more, and a node some time for each scene that lists it. */
const MOST = 1 << 16;
const MOST_SCENES = 256;

/** Returns the JSON when it is sound. Throws a `Fault` as `checkGltf` has it in words. */
export function verifyGltf(value: unknown, options: CheckGltfOptions = {}): GltfJson {
  const { jsonStart = 0, binStart = 0 } = options;
  const fail: Fail = (fault, facts = [], byte = jsonStart) => {
    throw new Fault(fault, facts, { byte });
  };
  const index: CheckIndex = (n, end, path) => {
    if (!isIndex(n) || n >= end) fail('index', [path, n, end]);
    return n as number;
  };
  const json = isObject(value) ? value : fail('json-object');
  const deep = Object.keys(json).find((key) => isDeep(json[key], 1));
  if (deep !== undefined) fail('nested', [MAX_DEPTH, deep]);
  checkAsset(json, fail);
  const lists = Object.fromEntries([...LISTS, 'scenes', 'skins', 'textures'].map((name) => [name, list(json, name, fail)]));
  const count = (name: string) => lists[name]?.length ?? 0;
  for (const name of Object.keys(lists)) {
    const most = name === 'scenes' ? MOST_SCENES : MOST;
    if (count(name) > most) fail('many', [name, count(name), most]);
  }

  const buffers = (lists.buffers ?? []).map((buffer, i) => {
    const length = isIndex(buffer.byteLength) ? buffer.byteLength : fail('buffer-length', [i]);
    const there = options.bufferLengths?.[i] ?? bufferBytes(buffer, i, options);
    if (length > there) fail('buffer-short', [i, length, there], binStart || jsonStart);
    return length;
  });

  const views = (lists.bufferViews ?? []).map((view, i) => {
    const buffer = index(view.buffer, buffers.length, `bufferViews[${i}].buffer`);
    const [offset, length] = [view.byteOffset ?? 0, view.byteLength];
    if (!isIndex(offset) || !isIndex(length) || offset + length > (buffers[buffer] as number)) {
      return fail('view', [i], binStart || jsonStart);
    }
    const stride = view.byteStride;
    if (stride !== undefined && (!isIndex(stride) || stride < 1 || stride > 252)) fail('stride', [i]);
    return { offset, length, stride: stride as number | undefined };
  });

  let total = 0;
  const fits = (accessor: GltfJson, path: string, size: number) => {
    const view = views[index(accessor.bufferView, views.length, `${path}.bufferView`)] as (typeof views)[number];
    const [offset, n] = [accessor.byteOffset ?? 0, accessor.count as number];
    const end = isIndex(offset) ? offset + (n === 0 ? 0 : (view.stride ?? size) * (n - 1) + size) : Number.NaN;
    if (!(end <= view.length)) fail('past', [path], binStart + view.offset);
  };
  for (const [i, accessor] of (lists.accessors ?? []).entries()) {
    const bytes = COMPONENT_BYTES.get(accessor.componentType) ?? fail('component', [i]);
    const components = TYPE_SIZES.get(accessor.type) ?? fail('type', [i]);
    if (!isIndex(accessor.count)) fail('count', [i]);
    if (accessor.bufferView !== undefined) fits(accessor, `accessors[${i}]`, bytes * components);
    if (accessor.sparse !== undefined) {
      const sparse = isObject(accessor.sparse) ? accessor.sparse : fail('sparse', [i]);
      const { indices, values } = sparse;
      if (!isObject(indices) || !isObject(values)) return fail('sparse', [i]);
      index(sparse.count, (accessor.count as number) + 1, `accessors[${i}].sparse.count`);
      const indexBytes = COMPONENT_BYTES.get(indices.componentType) ?? fail('sparse-type', [i]);
      fits({ ...indices, count: sparse.count }, `accessors[${i}].sparse.indices`, indexBytes);
      fits({ ...values, count: sparse.count }, `accessors[${i}].sparse.values`, bytes * components);
    }
    total += (accessor.count as number) * components * 4;
  }
  const ample = (json.extensionsUsed as string[] | undefined)?.includes('KHR_draco_mesh_compression') ? AMPLE_DRACO : AMPLE;
  if (total > Math.max(ample, AMPLIFICATION * (options.fileLength ?? Number.POSITIVE_INFINITY))) fail('amplified', [total]);

  let primitives = 0;
  for (const [i, mesh] of (lists.meshes ?? []).entries()) {
    for (const [j, primitive] of list(mesh, 'primitives', fail, `meshes[${i}].`).entries()) {
      if (++primitives > MOST) fail('many', ['primitives or more', primitives, MOST]);
      const path = `meshes[${i}].primitives[${j}]`;
      if (primitive.mode !== undefined) index(primitive.mode, 7, `${path}.mode`);
      if (primitive.indices !== undefined) index(primitive.indices, count('accessors'), `${path}.indices`);
      if (primitive.material !== undefined) index(primitive.material, count('materials'), `${path}.material`);
      for (const [k, attributes] of [primitive.attributes, ...list(primitive, 'targets', fail, `${path}.`)].entries()) {
        if (!isObject(attributes)) return fail('attributes', [path]);
        const where = `${path}.${k ? `targets[${k - 1}]` : 'attributes'}`;
        for (const [name, accessor] of Object.entries(attributes)) index(accessor, count('accessors'), `${where}.${name}`);
      }
    }
  }
  verifyNodes({ lists, scene: json.scene, index, fail });
  return json;
}

function checkAsset(json: GltfJson, fail: Fail): void {
  const version = isObject(json.asset) ? json.asset.version : fail('json-asset');
  if (version !== '2.0') {
    throw new Fault('gltf-version', [version]);
  }
  for (const name of ['extensionsUsed', 'extensionsRequired']) {
    const names = json[name];
    if (names !== undefined && !(Array.isArray(names) && names.every((n) => typeof n === 'string'))) fail('names', [name]);
  }
}

function isIndex(value: unknown): value is number {
  return Number.isSafeInteger(value) && (value as number) >= 0;
}

function list(owner: GltfJson, name: string, fail: Fail, path = ''): GltfJson[] {
  const value = owner[name];
  if (value === undefined) return [];
  return Array.isArray(value) && value.every(isObject) ? value : fail('list', [path + name]);
}

/** Bytes that a buffer really has: those of the binary chunk, or of a data URI. */
function bufferBytes(buffer: GltfJson, i: number, { binLength, jsonStart = 0 }: CheckGltfOptions): number {
  const { uri } = buffer;
  if (uri === undefined) return i === 0 && binLength !== undefined ? binLength : 0;
  const comma = typeof uri === 'string' && uri.startsWith('data:') ? uri.indexOf(',') : -1;
  if (comma !== -1 && (uri as string).slice(0, comma).endsWith(';base64')) {
    return Math.floor(((uri as string).slice(comma + 1).replace(/={1,2}$/, '').length * 3) / 4);
  }
  throw new Fault('buffer-outside', [i, uri], { byte: jsonStart });
}
