import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { checkCounts, type FileMesh, finishNormals, makeSurface, type Surface } from './file-mesh.ts';
import { PassedOver, type ReadOptions } from './file-warnings.ts';
import { NumberList } from './number-list.ts';
import { type PlyElement, type PlyHeader, type PlyProperty, type PlyType, parsePlyHeader } from './ply-header.ts';
import { listLength, type PlyRows, plyRows, skipElement } from './ply-rows.ts';
import { heldByFloat, quote, type TextSource } from './text-lines.ts';
import { textSource, withoutPadding } from './text-source.ts';
import { type FileBytes, toBytes } from './to-bytes.ts';

const FORMAT = 'PLY';
const FACE_LISTS = ['vertex_indices', 'vertex_index'];
const POSITION_NAMES: readonly string[] = ['x', 'y', 'z'];
const NORMAL_NAMES: readonly string[] = ['nx', 'ny', 'nz'];
const UV_NAMES: readonly (readonly string[])[] = [
  ['u', 'v'],
  ['s', 't'],
  ['texture_u', 'texture_v'],
];

/** Faces as they are read, of vertices below `vertexCount`. */
interface Faces {
  readonly corners: NumberList<Uint32Array>;
  readonly sizes: NumberList<Uint32Array>;
  readonly vertexCount: number;
  readonly passed: PassedOver;
}

/**
 * Reads a PLY, as text or binary of either byte order. Polygons become triangles, concave ones by ear clipping; so do triangle strips;
 * without faces it is a cloud of points. Normals and texture coordinates of the vertices are kept, other properties and elements are skipped.
 *
 * What does not matter for the surface is passed over, with one warning for each kind (`FileWarning`): bad normals and texture coordinates,
 * faces of two corners, unknown lines in the header, data behind the last element, bad vertices that no face uses. With `strict` it is
 * refused. The text may be UTF-8 or UTF-16.
 *
 * Throws 'file-invalid' naming the line or the byte, 'file-truncated', 'file-unsupported', 'mesh-too-large' or 'file-not-bytes'. Safe on
 * hostile input: what its header announces is checked against its length before anything is allocated.
 *
 * ```ts
 * const { positions, triangles } = readPly(await file.arrayBuffer());
 * const body = await hb.bake({ positions, triangles });
 * ```
 */
export function readPly(bytes: FileBytes, options: ReadOptions = {}): FileMesh {
  const passed = new PassedOver(options);
  const whole = textSource(toBytes(bytes));
  const header = parsePlyHeader(whole, passed);
  const source = header.format === 'ascii' ? withoutPadding(whole, passed, FORMAT) : whole;
  const [element, ...others] = header.elements.filter(({ name }) => name === 'vertex');
  if (!element || others.length > 0) {
    throw new HandlebodyError('file-invalid', {
      message: `The PLY file's header, of ${header.firstLine - 1} lines, has ${element ? others.length + 1 : 'no'} elements called "vertex" and should have one.`,
      remedy: 'Export the model again.',
    });
  }
  checkCounts(element.count, 0);
  const vertices = allocateVertices(element);
  const faces: Faces = {
    corners: new NumberList(new Uint32Array()),
    sizes: new NumberList(new Uint32Array()),
    vertexCount: element.count,
    passed,
  };

  const rows = plyRows(source, header, passed);
  for (const each of header.elements) {
    if (each === element) readVertices(rows, element, vertices);
    else if (each.name === 'face') readFaces(rows, each, faces);
    else if (each.name === 'tristrips') readStrips(rows, each, faces);
    else skipElement(rows, each);
  }
  rows.close();
  const surface = makeSurface({
    format: FORMAT,
    positions: vertices.positions,
    corners: faces.corners.finish(),
    sizes: faces.sizes.finish(),
    hasFaces: header.elements.some(({ name, count }) => (name === 'face' || name === 'tristrips') && count > 0),
    passed,
    badVertex: (vertex) => badVertex(source, header, element, vertex),
  });
  noteLeftOut(header, element, vertices, passed);
  return { ...surface, ...finishAttributes(vertices, surface, passed), warnings: passed.warnings() };
}

interface Vertices {
  readonly positions: Float64Array;
  readonly normals: Float32Array | undefined;
  readonly uvs: Float32Array | undefined;
  /** Where each property's number goes: offset in a row of that many. */
  readonly targets: (
    | { readonly array: Float64Array | Float32Array; readonly width: number; readonly offset: number }
    | undefined
  )[];
}

