/** What a validator of glTF would say first, of a GLB that holds everything: bounds of positions, alignment, lengths, indices. */
import { splitGlb } from '../../../web/assets/glb-chunks.ts';

const BYTES: Record<number, number> = { 5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4 };
const SIZES: Record<string, number> = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT2: 4, MAT3: 9, MAT4: 16 };
const READ: Record<number, 'getInt8' | 'getUint8' | 'getInt16' | 'getUint16' | 'getUint32' | 'getFloat32'> = {
  5120: 'getInt8',
  5121: 'getUint8',
  5122: 'getInt16',
  5123: 'getUint16',
  5125: 'getUint32',
  5126: 'getFloat32',
};

interface View {
  readonly buffer: number;
  readonly byteOffset?: number;
  readonly byteLength: number;
  readonly byteStride?: number;
}

interface Accessor {
  readonly bufferView?: number;
  readonly byteOffset?: number;
  readonly componentType: number;
  readonly type: string;
  readonly count: number;
  readonly min?: number[];
  readonly max?: number[];
  readonly sparse?: object;
}

interface Json {
  readonly accessors?: Accessor[];
  readonly bufferViews?: View[];
  readonly buffers?: { byteLength: number; uri?: string }[];
  readonly meshes?: {
    primitives: { attributes: Record<string, number>; indices?: number; targets?: Record<string, number>[] }[];
  }[];
  readonly extensionsUsed?: string[];
  readonly extensionsRequired?: string[];
}

/** Sentences, none where all is well. */
export function faultsOf(bytes: Uint8Array): string[] {
  const faults: string[] = [];
  const { json: value, bin = new Uint8Array(), length } = splitGlb(bytes);
  const json = value as Json;
  const fault = (what: string, holds: boolean) => {
    if (!holds) faults.push(what);
  };
  fault('a length that is not the file’s', length === bytes.length && length % 4 === 0);
  fault('more than one buffer, or one outside', (json.buffers ?? []).length <= 1 && json.buffers?.[0]?.uri === undefined);
  fault('a buffer longer than its chunk', (json.buffers?.[0]?.byteLength ?? 0) <= bin.length);
  fault(
    'a required extension that is not used',
    (json.extensionsRequired ?? []).every((n) => json.extensionsUsed?.includes(n)),
  );
  const numbers = (json.accessors ?? []).map((accessor, i) => {
    const view = json.bufferViews?.[accessor.bufferView ?? -1];
    const [bytesEach, size] = [BYTES[accessor.componentType] as number, SIZES[accessor.type] as number];
    if (!view || accessor.sparse) return undefined;
    const start = (view.byteOffset ?? 0) + (accessor.byteOffset ?? 0);
    const stride = view.byteStride ?? size * bytesEach;
    fault(`accessor ${i} is not aligned`, start % bytesEach === 0 && stride % bytesEach === 0);
    fault(`the view of accessor ${i} runs past the buffer`, (view.byteOffset ?? 0) + view.byteLength <= bin.length);
    fault(
      `accessor ${i} runs past its view`,
      (accessor.byteOffset ?? 0) + stride * (accessor.count - 1) + size * bytesEach <= view.byteLength,
    );
    const data = new DataView(bin.buffer, bin.byteOffset, bin.byteLength);
    const read = READ[accessor.componentType] as 'getFloat32';
    return Array.from({ length: accessor.count * size }, (_, k) =>
      data[read](start + Math.floor(k / size) * stride + (k % size) * bytesEach, true),
    );
  });
  const attribute = (name: string, number: number) => {
    const accessor = json.accessors?.[number] as Accessor;
    const row = numbers[number];
    const view = json.bufferViews?.[accessor.bufferView ?? -1];
    if (row) fault(`${name} (accessor ${number}) has numbers that are none`, row.every(Number.isFinite));
    if (view) {
      const stride = view.byteStride ?? (SIZES[accessor.type] as number) * (BYTES[accessor.componentType] as number);
      fault(`the stride of ${name} is no multiple of 4`, stride % 4 === 0 && (accessor.byteOffset ?? 0) % 4 === 0);
    }
    if (name !== 'POSITION') return;
    fault(`POSITION (accessor ${number}) has no bounds`, accessor.min?.length === 3 && accessor.max?.length === 3);
    for (const axis of [0, 1, 2]) {
      const along = row?.filter((_, i) => i % 3 === axis);
      if (!along) continue;
      fault(`the bounds of POSITION (accessor ${number}) are others`, Math.min(...along) === accessor.min?.[axis]);
      fault(`the bounds of POSITION (accessor ${number}) are others`, Math.max(...along) === accessor.max?.[axis]);
    }
  };
  for (const { primitives } of json.meshes ?? []) {
    for (const { attributes, indices, targets = [] } of primitives) {
      for (const [name, number] of [attributes, ...targets].flatMap((each) => Object.entries(each))) attribute(name, number);
      const counts = new Set(Object.values(attributes).map((number) => json.accessors?.[number]?.count));
      fault('attributes of different lengths', counts.size <= 1);
      const most = [...counts][0] ?? 0;
      if (indices !== undefined)
        fault(
          'an index of no vertex',
          (numbers[indices] ?? []).every((i) => i < most),
        );
    }
  }
  return [...new Set(faults)];
}
