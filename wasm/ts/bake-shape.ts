/** Turns everything that can be baked into what the solver bakes: a mesh to show and deform, and what is known of its inside. */

import type { Exports } from './abi.generated.ts';
import { checkNames, numbers, positive, row, whole } from './arguments.ts';
import { boxOf } from './box.ts';
import { copied, unshared } from './copied.ts';
import { HandlebodyError } from './errors.ts';
import type { Heap } from './heap.ts';
import { meshLike, readCorners, readOrigin, readPositions } from './mesh-arrays.ts';
import { chooseOrigin } from './origin.ts';
import { placeUnheld } from './placed-vertices.ts';
import type { BakeShape, Mesh, TetrahedralMesh, TypedArray, Vec3, VoxelVolume } from './types.ts';

interface PreparedVolume extends Omit<VoxelVolume, 'inside'> {
  readonly inside: ArrayLike<number>;
  readonly voxels: Uint32Array;
}

interface PreparedShape {
  /** In arrays of its own: a bake lets events in, and the caller's may change or go to another thread meanwhile. */
  readonly mesh: Mesh;
  readonly cloud: boolean;
  /** The grid and its voxels inside, where the shape is a volume. */
  readonly volume: PreparedVolume | undefined;
  /** Of a solid: 1 for the vertices that its tetrahedra use. */
  readonly used: Uint8Array | undefined;
}

const MOST_VOXELS = 64e6;

/** Checks a shape's arrays and makes its mesh. Throws 'invalid-shape', 'mesh-too-large', 'mesh-index-out-of-range' … */
export function prepareShape(heap: Heap<Exports>, given: BakeShape): PreparedShape {
  const shape = meshLike(given, 'shape') as unknown as BakeShape;
  // Without this, a body whose triangles are misspelt would be a cloud of points.
  checkNames(shape, SHAPE_NAMES, 'shape');
  const prepared = prepare(heap, shape);
  if (isVolume(shape)) return aboutOrigin(prepared);
  const { reading } = shape;
  const { origin } = readOrigin({ ...shape });
  const mesh = { ...prepared.mesh, ...(reading && { reading: structuredClone(reading) }) };
  return origin ? { ...prepared, mesh: withOrigin(mesh, origin) } : aboutOrigin({ ...prepared, mesh });
}

/** Doubles far from the origin keep their shape: they are given about an origin of their own. Floats have nothing more to keep. */
function aboutOrigin(prepared: PreparedShape): PreparedShape {
  const { mesh, used } = prepared;
  const { positions, triangles } = mesh;
  if (!(positions instanceof Float64Array)) return prepared;
  const { low, high } = boxOf(positions, triangles, used);
  const origin = chooseOrigin(low, high);
  if (!origin) return prepared;
  // The arrays are this function's own by now.
  for (let i = 0; i < positions.length; i++) positions[i] = (positions[i] as number) - (origin[i % 3] as number);
  return { ...prepared, mesh: withOrigin(mesh, origin) };
}

function withOrigin(mesh: Mesh, origin: Vec3): Mesh {
  return { ...mesh, origin: [...origin], reading: { ...mesh.reading, origin: [...origin] } };
}

function prepare(heap: Heap<Exports>, shape: BakeShape): PreparedShape {
  if (isVolume(shape)) return prepareVolume(shape);
  const { triangles: faces, tetrahedra } = shape as Partial<Mesh & TetrahedralMesh>;
  const given = readPositions({ ...shape }, 3);
  const corners = faces ?? tetrahedra;
  checkSize(heap, given, numberCount(corners) / (faces === undefined ? 4 : 3));
  const cloud = corners === undefined;
  const mesh: Mesh = {
    positions: ownTyped(given, Float64Array),
    triangles: faces === undefined ? new Uint32Array() : ownTyped(readCorners(faces, 'triangles'), Uint32Array),
  };
  // The array is this function's own.
  if (cloud || faces !== undefined) {
    if (!cloud) placeUnheld(mesh.positions as Float64Array, mesh.triangles);
    return { mesh, cloud, volume: undefined, used: undefined };
  }
  const read = readCorners(tetrahedra, 'tetrahedra');
  const solid = {
    positions: mesh.positions,
    tetrahedra: ArrayBuffer.isView(read) ? unshared(read as TypedArray) : Uint32Array.from(read),
  };
  placeUnheld(mesh.positions as Float64Array, solid.tetrahedra);
  const triangles = boundaryTriangles(solid);
  return { mesh: { positions: mesh.positions, triangles }, cloud, volume: undefined, used: verticesOf(solid) };
}