function allocateVertices({ count, line, properties }: PlyElement): Vertices {
  const scalars = new Set(properties.filter(({ lengthType }) => !lengthType).map(({ name }) => name));
  const missing = POSITION_NAMES.find((name) => !scalars.has(name));
  if (missing) {
    throw new HandlebodyError('file-invalid', {
      message: `The vertices of the PLY file (line ${line}) have no ${missing}.`,
      remedy: 'Export the model again.',
    });
  }
  const allOf = (names: readonly string[]) => names.every((name) => scalars.has(name));
  const uvNames = UV_NAMES.find(allOf) ?? [];
  const positions = new Float64Array(count * 3);
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

function readVertices(rows: PlyRows, { count, properties }: PlyElement, { targets }: Vertices): void {
  for (let vertex = 0; vertex < count; vertex++) {
    rows.begin('vertex', vertex);
    for (let i = 0; i < properties.length; i++) {
      const { type, lengthType } = properties[i] as PlyProperty;
      const target = targets[i];
      if (!target) {
        rows.skip(type, lengthType ? listLength(rows, lengthType) : 1);
        continue;
      }
      const value = rows.read(type);
      target.array[vertex * target.width + target.offset] = heldByFloat(value);
    }
    rows.end();
  }
}

/** The error for a vertex without a place: the file is read again as far as there, so that no place has to be kept for all. */
function badVertex(source: TextSource, header: PlyHeader, element: PlyElement, vertex: number): HandlebodyError {
  const rows = plyRows(source, header, new PassedOver({}));
  for (const each of header.elements.slice(0, header.elements.indexOf(element))) skipElement(rows, each);
  skipElement(rows, { ...element, count: vertex });
  rows.begin('vertex', vertex);
  for (const { name, type, lengthType } of element.properties) {
    if (lengthType || !POSITION_NAMES.includes(name)) rows.skip(type, lengthType ? listLength(rows, lengthType) : 1);
    else if (Number.isNaN(heldByFloat(rows.read(type)))) return rows.fail(`has no finite number for ${name} of vertex ${vertex}`);
  }
  return rows.fail(`has no place for vertex ${vertex}`);
}

/** Says that there is more in the file than is read: colors, texture coordinates of corners, and the like. */
function noteLeftOut({ elements }: PlyHeader, vertex: PlyElement, { targets }: Vertices, passed: PassedOver): void {
  const faces = elements.filter(({ name, properties }) => name === 'face' && properties.length > 1);
  const counts = [...faces.map(({ count }) => count), targets.includes(undefined) ? vertex.count : 0];
  const count = counts.reduce((sum, each) => sum + each, 0);
  // Strict reading takes what a header announces, so that this reason is never given.
  const refusal = () =>
    new HandlebodyError('file-unsupported', { message: 'The PLY file has other properties.', remedy: 'Leave them out.' });
  if (count > 0) passed.note('attributes-left-out', refusal, count);
}

function finishAttributes({ normals, uvs }: Vertices, surface: Surface, passed: PassedOver): Pick<FileMesh, 'normals' | 'uvs'> {
  const refusal = (vertex: number, what: string) => () =>
    new HandlebodyError('file-invalid', {
      message: `Vertex ${vertex} of the PLY file has ${what}.`,
      remedy: 'Export the model again, or read it without "strict".',
      culprit: { kind: 'vertex', index: vertex },
    });
  if (normals)
    finishNormals(normals, surface, (vertex) => passed.note('normals-bad', refusal(vertex, 'a normal that is no direction')));
  let hasBad = false;
  for (let i = 0; uvs && i < uvs.length; i += 2) {
    const isGood = Number.isFinite((uvs[i] as number) + (uvs[i + 1] as number));
    if (!isGood) passed.note('uvs-bad', refusal(i / 2, 'a texture coordinate that is no number'));
    hasBad ||= !isGood;
    // PLY, as OBJ, counts from the bottom; glTF from the top.
    uvs[i + 1] = 1 - (uvs[i + 1] as number);
  }
  return { normals, uvs: hasBad ? undefined : uvs };
}

function readFaces(rows: PlyRows, element: PlyElement, { corners, sizes, vertexCount, passed }: Faces): void {
  for (const [length, type] of vertexLists(rows, element)) {
    if (length < 3) {
      passed.note('faces-degenerate', () => rows.fail(`is a face of ${length} corners and needs 3`));
      rows.skip(type, length);
      continue;
    }
    for (let i = 0; i < length; i++) corners.push(readVertex(rows, type, vertexCount));
    sizes.push(length);
    checkCounts(0, corners.length - 2 * sizes.length);
  }
}

/** Strips, one after another in a list, parted by −1: every second triangle of a strip is turned round. */
function readStrips(rows: PlyRows, element: PlyElement, { corners, sizes, vertexCount }: Faces): void {
  for (const [length, type] of vertexLists(rows, element)) {
    let [a, b, place] = [-1, -1, 0];
    for (let i = 0; i < length; i++) {
      const vertex = readVertex(rows, type, vertexCount, -1);
      // Strips that repeat a vertex to turn a corner give triangles without area.
      if (place >= 2 && vertex !== -1 && a !== b && b !== vertex && a !== vertex) {
        for (const corner of place % 2 === 0 ? [a, b, vertex] : [b, a, vertex]) corners.push(corner);
        sizes.push(3);
      }
      [a, b, place] = [b, vertex, vertex === -1 ? 0 : place + 1];
    }
    checkCounts(0, sizes.length);
  }
}

/** Goes through an element's rows and stops at the list of vertices in each: its length and type, for the caller to read. */
function* vertexLists(rows: PlyRows, { name, count, line, properties }: PlyElement): Generator<[number, PlyType]> {
  const list = properties.find((property) => property.lengthType && FACE_LISTS.includes(property.name));
  if (!list && count > 0) {
    throw new HandlebodyError('file-invalid', {
      message: `The element ${quote(name)} of the PLY file (line ${line}) has no list called "vertex_indices".`,
      remedy: 'Export the model again.',
    });
  }
  const what = quote(name);
  for (let row = 0; row < count; row++) {
    rows.begin(what, row);
    for (const property of properties) {
      const { type, lengthType } = property;
      const length = lengthType ? listLength(rows, lengthType) : 1;
      if (property !== list) rows.skip(type, length);
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
