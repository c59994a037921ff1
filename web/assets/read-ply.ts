import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { checkCounts, type FileMesh, NumberList, unitRows } from './file-mesh.ts';
import { type PlyElement, type PlyProperty, type PlyType, parsePlyHeader } from './ply-header.ts';
import { listLength, type PlyRows, plyRows, skipElement, skipValues } from './ply-rows.ts';
import { quote } from './text-lines.ts';

const FACE_LISTS = ['vertex_indices', 'vertex_index'];
const POSITION_NAMES: readonly string[] = ['x', 'y', 'z'];
const NORMAL_NAMES: readonly string[] = ['nx', 'ny', 'nz'];
const UV_NAMES: readonly (readonly string[])[] = [
  ['u', 'v'],
  ['s', 't'],
  ['texture_u', 'texture_v'],
];

/** Triangles as they are read, of vertices below `vertexCount`. */
interface Faces {
  readonly corners: NumberList<Uint32Array>;
  readonly vertexCount: number;
}

/**
 * Reads a PLY, as text or binary of either byte order. Polygons become fans of triangles, triangle strips triangles; without faces it is a
 * cloud of points. Normals and texture coordinates of the vertices are kept, other properties and elements are skipped.
 *
 * Throws 'file-invalid' naming the line or the byte, 'file-truncated', 'file-unsupported' or 'mesh-too-large'. Safe on hostile input: what
 * its header announces is checked against its length before anything is allocated.
 *
 * ```ts
 * const { positions, triangles } = readPly(new Uint8Array(await file.arrayBuffer()));
 * const body = await hb.bake({ positions, triangles });
 * ```
 */
export function readPly(bytes: Uint8Array): FileMesh {
  const header = parsePlyHeader(bytes);
  const [element, ...others] = header.elements.filter(({ name }) => name === 'vertex');
  if (!element || others.length > 0) {
    throw new HandlebodyError('file-invalid', {
      message: `The PLY file has ${element ? others.length + 1 : 'no'} elements called "vertex" and should have one.`,
      remedy: 'Export the model again.',
    });
  }
  checkCounts(element.count, 0);
  const vertices = allocateVertices(element);
  const faces: Faces = { corners: new NumberList(new Uint32Array()), vertexCount: element.count };

  const rows = plyRows(bytes, header);
  for (const each of header.elements) {
    if (each === element) readVertices(rows, element, vertices);
    else if (each.name === 'face') readFaces(rows, each, faces);
    else if (each.name === 'tristrips') readStrips(rows, each, faces);
    else skipElement(rows, each);
  }
  const { positions, normals, uvs } = vertices;
  // PLY, as OBJ, counts from the bottom; glTF from the top.
  if (uvs) for (let i = 1; i < uvs.length; i += 2) uvs[i] = 1 - (uvs[i] as number);
  return {
    positions,
    triangles: faces.corners.finish(),
    normals: normals && unitRows(normals),
    uvs: uvs?.every(Number.isFinite) ? uvs : undefined,
    warnings: [],
  };
}

interface Vertices {
  readonly positions: Float32Array;
  readonly normals: Float32Array | undefined;
  readonly uvs: Float32Array | undefined;
  /** Where each property's number goes: offset in a row of that many. */
  readonly targets: ({ readonly array: Float32Array; readonly width: number; readonly offset: number } | undefined)[];
}

function allocateVertices({ count, properties }: PlyElement): Vertices {
  const scalars = new Set(properties.filter(({ lengthType }) => !lengthType).map(({ name }) => name));
  const missing = POSITION_NAMES.find((name) => !scalars.has(name));
  if (missing) {
    throw new HandlebodyError('file-invalid', {
      message: `The vertices of the PLY file have no ${missing}.`,
      remedy: 'Export the model again.',
    });
  }
  const allOf = (names: readonly string[]) => names.every((name) => scalars.has(name));
  const uvNames = UV_NAMES.find(allOf) ?? [];
  const positions = new Float32Array(count * 3);
  const normals = allOf(NORMAL_NAMES) ? new Float32Array(count * 3) : undefined;
  const uvs = uvNames.length > 0 ? new Float32Array(count * 2) : undefined;
  const targets = properties.map(({ name, lengthType }) => {
    if (lengthType) return undefined;
    for (const [array, names] of [
      [positions, POSITION_NAMES] as const,
      [normals, NORMAL_NAMES] as const,
      [uvs, uvNames] as const,
    ]) {
      const offset = names.indexOf(name);
      if (array && offset !== -1) return { array, width: names.length, offset };
    }
    return undefined;
  });
  return { positions, normals, uvs, targets };
}

