/**
 * The parts of a scene as one mesh: which of them count, in which shape, and what is said about it. glTF-Transform's documents and
 * three.js' objects are both read through here, so that the same model gives the same vertices, to the last bit.
 */

import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { placeUnheld } from '../../wasm/ts/placed-vertices.ts';
import type { Mesh, MeshReading } from '../../wasm/ts/types.ts';
import { checkReading, MAX_PARTS } from './check-reading.ts';
import { boxOf, drawnVertices, isCoarse, isLostInScene } from './coarse-floats.ts';
import { checkSize, concatenate, type MeshRange } from './concatenate.ts';
import { cornersOf, countTriangles, type DrawnRun, gatherUndrawn, type PartMode } from './drawn-corners.ts';
import type { SceneChoices, SceneWarning } from './scene-choices.ts';
import { type PartSkin, skinFrame } from './skin-frame.ts';
import type { Matrix } from './transform.ts';

/** Something that is drawn as triangles or points, in the scene's order. Arrays are asked for when they are needed. */
export interface ScenePart<Source> {
  readonly source: Source;
  /** As messages call it. */
  readonly name: string;
  readonly hidden: boolean;
  readonly mode: PartMode;
  readonly indices: ArrayLike<number> | undefined;
  readonly drawn?: readonly DrawnRun[] | undefined;
  /** From the part's space to the scene's. */
  readonly matrix: Matrix;
  /** n×3, as stored. */
  readonly positions: () => Float32Array;
  /** Whether those are stored as floats, and not as integers under a scale. */
  readonly floats: boolean;
  /** One weight for each morph target, as they are now. */
  readonly weights: readonly number[];
  /** For each morph target what it adds to the positions, n×3. */
  readonly displacements: () => readonly (Float32Array | undefined)[];
  readonly skin?: (() => PartSkin | undefined) | undefined;
}

/** A part of the joined mesh. */
interface JoinedPart<Source> extends MeshRange {
  readonly source: Source;
  /** From the part's space to the scene's: 16 numbers, column-major. */
  readonly matrix: Matrix;
  /** The weights of the morph targets that are in the positions, if any. */
  readonly weights: readonly number[] | undefined;
}

interface JoinedScene<Source> {
  readonly mesh: Mesh;
  readonly parts: readonly JoinedPart<Source>[];
}

/** Throws 'mesh-no-triangles', 'mesh-too-large' or 'mesh-index-out-of-range'. */
export function joinScene<Source>(found: readonly ScenePart<Source>[], choices: SceneChoices): JoinedScene<Source> {
  const warn = (code: SceneWarning['code'], message: string, remedy: string) => choices.onWarning?.({ code, message, remedy });
  if (found.length > MAX_PARTS) throw manyParts();
  const known = choices.reading && checkReading(choices.reading);
  const skippedBefore = new Set(known?.skipped);
  const reading = {
    skipped: [] as number[],
    morphs: {} as Record<number, readonly number[]>,
    skins: {} as Record<number, number[]>,
  };
  const isSkipped = (part: ScenePart<Source>, number: number) =>
    known ? skippedBefore.has(number) : part.hidden && choices.hidden !== 'take';

  const numbered = found.map((part, number) => ({ part, number }));
  const visible = numbered.filter(({ part, number }) => {
    const skipped = isSkipped(part, number);
    if (skipped) reading.skipped.push(number);
    return !skipped;
  });
  const surface = visible.filter(({ part }) => part.mode !== 0);
  if (surface.length > 0 && surface.length < visible.length)
    warn(
      'left-out',
      `Points beside the surface were left out: ${visible.length - surface.length} of them are parts of the scene.`,
      'Bake them by themselves, as a cloud.',
    );

  const unshown = new Set<string>();
  const posed = new Set<string>();
  const parts = (surface.length > 0 ? surface : visible).map(({ part, number }) => {
    const stored = part.positions();
    const weights = known ? known.morphs?.[number] : choices.morphs === 'present' && isMoved(part) ? [...part.weights] : undefined;
    if (!known && !weights && isMoved(part)) unshown.add(part.name);
    if (weights) reading.morphs[number] = weights;
    const positions = weights ? morphed(stored, part.displacements(), weights) : stored;
    const kept = known?.skins?.[number];
    const skin = kept ? undefined : part.skin?.();
    const frame = kept
      ? { matrix: kept, posed: false }
      : skin && skinFrame(positions, skin, drawnVertices(part, stored.length / 3));
    if (frame?.posed) posed.add(part.name);
    if (frame) reading.skins[number] = Array.from(frame.matrix);
    return { part, weights, positions, matrix: frame?.matrix ?? part.matrix };
  });
  const isCloud = surface.length === 0;
  // Before anything is made as long as that: a file of a few bytes can ask for it by naming one mesh a million times.
  const total = (count: (part: (typeof parts)[number]) => number) => parts.reduce((sum, part) => sum + count(part), 0);
  checkSize(
    total(({ positions }) => positions.length / 3),
    total(({ part, positions }) => countTriangles(part, positions.length / 3)),
  );
  const { mesh, ranges } = concatenate(
    parts.map(({ part, positions, matrix }) => ({
      positions,
      matrix,
      name: part.name,
      indices: isCloud ? undefined : cornersOf(part, positions.length / 3),
    })),
    { isCloud, origin: known?.origin },
  );
  if (isCloud)
    parts.forEach(({ part }, i) => {
      const { start, count } = ranges[i] as MeshRange;
      gatherUndrawn((mesh.positions as Float32Array).subarray(3 * start, 3 * (start + count)), part);
    });
  else placeUnheld(mesh.positions, mesh.triangles);

  if (unshown.size > 0)
    warn(
      'morphs-at-rest',
      `Morph targets of ${named(unshown)} have weights, and the shape at rest was read, without what they add.`,
      "Read it with morphs: 'present' (--morphs present) for the shape that is shown.",
    );
  if (posed.size > 0)
    warn(
      'skin-posed',
      `The skeleton of ${named(posed)} stands in a pose, and the skin was read in its rest shape, where its root joint puts it.`,
      'Deform the rest shape, which the skeleton then poses; or apply the pose in a modeling program and export the model again.',
    );
  if (choices.onWarning) warnOfFloats(parts, { mesh, ranges, warn });
  const told = Object.fromEntries(Object.entries(reading).filter(([, value]) => Object.keys(value).length > 0)) as MeshReading;
  return {
    mesh: Object.keys(told).length > 0 ? { ...mesh, reading: { ...told, ...mesh.reading } } : mesh,
    parts: parts.map(({ part, weights, matrix }, i) => ({
      ...(ranges[i] as MeshRange),
      source: part.source,
      matrix,
      weights,
    })),
  };
}