/** 1 for the vertices of tetrahedra that have a volume. */
function verticesOf({ positions, tetrahedra }: TetrahedralMesh): Uint8Array {
  const used = new Uint8Array(positions.length / 3);
  for (let t = 0; t < tetrahedra.length; t += 4) {
    const [a = 0, b = 0, c = 0, d = 0] = tetrahedra.subarray(t, t + 4);
    if (sixVolumes(positions, a, b, c, d) !== 0) for (const vertex of [a, b, c, d]) used[vertex] = 1;
  }
  return used;
}

const SHAPE_NAMES = { positions: 0, triangles: 0, tetrahedra: 0, origin: 0, reading: 0, dimensions: 0, spacing: 0, inside: 0 };

function isVolume(shape: BakeShape): shape is VoxelVolume {
  return (shape as Partial<VoxelVolume>).dimensions !== undefined;
}

/** A copy in an array of its own type, or of this one where it came as a plain list. */
function ownTyped(numbers: ArrayLike<number>, Kind: typeof Float64Array | typeof Uint32Array): TypedArray {
  return ArrayBuffer.isView(numbers) ? copied(numbers as unknown as TypedArray) : Kind.from(numbers);
}

/** How many there are, before they are read; 0 where that is not known. */
function numberCount(value: unknown): number {
  const { length } = (value ?? []) as ArrayLike<number>;
  return Number.isInteger(length) ? length : 0;
}

/** Checks the counts alone: nothing has been copied yet. */
function checkSize(heap: Heap<Exports>, positions: ArrayLike<number>, simplices: number): void {
  heap.check((e) => e.hb_mesh_check_size(positions.length / 3, simplices));
}

/**
 * The faces that no two tetrahedra share, counter-clockwise seen from outside. Every tetrahedron is taken as positively oriented; those
 * without volume are left out. So the surface's winding number about a point is the number of tetrahedra that cover it, even where they
 * overlap or do not meet face to face.
 */
export function boundaryTriangles({ positions, tetrahedra }: TetrahedralMesh): Uint32Array<ArrayBuffer> {
  const [vertices, count] = [positions.length / 3, tetrahedra.length / 4];
  if (!Number.isInteger(count) || count === 0) {
    throw new HandlebodyError('invalid-shape', {
      message: `${tetrahedra.length} indices are no list of tetrahedra.`,
      remedy: 'Give four vertex indices for every tetrahedron, and at least one.',
    });
  }
  const faces = new Uint32Array(12 * count);
  let used = 0;
  for (let t = 0; t < count; t++) {
    const [a = 0, b = 0, c = 0, d = 0] = tetrahedra.subarray(4 * t, 4 * t + 4);
    const highest = Math.max(a, b, c, d);
    if (highest >= vertices) {
      throw new HandlebodyError('mesh-index-out-of-range', {
        message: `Tetrahedron ${t} uses vertex ${highest}, but there are only ${vertices}.`,
        remedy: 'Export the model again; its index list does not fit its vertices.',
        culprit: { kind: 'tetrahedron', index: t },
      });
    }
    const volume = sixVolumes(positions, a, b, c, d);
    if (volume > 0) faces.set([a, c, b, a, b, d, a, d, c, b, c, d], used);
    else if (volume < 0) faces.set([a, b, c, a, d, b, a, c, d, b, d, c], used);
    else continue;
    used += 12;
  }
  return withoutPairs(faces.subarray(0, used));
}

function sixVolumes(p: ArrayLike<number>, a: number, b: number, c: number, d: number): number {
  const at = (v: number, axis: number) => (p[3 * v + axis] ?? 0) - (p[3 * a + axis] ?? 0);
  const minor = (i: number, j: number) => at(c, i) * at(d, j) - at(c, j) * at(d, i);
  return at(b, 0) * minor(1, 2) + at(b, 1) * minor(2, 0) + at(b, 2) * minor(0, 1);
}

