import { Document } from '@gltf-transform/core';
import { numbers, object, text } from '../../wasm/ts/arguments.ts';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { TypedArray } from '../../wasm/ts/types.ts';
import { areaNormals } from './area-normals.ts';

/** A mesh of typed arrays, as the solver takes it and `readObj`, `readPly`, `readStl` and `readOff` give it, to be written as glTF. */
export interface GlbMesh {
  /** n×3. */
  readonly positions: TypedArray;
  /** m×3, counter-clockwise seen from outside; none for a cloud of points. */
  readonly triangles?: TypedArray;
  /** n×3, of unit length; where a surface has none they are made smooth. */
  readonly normals?: TypedArray | undefined;
  /** n×2, from the top left. */
  readonly uvs?: TypedArray | undefined;
  /** Where the positions begin, as `FileMesh` has it: the node's translation. */
  readonly origin?: readonly [number, number, number] | undefined;
}

/**
 * A document of one mesh in one node, its vertices in their order: what `attachBody` and other tools of glTF-Transform go on with.
 * Positions are stored as floats, about the node's translation where the mesh has an origin.
 *
 * Throws 'invalid-shape' for lengths that do not agree or an origin that is no place, 'mesh-not-finite' or 'mesh-index-out-of-range'.
 *
 * ```ts
 * const document = meshDocument(readObj(bytes), 'cow');
 * ```
 */
export function meshDocument(mesh: GlbMesh, name = ''): Document {
  object(mesh, 'mesh', 'Give { positions, triangles }.');
  text(name, 'name');
  const read = (key: keyof GlbMesh) => numbers(mesh[key], key, { finite: false }) as TypedArray;
  const readIf = (key: keyof GlbMesh) => (mesh[key] === undefined ? undefined : read(key));
  const [positions, triangles = new Uint32Array()] = [read('positions'), readIf('triangles')];
  const [normals, uvs] = [readIf('normals'), readIf('uvs')];
  const origin = readIf('origin') && mesh.origin;
  check({ positions, triangles, normals, uvs, origin });
  const document = new Document();
  const buffer = document.createBuffer();
  const accessor = (type: 'SCALAR' | 'VEC2' | 'VEC3', array: Float32Array | Uint16Array | Uint32Array) =>
    document
      .createAccessor('', buffer)
      .setType(type)
      .setArray(array as Float32Array<ArrayBuffer>);
  const floats = Float32Array.from(positions);
  const primitive = document.createPrimitive().setAttribute('POSITION', accessor('VEC3', floats));
  if (triangles.length === 0) primitive.setMode(0);
  else {
    // 65535 would restart a primitive.
    const indices = positions.length / 3 <= 65535 ? Uint16Array.from(triangles) : Uint32Array.from(triangles);
    primitive.setIndices(accessor('SCALAR', indices));
  }
  if (normals || triangles.length > 0)
    primitive.setAttribute('NORMAL', accessor('VEC3', normals ? Float32Array.from(normals) : areaNormals(floats, triangles)));
  if (uvs) primitive.setAttribute('TEXCOORD_0', accessor('VEC2', Float32Array.from(uvs)));
  const node = document.createNode(name).setMesh(document.createMesh(name).addPrimitive(primitive));
  if (origin) node.setTranslation([...origin]);
  document.getRoot().setDefaultScene(document.createScene().addChild(node));
  return document;
}

function check({ positions, triangles, normals, uvs, origin }: Required<GlbMesh>): void {
  const count = positions.length / 3;
  const lengths = [
    ['positions', positions.length, Number.isInteger(count) && count > 0, 'x, y and z for every vertex'],
    ['triangles', triangles.length, triangles.length % 3 === 0, 'three vertex numbers for every triangle'],
    ['normals', normals?.length, !normals || normals.length === 3 * count, 'x, y and z for every vertex'],
    ['uvs', uvs?.length, !uvs || uvs.length === 2 * count, 'two numbers for every vertex'],
  ] as const;
  for (const [what, length, fits, remedy] of lengths) {
    if (fits) continue;
    throw new HandlebodyError('invalid-shape', {
      message: `The mesh’s ${what} have ${length} numbers; its positions have ${positions.length}.`,
      remedy: `Give ${remedy}.`,
    });
  }
  if (origin && !(origin.length === 3 && origin.every((x) => Number.isFinite(Math.fround(x))))) {
    throw new HandlebodyError('invalid-shape', {
      message: `The mesh’s origin is ${origin.join(', ')}.`,
      remedy: 'Give three finite numbers, or none.',
    });
  }
  for (const numbers of [positions, normals ?? [], uvs ?? []]) {
    const bad = numbers.findIndex((x: number) => !Number.isFinite(x));
    if (bad === -1) continue;
    const vertex = Math.floor(bad / (numbers === uvs ? 2 : 3));
    throw new HandlebodyError('mesh-not-finite', {
      message: `Vertex ${vertex} has a number that is ${numbers[bad]}.`,
      remedy: 'Remove NaN and infinite numbers.',
      culprit: { kind: 'vertex', index: vertex },
    });
  }
  const beyond = triangles.findIndex((vertex: number) => !(Number.isInteger(vertex) && vertex >= 0 && vertex < count));
  if (beyond === -1) return;
  const triangle = Math.floor(beyond / 3);
  throw new HandlebodyError('mesh-index-out-of-range', {
    message: `Triangle ${triangle} uses vertex ${triangles[beyond]}, but there are only ${count}.`,
    remedy: 'Give vertex numbers from 0.',
    culprit: { kind: 'triangle', index: triangle },
  });
}
