import type { WeightHandle } from '../../../../wasm/ts/index.ts';
import type { Vec3 } from '../../../../wasm/ts/types.ts';
import { boxSurface } from '../../kit/box.ts';
import { fetchModel } from '../../kit/read-model.ts';

interface SolidHandle {
  readonly name: string;
  readonly holds: WeightHandle;
  /** What it turns about. */
  readonly center: Vec3;
}

export interface Solid {
  readonly positions: Float32Array;
  readonly triangles: Uint32Array;
  readonly handles: readonly SolidHandle[];
  /** Voxels along the longest side. */
  readonly resolution: number;
}

export type SolidName = keyof typeof HANDLES;

/** What the handles are called; the dog's are the studio's, at these vertices. */
export const HANDLES = {
  bar: ['Left end', 'Right end'],
  dog: ['Front right paw', 'Front left paw', 'Back right paw', 'Back left paw', 'Nose', 'Tail tip'],
} as const;

const DOG_VERTICES = [1172, 4946, 7827, 9813, 13637, 3169];

/** A bar of 6 × 1 × 1, held at its ends: made, like its handles. */
const bar: Solid = {
  ...boxSurface([6, 1, 1], [72, 12, 12]),
  handles: HANDLES.bar.map((name, i) => {
    const x = i === 0 ? -2.5 : 2.5;
    return { name, center: [x, 0, 0], holds: { bone: [[x - 0.45, 0, 0], [x + 0.45, 0, 0]] } }; // biome-ignore format: one place
  }),
  resolution: 36,
};

let dog: Solid | undefined;

export async function solidOf(name: SolidName): Promise<Solid> {
  if (name === 'bar') return bar;
  const { positions, triangles } = await fetchModel('dog.glb', 'The dog');
  const place = (v: number): Vec3 => [positions[3 * v] as number, positions[3 * v + 1] as number, positions[3 * v + 2] as number];
  dog ??= {
    positions,
    triangles,
    handles: DOG_VERTICES.map(place).map((center, i) => ({ name: HANDLES.dog[i] ?? '', holds: { at: center }, center })),
    resolution: 56,
  };
  return dog;
}