function readVertices(rows: PlyRows, { count, properties }: PlyElement, { positions, targets }: Vertices): void {
  for (let vertex = 0; vertex < count; vertex++) {
    rows.begin(`vertex ${vertex}`);
    for (let i = 0; i < properties.length; i++) {
      const { name, type, lengthType } = properties[i] as PlyProperty;
      if (lengthType) {
        skipValues(rows, type, listLength(rows, lengthType));
        continue;
      }
      const value = rows.read(type);
      const target = targets[i];
      if (!target) continue;
      if (target.array === positions && !Number.isFinite(Math.fround(value)))
        throw rows.fail(`has no finite number for ${name} of vertex ${vertex}`);
      target.array[vertex * target.width + target.offset] = value;
    }
    rows.end();
  }
}

function readFaces(rows: PlyRows, element: PlyElement, { corners, vertexCount }: Faces): void {
  for (const [length, type] of vertexLists(rows, element)) {
    if (length < 3) throw rows.fail(`is a face of ${length} corners and needs 3`);
    const first = readVertex(rows, type, vertexCount);
    let previous = readVertex(rows, type, vertexCount);
    for (let i = 2; i < length; i++) {
      const corner = readVertex(rows, type, vertexCount);
      corners.push(first);
      corners.push(previous);
      corners.push(corner);
      previous = corner;
    }
    checkCounts(0, corners.length / 3);
  }
}

/** Strips, one after another in a list, parted by −1: every second triangle of a strip is turned round. */
function readStrips(rows: PlyRows, element: PlyElement, { corners, vertexCount }: Faces): void {
  for (const [length, type] of vertexLists(rows, element)) {
    let [a, b, place] = [-1, -1, 0];
    for (let i = 0; i < length; i++) {
      const vertex = readVertex(rows, type, vertexCount, -1);
      // Strips that repeat a vertex to turn a corner give triangles without area.
      if (place >= 2 && vertex !== -1 && a !== b && b !== vertex && a !== vertex)
        for (const corner of place % 2 === 0 ? [a, b, vertex] : [b, a, vertex]) corners.push(corner);
      [a, b, place] = [b, vertex, vertex === -1 ? 0 : place + 1];
    }
    checkCounts(0, corners.length / 3);
  }
}

/** Goes through an element's rows and stops at the list of vertices in each: its length and type, for the caller to read. */
function* vertexLists(rows: PlyRows, { name, count, properties }: PlyElement): Generator<[number, PlyType]> {
  const list = properties.find((property) => property.lengthType && FACE_LISTS.includes(property.name));
  if (!list && count > 0) {
    throw new HandlebodyError('file-invalid', {
      message: `The element ${quote(name)} of the PLY file has no list called "vertex_indices".`,
      remedy: 'Export the model again.',
    });
  }
  for (let row = 0; row < count; row++) {
    rows.begin(`${quote(name)} ${row}`);
    for (const property of properties) {
      const { type, lengthType } = property;
      const length = lengthType ? listLength(rows, lengthType) : 1;
      if (property !== list) skipValues(rows, type, length);
      else {
        rows.expect(type, length);
        yield [length, type];
      }
    }
    rows.end();
  }
}

function readVertex(rows: PlyRows, type: PlyType, end: number, least = 0): number {
  const vertex = rows.read(type);
  if (!Number.isInteger(vertex) || vertex < least || vertex >= end) throw rows.fail(`asks for vertex ${vertex} of ${end}`);
  return vertex;
}
