/**
 * The structure of a glTF's JSON: that every number points at something that is there, and that the node graph is a forest. Readers
 * trust these things; a file that breaks them makes them read past the end or walk in circles.
 */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { checkNodes } from './check-nodes.ts';
import { type CheckIndex, type GltfJson, isObject } from './gltf-json.ts';

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

/** Accessors may share bytes, so a file can stand for more data than it has; this much more is taken for an attack or a defect. */
const AMPLIFICATION = 16;
const AMPLE = 1 << 28;

/** Extensions that replace the data of accessors by something compressed. */
const COMPRESSIONS = new Map([
  ['KHR_draco_mesh_compression', 'Draco'],
  ['EXT_meshopt_compression', 'meshopt'],
  ['KHR_meshopt_compression', 'meshopt'],
]);

/**
 * Returns the JSON when it is sound. Throws 'file-invalid', 'file-unsupported' or 'mesh-too-large'.
 *
 * ```ts
 * checkGltf(JSON.parse(text));
 * ```
 */
export function checkGltf(value: unknown, options: CheckGltfOptions = {}): GltfJson {
  const { jsonStart = 0, binStart = 0 } = options;
  const fail: (what: string, byte?: number) => never = (what, byte = jsonStart) => {
    throw new HandlebodyError('file-invalid', {
      message: `The glTF is damaged: ${what}.`,
      remedy: 'Export the model again; a glTF validator says more.',
      culprit: { kind: 'byte', index: byte },
    });
  };
  const index: CheckIndex = (n, end, path) => {
    if (!isIndex(n) || n >= end) fail(`${path} is ${JSON.stringify(n)}, and should be a whole number below ${end}`);
    return n as number;
  };
  const json = isObject(value) ? value : fail('its JSON is not an object');
  checkAsset(json, fail);
  const lists = Object.fromEntries([...LISTS, 'scenes', 'skins', 'textures'].map((name) => [name, list(json, name, fail)]));
  const count = (name: string) => lists[name]?.length ?? 0;

  const buffers = (lists.buffers ?? []).map((buffer, i) => {
    const length = isIndex(buffer.byteLength) ? buffer.byteLength : fail(`buffer ${i} has no length`);
    const there = options.bufferLengths?.[i] ?? bufferBytes(buffer, i, options);
    if (length > there) fail(`buffer ${i} should have ${length} bytes, but ${there} are there`, binStart || jsonStart);
    return length;
  });

  const views = (lists.bufferViews ?? []).map((view, i) => {
    const buffer = index(view.buffer, buffers.length, `the buffer of buffer view ${i}`);
    const [offset, length] = [view.byteOffset ?? 0, view.byteLength];
    if (!isIndex(offset) || !isIndex(length) || offset + length > (buffers[buffer] as number)) {
      return fail(`buffer view ${i} lies outside its buffer`, binStart || jsonStart);
    }
    const stride = view.byteStride;
    if (stride !== undefined && (!isIndex(stride) || stride < 1 || stride > 252)) fail(`buffer view ${i} has an impossible stride`);
    return { offset, length, stride: stride as number | undefined };
  });

  let total = 0;
  const fits = (accessor: GltfJson, path: string, size: number) => {
    const view = views[index(accessor.bufferView, views.length, `the buffer view of ${path}`)] as (typeof views)[number];
    const [offset, n] = [accessor.byteOffset ?? 0, accessor.count as number];
    const end = isIndex(offset) ? offset + (n === 0 ? 0 : (view.stride ?? size) * (n - 1) + size) : Number.NaN;
    if (!(end <= view.length)) fail(`${path} reads past the end of its buffer view`, binStart + view.offset);
  };
  for (const [i, accessor] of (lists.accessors ?? []).entries()) {
    const bytes = COMPONENT_BYTES.get(accessor.componentType) ?? fail(`accessor ${i} has no known component type`);
    const components = TYPE_SIZES.get(accessor.type) ?? fail(`accessor ${i} has no known type`);
    if (!isIndex(accessor.count)) fail(`accessor ${i} has no count`);
    if (accessor.bufferView !== undefined) fits(accessor, `accessor ${i}`, bytes * components);
    if (accessor.sparse !== undefined) {
      const sparse = isObject(accessor.sparse) ? accessor.sparse : fail(`accessor ${i} has a damaged sparse part`);
      const { indices, values } = sparse;
      if (!isObject(indices) || !isObject(values)) return fail(`accessor ${i} has a damaged sparse part`);
      index(sparse.count, (accessor.count as number) + 1, `the sparse count of accessor ${i}`);
      const indexBytes = COMPONENT_BYTES.get(indices.componentType) ?? fail(`accessor ${i} has sparse indices of no known type`);
      fits({ ...indices, count: sparse.count }, `the sparse indices of accessor ${i}`, indexBytes);
      fits({ ...values, count: sparse.count }, `the sparse values of accessor ${i}`, bytes * components);
    }
    total += (accessor.count as number) * components * bytes;
  }
  if (total > Math.max(AMPLE, AMPLIFICATION * (options.fileLength ?? Number.POSITIVE_INFINITY))) {
    throw new HandlebodyError('mesh-too-large', {
      message: `The file stands for ${(total / 2 ** 20).toFixed(0)} MiB of vertex data, far more than its own size.`,
      remedy: 'Simplify the model, or export it again.',
      culprit: { kind: 'byte', index: jsonStart },
    });
  }

  for (const [i, mesh] of (lists.meshes ?? []).entries()) {
    for (const [j, primitive] of list(mesh, 'primitives', fail, `mesh ${i}`).entries()) {
      const path = `primitive ${j} of mesh ${i}`;
      if (primitive.mode !== undefined) index(primitive.mode, 7, `the mode of ${path}`);
      if (primitive.indices !== undefined) index(primitive.indices, count('accessors'), `the indices of ${path}`);
      if (primitive.material !== undefined) index(primitive.material, count('materials'), `the material of ${path}`);
      for (const attributes of [primitive.attributes, ...list(primitive, 'targets', fail, path)]) {
        if (!isObject(attributes)) return fail(`${path} has no attributes`);
        for (const [name, accessor] of Object.entries(attributes)) index(accessor, count('accessors'), `${name} of ${path}`);
      }
    }
  }
  checkNodes({ lists, scene: json.scene, index, fail });
  return json;
}

