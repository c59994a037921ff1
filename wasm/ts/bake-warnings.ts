/** What the solver's warnings mean, in words. */
import { type Exports, LAYOUT, WARNING_CODES, type WarningCode } from './abi.generated.ts';
import type { Heap } from './heap.ts';
import type { BakeWarning, Vec3 } from './types.ts';

interface Facts {
  readonly count: number;
  readonly value: number;
  readonly at: string;
}

const SENTENCES: Record<WarningCode, (facts: Facts) => readonly [message: string, remedy: string]> = {
  'surface-open': () => [
    'The surface encloses nothing at this resolution: Euclidean distances are taken, through the voxels of the surface itself.',
    'Close the surface, or raise the resolution if the model is thin, for distances inside it.',
  ],
  'mesh-inside-out': () => [
    'The triangles face inward. The inside is what the surface winds about, so baking works; normals point inward.',
    'Turn the faces round in a modeling program.',
  ],
  'limbs-merged': ({ count, value, at }) => [
    `Parts that are close together run into one: ${count} ${count === 1 ? 'pair' : 'pairs'} of neighboring voxels with a gap between, most of them about ${at}.`,
    value > 0
      ? `Bake with a resolution of ${value}, or move the parts apart.`
      : 'Move the parts apart, where no resolution up to 512 separates them, or accept that they move together.',
  ],
  'part-outside': ({ count, value, at }) => [
    `Outside all voxels: ${count} ${count === 1 ? 'vertex' : 'vertices'}, the farthest ${value.toPrecision(3)} away at ${at}. They follow the nearest inside.`,
    'Give such parts a thickness, raise the resolution if they have one, or leave them.',
  ],
  'orientation-mixed': ({ count }) => [
    `Triangles that face the other way than their neighbors: ${count}. They were taken as turned round.`,
    'Make the faces agree in a modeling program, if the inside is not what it should be.',
  ],
  'surface-filled': () => [
    'The triangles do not tell inside from outside; what they enclose as a shell of voxels was taken.',
    'Close the gaps and make the faces agree, for an inside that is exact.',
  ],
  'vertices-unused': ({ count, at }) => [
    `Vertices that are no part of the surface, since nothing with an area uses them: ${count}, the farthest at ${at}. They set neither box nor grid, and move as the nearest inside does.`,
    'Remove them in a modeling program, or leave them.',
  ],
  'triangles-flat': ({ count }) => [
    `Triangles without area were passed over: ${count}.`,
    'Merge vertices that share a place in a modeling program, or leave them.',
  ],
  'triangles-doubled': ({ count }) => [
    `Triangles that are there more than once, as they are or turned round, were taken once: ${count} too many.`,
    'Remove doubled faces in a modeling program, or leave them.',
  ],
  'voxels-few': ({ count, value }) => [
    `The inside is only ${count} ${count === 1 ? 'voxel' : 'voxels'}: too few to tell distances inside it.`,
    value > 0
      ? `Bake with a resolution of ${value}.`
      : 'Make thin parts thicker, or bake parts that are far apart one by one; give a voxel volume smaller voxels.',
  ],
};

interface Telling {
  /** The first that was not told yet. */
  readonly from: number;
  /** What the baked positions are relative to. */
  readonly origin: Vec3 | undefined;
  readonly tell: (warning: BakeWarning) => void;
}

/** Reports the warnings that are new; returns how many there are in all. */
export function tellWarnings(heap: Heap<Exports>, bake: number, { from, origin = [0, 0, 0], tell }: Telling): number {
  const layout = LAYOUT.hb_bake_warning;
  const warnings = heap.scope((scratch) => {
    const out = scratch.reserve(layout.sizeof);
    const read: BakeWarning[] = [];
    for (let i = from; i < heap.call((e) => e.hb_bake_get_warning(bake, i, out)); i++) read.push(readWarning(heap, out, origin));
    return read;
  });
  for (const warning of warnings) tell(warning);
  return from + warnings.length;
}

function readWarning(heap: Heap<Exports>, from: number, origin: Vec3): BakeWarning {
  const layout = LAYOUT.hb_bake_warning;
  const [number = 0, vertex = 0, count = 0, placed = 0] = heap.u32(from, 4);
  const code = WARNING_CODES[number as keyof typeof WARNING_CODES];
  const value = heap.f64(from + layout.value, 1)[0] ?? 0;
  const [x = 0, y = 0, z = 0] = heap.f64(from + layout.place, 3).map((n, axis) => n + (origin[axis] as number));
  // Far away the first digits say nothing.
  const digits = origin.some((n) => n !== 0) ? 9 : 3;
  const at: Vec3 | undefined = placed ? [x, y, z] : undefined;
  const where = `(${[x, y, z].map((n) => Number(n.toPrecision(digits))).join(', ')})`;
  const [message, remedy] = SENTENCES[code]({ count, value, at: where });
  return {
    code,
    message,
    remedy,
    ...(vertex !== 0xffff_ffff && { culprit: { kind: 'vertex', index: vertex } }),
    ...(at && { at }),
  };
}
