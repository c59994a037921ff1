/**
 * HANDLES.json, in the model's own units:
 *
 *   { "handles": [{ "vertex": 120 } or { "at": [x,y,z] }, with "to": [x,y,z], "rotation"?: [x,y,z,w], "scale"?: [x,y,z] }],
 *     "relativeWidth"?: number or "auto", "smoothness"?: number or "auto", "poissonRatio"?: number,
 *     "sphereFit"?: "rigid" or "similarity", "structure"?: "octahedron" or "icosahedron",
 *     "shapes"?: { a sphere's number: [9 numbers, the rows of a linear map that it is to be stretched by] } }
 *
 * Every word of it is checked: one that is misspelt would otherwise be silently without effect.
 */
import { type ErrorCode, HandlebodyError } from '../../wasm/ts/errors.ts';
import type { Handle, Vec3 } from '../../wasm/ts/types.ts';
import { decodeText } from '../assets/decode-text.ts';
import { isDeepText, MAX_DEPTH, show } from '../assets/gltf-json.ts';

interface HandlesFile {
  readonly handles: readonly Handle[];
  /** 10 numbers a handle, as `Irbf.targets` takes them. */
  readonly targets: Float64Array;
  readonly options: {
    readonly relativeWidth?: number | 'auto';
    readonly smoothness?: number | 'auto';
    readonly poissonRatio?: number;
    readonly sphereFit?: 'rigid' | 'similarity';
    readonly structure?: 'octahedron' | 'icosahedron';
  };
  /** Sphere and nine numbers, as `Irbf.shapes` takes them. */
  readonly shapes: readonly (readonly [number, readonly number[]])[];
}

const TOP = ['handles', 'relativeWidth', 'smoothness', 'poissonRatio', 'sphereFit', 'structure', 'shapes'];
const WORDS = { sphereFit: ['rigid', 'similarity'], structure: ['octahedron', 'icosahedron'] };
const KEYS = ['vertex', 'at', 'to', 'rotation', 'scale'];

/** Throws 'file-invalid' for what is no JSON, 'handles-invalid', 'handle-*' or 'target-not-finite' naming the handle. */
export function parseHandles(
  bytes: Uint8Array,
  { vertexCount, sphereCount = 0 }: { vertexCount: number; sphereCount?: number },
): HandlesFile {
  const file = parseJson(bytes);
  if (!isObject(file)) throw invalid('should be an object: { "handles": [...] }.');
  const stray = Object.keys(file).find((key) => !TOP.includes(key));
  if (stray !== undefined) throw invalid(`has an unknown key ${show(stray)}.`, TOP);
  if (!Array.isArray(file.handles) || file.handles.length === 0) throw invalid('has no list of handles, or an empty one.', TOP);

  const targets = new Float64Array(file.handles.length * 10);
  const handles = file.handles.map((entry: unknown, index): Handle => {
    const { handle, target } = parseHandle(entry, index, vertexCount);
    targets.set(target, index * 10);
    return handle;
  });
  const { relativeWidth, smoothness, poissonRatio, sphereFit, structure } = file;
  for (const [name, value] of Object.entries({ relativeWidth, smoothness }))
    if (value !== undefined && value !== 'auto' && !(isNumber(value) && value > 0))
      throw invalid(`has the ${name} ${show(value)}, which should be a number above 0, or "auto".`);
  if (poissonRatio !== undefined && !(isNumber(poissonRatio) && poissonRatio >= 0 && poissonRatio <= 0.499))
    throw invalid(`has the poissonRatio ${show(poissonRatio)}, which should be a number from 0 to 0.499.`);
  for (const [name, words] of Object.entries(WORDS)) {
    const value = file[name];
    if (value !== undefined && !words.includes(value as string))
      throw invalid(`has the ${name} ${show(value)}, which should be "${words.join('" or "')}".`);
  }
  const options = {
    ...(relativeWidth !== undefined && { relativeWidth }),
    ...(smoothness !== undefined && { smoothness }),
    ...(poissonRatio !== undefined && { poissonRatio }),
    ...(sphereFit !== undefined && { sphereFit }),
    ...(structure !== undefined && { structure }),
  };
  const shapes = parseShapes(file.shapes, sphereCount);
  return { handles, targets, options: options as HandlesFile['options'], shapes };
}