/** Each part has its place in the mesh's `reading`: what draws so many is no scene. */
function manyParts(): HandlebodyError {
  return new HandlebodyError('mesh-too-large', {
    message: `The scene draws more than ${MAX_PARTS} primitives, one that several nodes draw counted each time.`,
    remedy: 'Join meshes of one material in a modeling program, or use a part of the model.',
  });
}

function isMoved({ weights }: Pick<ScenePart<unknown>, 'weights'>): boolean {
  return weights.some((weight) => weight !== 0);
}

/** What morph targets add at these weights, n×3. */
export function morphOffset(
  length: number,
  displacements: readonly (ArrayLike<number> | undefined)[],
  weights: readonly number[],
): Float64Array {
  const sum = new Float64Array(length);
  displacements.forEach((displacement, k) => {
    const weight = weights[k] ?? 0;
    if (!displacement || weight === 0) return;
    for (let i = 0; i < sum.length; i++) sum[i] = (sum[i] as number) + weight * (displacement[i] as number);
  });
  return sum;
}

function morphed(
  positions: Float32Array,
  displacements: readonly (Float32Array | undefined)[],
  weights: readonly number[],
): Float64Array {
  return morphOffset(positions.length, displacements, weights).map((offset, i) => (positions[i] as number) + offset);
}

interface Joining {
  readonly mesh: Mesh;
  readonly ranges: readonly MeshRange[];
  readonly warn: (code: SceneWarning['code'], message: string, remedy: string) => void;
}

function warnOfFloats(
  parts: readonly { readonly part: ScenePart<unknown>; readonly positions: ArrayLike<number> }[],
  { mesh, ranges, warn }: Joining,
): void {
  const coarse = new Set<string>();
  const lost = new Set<string>();
  parts.forEach(({ part, positions }, i) => {
    const box = boxOf(positions, drawnVertices(part, positions.length / 3));
    if (part.floats && isCoarse(box)) coarse.add(part.name);
    // What is but a place has no shape to lose.
    else if (box.diagonal > 0 && isLostInScene(mesh, ranges[i] as MeshRange)) lost.add(part.name);
  });
  if (coarse.size > 0)
    warn(
      'positions-coarse',
      `The vertices of ${named(coarse)} are stored more than 1,000 of its diagonals from its origin, where floats are too far apart for its shape.`,
      'Move the mesh to its origin in the program that made it, and put the distance into its node.',
    );
  if (lost.size > 0)
    warn(
      'positions-coarse',
      `Parts that are far from the rest for their size, where floats are too far apart for their shape: ${named(lost)}.`,
      'Bake them by themselves, or bring the parts nearer to one another.',
    );
}

/** Up to three names, and how many more. */
function named(names: ReadonlySet<string>): string {
  const [some, more] = [[...names].slice(0, 3).map((name) => `"${name}"`), names.size - 3];
  return some.join(', ') + (more > 0 ? ` and ${more} more` : '');
}