/** Drops pairs of one triangle in opposite orientations: a hash table with open addressing holds the triangles that have no pair yet. */
function withoutPairs(faces: Uint32Array): Uint32Array<ArrayBuffer> {
  const count = faces.length / 3;
  const size = 2 ** Math.ceil(Math.log2(2 * count + 2));
  const table = new Int32Array(size); // face + 1; −1 where one was taken out
  const dropped = new Uint8Array(count);
  const sorted = (f: number) => faces.slice(3 * f, 3 * f + 3).sort();
  const isEven = (f: number, [low = 0, middle = 0]: Uint32Array) => {
    const at = faces.subarray(3 * f, 3 * f + 3).indexOf(low);
    return faces[3 * f + ((at + 1) % 3)] === middle;
  };
  for (let f = 0; f < count; f++) {
    const key = sorted(f);
    const [a = 0, b = 0, c = 0] = key;
    let slot = (Math.imul(a, 0x9e3779b1) ^ Math.imul(b, 0x85ebca6b) ^ Math.imul(c, 0xc2b2ae35)) >>> 0;
    for (slot ^= slot >>> 15; ; slot++) {
      slot &= size - 1;
      const entry = table[slot] ?? 0;
      if (entry === 0) {
        table[slot] = f + 1;
        break;
      }
      const other = sorted(entry - 1);
      if (entry > 0 && key.every((v, i) => v === other[i]) && isEven(f, key) !== isEven(entry - 1, key)) {
        dropped[f] = dropped[entry - 1] = 1;
        table[slot] = -1;
        break;
      }
    }
  }
  return Uint32Array.from(faces.filter((_, i) => dropped[Math.floor(i / 3)] === 0));
}

/** A volume's surface: two triangles for each face between inside and outside. */
function prepareVolume(given: VoxelVolume): PreparedShape {
  const sides = row(given.dimensions, 'dimensions', 3);
  const [nx, ny, nz] = Array.from(sides, (n, axis) => whole(1, 0xffff_ffff, 'invalid-shape')(n, `dimensions[${axis}]`)) as [
    number,
    number,
    number,
  ];
  const dimensions = [nx, ny, nz] as const;
  const spacing = positive(given.spacing, 'spacing');
  const origin = Array.from(row(given.origin, 'origin', 3)) as unknown as Vec3;
  const inside = unshared(numbers(given.inside, 'inside', { finite: false }));
  if (nx * ny * nz > MOST_VOXELS || inside.length !== nx * ny * nz) {
    throw new HandlebodyError(nx * ny * nz > MOST_VOXELS ? 'mesh-too-large' : 'invalid-shape', {
      message: `The volume has ${inside.length} voxels for the dimensions ${dimensions.join(' × ')}.`,
      remedy: 'Give one byte for each of nx × ny × nz voxels, 64 million at most.',
    });
  }
  const voxels = Uint32Array.from(insideVoxels(inside));
  if (voxels.length === 0) {
    throw new HandlebodyError('mesh-no-interior', {
      message: 'The volume has no voxel that is inside.',
      remedy: 'Mark the voxels inside with 1.',
    });
  }
  const volume = { dimensions, spacing, origin, inside, voxels };
  return { mesh: volumeSurface(volume), cloud: false, volume, used: undefined };
}

function* insideVoxels(inside: ArrayLike<number>): Generator<number> {
  for (let c = 0; c < inside.length; c++) if (inside[c] !== 0) yield c;
}

/** Of each side of a voxel (−x +x −y +y −z +z) the four corners, counter-clockwise seen from outside. */
const SIDES = [
  [-1, 0, 0, [0, 4, 6, 2]],
  [1, 0, 0, [1, 3, 7, 5]],
  [0, -1, 0, [0, 1, 5, 4]],
  [0, 1, 0, [2, 6, 7, 3]],
  [0, 0, -1, [0, 2, 3, 1]],
  [0, 0, 1, [4, 5, 7, 6]],
] as const;

function volumeSurface({ dimensions: [nx, ny, nz], spacing, origin, inside, voxels }: PreparedVolume): Mesh {
  const numbers = new Map<number, number>();
  const positions: number[] = [];
  const triangles: number[] = [];
  const vertex = (i: number, j: number, k: number): number => {
    const key = i + (nx + 1) * (j + (ny + 1) * k);
    const known = numbers.get(key);
    if (known !== undefined) return known;
    numbers.set(key, numbers.size);
    positions.push(origin[0] + spacing * (i - 0.5), origin[1] + spacing * (j - 0.5), origin[2] + spacing * (k - 0.5));
    return numbers.size - 1;
  };
  const isInside = (i: number, j: number, k: number) =>
    i >= 0 && j >= 0 && k >= 0 && i < nx && j < ny && k < nz && inside[i + nx * (j + ny * k)] !== 0;
  for (const voxel of voxels) {
    const [i, j, k] = [voxel % nx, Math.floor(voxel / nx) % ny, Math.floor(voxel / (nx * ny))];
    for (const [di, dj, dk, corners] of SIDES) {
      if (isInside(i + di, j + dj, k + dk)) continue;
      const [a = 0, b = 0, c = 0, d = 0] = corners.map((corner) =>
        vertex(i + (corner & 1), j + ((corner >> 1) & 1), k + (corner >> 2)),
      );
      triangles.push(a, b, c, a, c, d);
    }
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}