function checkAsset(json: GltfJson, fail: (what: string) => never): void {
  const version = isObject(json.asset) ? json.asset.version : fail('it does not say which version it is');
  if (version !== '2.0') {
    throw new HandlebodyError('file-unsupported', {
      message: `The file is glTF of version ${JSON.stringify(version)}; 2.0 is read.`,
      remedy: 'Export the model with a current tool.',
    });
  }
  for (const name of ['extensionsUsed', 'extensionsRequired']) {
    const names = json[name];
    if (names !== undefined && !(Array.isArray(names) && names.every((n) => typeof n === 'string')))
      fail(`${name} is no list of names`);
  }
}

/**
 * Refuses files that need an extension outside `supported`.
 *
 * ```ts
 * checkRequiredExtensions(json, ['KHR_mesh_quantization']); // throws 'file-unsupported' for a Draco-compressed model
 * ```
 */
export function checkRequiredExtensions(json: GltfJson, supported: readonly string[]): void {
  const required = (json.extensionsRequired ?? []) as readonly string[];
  const missing = required.find((name) => !supported.includes(name));
  if (missing === undefined) return;
  const compression = COMPRESSIONS.get(missing);
  throw new HandlebodyError('file-unsupported', {
    message: compression
      ? `The model is compressed with ${compression} (${missing}), which is not read here.`
      : `The model needs the extension ${missing}, which is not read here.`,
    remedy: compression
      ? `Export it without mesh compression${compression === 'Draco' ? ', or give the decoder: the option "draco" of readGlb' : ', and compress last'}.`
      : 'Export it without that extension, or register it.',
  });
}

function isIndex(value: unknown): value is number {
  return Number.isSafeInteger(value) && (value as number) >= 0;
}

function list(owner: GltfJson, name: string, fail: (what: string) => never, path = 'the file'): GltfJson[] {
  const value = owner[name];
  if (value === undefined) return [];
  return Array.isArray(value) && value.every(isObject) ? value : fail(`"${name}" of ${path} is no list of objects`);
}

/** Bytes that a buffer really has: those of the binary chunk, or of a data URI. */
function bufferBytes(buffer: GltfJson, i: number, { binLength, jsonStart = 0 }: CheckGltfOptions): number {
  const { uri } = buffer;
  if (uri === undefined) return i === 0 && binLength !== undefined ? binLength : 0;
  const comma = typeof uri === 'string' && uri.startsWith('data:') ? uri.indexOf(',') : -1;
  if (comma !== -1 && (uri as string).slice(0, comma).endsWith(';base64')) {
    return Math.floor(((uri as string).slice(comma + 1).replace(/={1,2}$/, '').length * 3) / 4);
  }
  throw new HandlebodyError('file-unsupported', {
    message: `Buffer ${i} of the file lies outside it${typeof uri === 'string' ? `, in "${uri.slice(0, 60)}"` : ''}.`,
    remedy: 'Export the model as one .glb file with everything inside.',
    culprit: { kind: 'byte', index: jsonStart },
  });
}