function parseShapes(shapes: unknown, sphereCount: number): HandlesFile['shapes'] {
  if (shapes === undefined) return [];
  if (!isObject(shapes)) throw invalid(`has the shapes ${show(shapes)}, which should be an object: { "0": [nine numbers] }.`);
  return Object.entries(shapes).map(([name, numbers]) => {
    const sphere = Number(name);
    if (!/^\d+$/.test(name) || sphere >= sphereCount)
      throw invalid(`has a shape for sphere ${show(name)}, and the body has ${sphereCount} spheres, from 0 on (shapes).`);
    if (Array.isArray(numbers) && numbers.length === 9 && numbers.every(isNumber)) return [sphere, numbers] as const;
    throw invalid(`has no nine numbers for the shape of sphere ${sphere} (shapes.${sphere}).`);
  });
}

function parseHandle(entry: unknown, index: number, vertexCount: number): { handle: Handle; target: number[] } {
  const fail = (
    what: string,
    { code = 'handles-invalid', remedy, key = '' }: { code?: ErrorCode; remedy?: string; key?: string } = {},
  ) =>
    new HandlebodyError(code, {
      message: `Handle ${index} ${what} (handles[${index}]${key && `.${key}`}).`,
      remedy: remedy ?? `A handle has "vertex" or "at", and "to"; it may have "rotation" and "scale".`,
      culprit: { kind: 'handle', index },
    });
  if (!isObject(entry)) throw fail('is no object');
  const stray = Object.keys(entry).find((key) => !KEYS.includes(key));
  if (stray !== undefined) throw fail(`has an unknown key ${show(stray)}`, { key: stray.slice(0, 40) });

  const numbers = (key: string, length: number, code: ErrorCode): number[] => {
    const value = entry[key];
    if (!Array.isArray(value) || value.length !== length || !value.every((x) => typeof x === 'number'))
      throw fail(`has no ${length} numbers in "${key}"`, { key });
    if (!value.every(Number.isFinite))
      throw fail(`has a number in "${key}" that is too large`, { code, key, remedy: 'Give finite numbers.' });
    return value as number[];
  };
  const place = (): { vertex: number } | { at: Vec3 } => {
    if ('vertex' in entry === 'at' in entry)
      throw fail(
        `has ${'at' in entry ? 'both' : 'neither'} "vertex" and "at"`.replace('neither "vertex" and', 'neither "vertex" nor'),
      );
    if ('at' in entry) return { at: numbers('at', 3, 'handle-not-finite') as unknown as Vec3 };
    const vertex = entry.vertex;
    if (!Number.isInteger(vertex)) throw fail(`has the vertex ${show(vertex)}, which should be a whole number`, { key: 'vertex' });
    if ((vertex as number) >= 0 && (vertex as number) < vertexCount) return { vertex: vertex as number };
    throw fail(`sits on vertex ${vertex}, and the model has ${vertexCount} vertices`, {
      code: 'handle-out-of-range',
      key: 'vertex',
      remedy: `Use a vertex number from 0 to ${vertexCount - 1}.`,
    });
  };
  const where = place();
  if (!('to' in entry)) throw fail('does not say where it goes: "to" is missing', { key: 'to' });
  const to = numbers('to', 3, 'target-not-finite');
  const rotation = 'rotation' in entry ? numbers('rotation', 4, 'target-not-finite') : [0, 0, 0, 1];
  const scale = 'scale' in entry ? numbers('scale', 3, 'target-not-finite') : [1, 1, 1];
  // Divided first, so that no square overflows or vanishes.
  const largest = Math.max(...rotation.map(Math.abs));
  const direction = rotation.map((x) => x / largest);
  const length = Math.hypot(...direction);
  if (largest === 0)
    throw fail('has a rotation of no length', {
      key: 'rotation',
      remedy: 'Give a quaternion x, y, z, w; no rotation is [0, 0, 0, 1].',
    });
  const turns = 'rotation' in entry || 'scale' in entry;
  return {
    handle: turns ? { ...where, kind: 'rotation' } : where,
    target: [...to, ...direction.map((x) => x / length), ...scale],
  };
}

function parseJson(bytes: Uint8Array): unknown {
  const text = decodeText(bytes);
  if (isDeepText(text)) throw invalid(`has lists or objects nested more than ${MAX_DEPTH} deep.`, TOP);
  try {
    return JSON.parse(text);
  } catch (cause) {
    throw new HandlebodyError('file-invalid', {
      message: `It is no JSON: ${cause instanceof Error ? cause.message : String(cause)}.`,
      remedy: 'Repair it: { "handles": [{ "vertex": 0, "to": [0, 0, 0] }] } is such a file. JSON knows no NaN and no comments.',
      cause,
    });
  }
}

function invalid(what: string, known?: readonly string[]): HandlebodyError {
  return new HandlebodyError('handles-invalid', {
    message: `It ${what}`,
    remedy: known ? `It may have: ${known.join(', ')}.` : 'See "handlebody deform --help".',
  });
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

function isNumber(value: unknown): value is number {
  return typeof value === 'number' && Number.isFinite(value);
}
