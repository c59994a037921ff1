import { BoxGeometry } from 'three';
import type { WeightHandle } from '../../../wasm/ts/index.ts';
import type { Vec3 } from '../../../wasm/ts/types.ts';
import { lazy, notFetched } from '../../ui/lazy.ts';

interface SolidHandle {
  readonly name: string;
  readonly holds: WeightHandle;
  /** What it turns about. */
  readonly center: Vec3;
}

export interface Solid {
  readonly id: 'bar' | 'dog';
  readonly label: string;
  readonly positions: Float32Array;
  readonly triangles: Uint32Array;
  readonly handles: readonly SolidHandle[];
  /** Voxels along the longest side. */
  readonly resolution: number;
  readonly view: { readonly azimuth: number; readonly elevation: number };
  /** Which handle is shown and posed at first. */
  readonly chosen: number;
}

/** A bar of 6 × 1 × 1, held at its ends: made, like its handles. */
function makeBar(): Solid {
  const geometry = new BoxGeometry(6, 1, 1, 72, 12, 12);
  const end = (x: number): WeightHandle => ({
    bone: [
      [x - 0.45, 0, 0],
      [x + 0.45, 0, 0],
    ],
  });
  const positions = new Float32Array(geometry.getAttribute('position').array);
  const triangles = new Uint32Array(geometry.index?.array ?? []);
  geometry.dispose();
  return {
    id: 'bar',
    label: 'Bar',
    positions,
    triangles,
    handles: [
      { name: 'Left end', holds: end(-2.5), center: [-2.5, 0, 0] },
      { name: 'Right end', holds: end(2.5), center: [2.5, 0, 0] },
    ],
    resolution: 36,
    view: { azimuth: 22, elevation: 24 },
    chosen: 1,
  };
}

/** The studio's handles. */
const DOG: readonly (readonly [name: string, vertex: number])[] = [
  ['Front right paw', 1172],
  ['Front left paw', 4946],
  ['Back right paw', 7827],
  ['Back left paw', 9813],
  ['Nose', 13637],
  ['Tail tip', 3169],
];

const reader = lazy(() => import('./read-model.ts'), 'The part of this page that reads models');

async function fetchDog(signal: AbortSignal): Promise<Solid> {
  const { readModel } = await reader('dog');
  const response = await fetch(new URL('../../models/dog.glb', document.baseURI), { signal }).catch(() => undefined);
  signal.throwIfAborted();
  if (!response?.ok) throw await notFetched('The dog');
  const { positions, triangles } = await readModel(await response.arrayBuffer());
  const place = (v: number): Vec3 => [positions[3 * v] as number, positions[3 * v + 1] as number, positions[3 * v + 2] as number];
  return {
    id: 'dog',
    label: 'Dog',
    positions,
    triangles,
    handles: DOG.map(([name, vertex]) => ({ name, holds: { at: place(vertex) }, center: place(vertex) })),
    resolution: 56,
    view: { azimuth: 58, elevation: 14 },
    chosen: 0,
  };
}

export const SOLIDS = [
  { id: 'bar', label: 'Bar', make: async (_: AbortSignal) => makeBar() },
  { id: 'dog', label: 'Dog', make: fetchDog },
] as const;
