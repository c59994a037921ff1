import type { HandlebodyError } from '../../wasm/ts/errors.ts';
import { checkCounts, type FileMesh, finishNormals, makeSurface } from './file-mesh.ts';
import { PassedOver, type ReadOptions } from './file-warnings.ts';
import { NumberList } from './number-list.ts';
import { perVertex } from './obj-attributes.ts';
import { statements } from './obj-statements.ts';
import { lineError, parseDecimal, quote, type TextSource, wordsOf } from './text-lines.ts';
import { textSource, withoutPadding } from './text-source.ts';
import { type FileBytes, toBytes } from './to-bytes.ts';

/** Statements of the format that say nothing about the surface's triangles. */
const IGNORED = new Set(
  (
    'vp p l o g s mg usemtl mtllib usemap maplib bevel c_interp d_interp lod shadow_obj trace_obj ctech stech cstype deg bmat step ' +
    'curv curv2 surf parm trim hole scrv sp end con call csh'
  ).split(' '),
);
/** Of these, the ones that carry shapes which are left out. */
const LEFT_OUT = new Set(['l', 'p', 'curv', 'curv2', 'surf']);

const FORMAT = 'OBJ';
const WIDTHS = { vt: 2, vn: 3 } as const;

/**
 * Reads a Wavefront OBJ. Its vertices are the `v` lines, in their order and all of them, so that vertex 0 of the mesh is the first `v` line.
 * Polygons become triangles, concave ones by ear clipping. Groups and materials are ignored. Normals and texture coordinates are kept where
 * every vertex has only one; where they differ from face to face they are left out, with a warning.
 *
 * What does not matter for the surface is passed over, with one warning for each kind (`FileWarning`): bad normals and texture coordinates,
 * faces of two corners, unknown statements, bad vertices that no face uses. With `strict` it is refused. Text may be UTF-8 or UTF-16.
 *
 * Throws 'file-invalid' naming the line, 'mesh-too-large' or 'file-not-bytes'. Safe on hostile input: it takes memory by what the file's
 * lines hold.
 *
 * ```ts
 * const { positions, triangles } = readObj(await file.arrayBuffer());
 * const body = await hb.bake({ positions, triangles });
 * ```
 */
export function readObj(bytes: FileBytes, options: ReadOptions = {}): FileMesh {
  const passed = new PassedOver(options);
  const source = withoutPadding(textSource(toBytes(bytes)), passed, FORMAT);
  const fail = (line: number, what: string) => lineError(source, line, { format: FORMAT, what });
  const positions = new NumberList(new Float64Array());
  const lists = { vt: new NumberList(new Float32Array()), vn: new NumberList(new Float32Array()) };
  // Numbers of all corners; 0 stands for none in `vt` and `vn`.
  const corners = {
    v: new NumberList(new Uint32Array()),
    vt: new NumberList(new Uint32Array()),
    vn: new NumberList(new Uint32Array()),
  };
  const sizes = new NumberList(new Uint32Array());
  // Faces may come before their vertices: the largest number asked for, and where, is compared at the end.
  const largest = { v: { number: 0, line: 0 }, vt: { number: 0, line: 0 }, vn: { number: 0, line: 0 } };
  let hasFaces = false;

  const readVertex = (words: string[], line: number) => {
    for (let i = 1; i <= 3; i++) positions.push(parseDecimal(words[i]));
    if (words.length > 4)
      passed.note('attributes-left-out', () => fail(line, `has ${words.length - 1} numbers after "v", of which 3 are read`));
    checkCounts(positions.length / 3, 0);
  };

  const readRow = (name: 'vt' | 'vn', words: string[], line: number) => {
    // A texture coordinate may have one number only.
    const needed = name === 'vt' ? 1 : 3;
    let [isBad, size] = [false, 0];
    for (let i = 1; i <= WIDTHS[name]; i++) {
      const value = i <= needed || i < words.length ? parseDecimal(words[i]) : 0;
      if (Number.isNaN(value)) isBad = true;
      size += Math.abs(value);
      lists[name].push(value);
    }
    if (isBad || (name === 'vn' && size === 0))
      passed.note(name === 'vt' ? 'uvs-bad' : 'normals-bad', () => fail(line, describeBad(words, needed)));
  };

  const resolve = (name: 'v' | 'vt' | 'vn', word: string, line: number): number => {
    const count = name === 'v' ? positions.length / 3 : lists[name].length / WIDTHS[name];
    const value = Number(word);
    const given = /^[+-]?\d{1,15}$/.test(word) ? value : 0;
    const number = given < 0 ? count + 1 + given : given;
    if (number < 1) {
      const refusal = () => fail(line, `asks for ${name} ${quote(word)}, and there is no such one`);
      if (name === 'v') throw refusal();
      passed.note(name === 'vt' ? 'uvs-bad' : 'normals-bad', refusal);
      return 0;
    }
    if (number > largest[name].number) largest[name] = { number, line };
    return number;
  };

  const readFace = (words: string[], line: number) => {
    hasFaces = true;
    const size = words.length - 1;
    if (size < 3) {
      passed.note('faces-degenerate', () => fail(line, `has a face of ${size} corners and needs 3`));
      return;
    }
    for (let i = 1; i <= size; i++) {
      const word = words[i] as string;
      const [v = '', vt = '', vn = '', ...rest] = word.includes('/') ? word.split('/') : [word];
      if (rest.length > 0) throw fail(line, `has ${quote(word)} where a corner such as 1, 1/2, 1//3 or 1/2/3 should be`);
      corners.v.push(resolve('v', v, line) - 1);
      corners.vt.push(vt === '' ? 0 : resolve('vt', vt, line));
      corners.vn.push(vn === '' ? 0 : resolve('vn', vn, line));
    }
    sizes.push(size);
    checkCounts(0, corners.v.length - 2 * sizes.length);
  };

  for (const { text, line } of statements(source)) {
    const words = wordsOf(text);
    const keyword = words[0] as string;
    if (keyword === 'v') readVertex(words, line);
    else if (keyword === 'vt' || keyword === 'vn') readRow(keyword, words, line);
    else if (keyword === 'f' || keyword === 'fo') readFace(words, line);
    else if (LEFT_OUT.has(keyword)) passed.note('shapes-left-out', () => fail(line, `begins with ${quote(keyword)}`));
    else if (!IGNORED.has(keyword))
      passed.note('statements-unknown', () => fail(line, `begins with ${quote(keyword)}, which is no OBJ statement`));
  }

  const vertices = positions.length / 3;
  if (largest.v.number > vertices && vertices > 0)
    throw fail(largest.v.line, `asks for v ${largest.v.number}, and the file has ${vertices}`);
  const surface = makeSurface({
    format: FORMAT,
    positions: positions.finish(),
    corners: corners.v.finish(),
    sizes: sizes.finish(),
    hasFaces,
    passed,
    badVertex: (vertex) => badVertex(source, vertex),
  });

  const attribute = (name: 'vt' | 'vn'): Float32Array | undefined => {
    const { number, line } = largest[name];
    const refuse = (what: string) => () => fail(line, what);
    const [split, bad] = name === 'vt' ? (['uvs-split', 'uvs-bad'] as const) : (['normals-split', 'normals-bad'] as const);
    const found = perVertex({ list: lists[name], width: WIDTHS[name], numbers: corners[name], corners: corners.v, vertices });
    const { missing, differing } = found;
    if (missing > 0)
      passed.note(bad, refuse(`asks for ${name} ${number}, and the file has ${lists[name].length / WIDTHS[name]}`), missing);
    if (differing > 0) passed.note(split, refuse(`is at a seam`), differing);
    return found.rows;
  };
  const [uvs, normals] = [attribute('vt'), attribute('vn')];
  // OBJ counts from the bottom, glTF from the top.
  if (uvs) for (let i = 1; i < uvs.length; i += 2) uvs[i] = 1 - (uvs[i] as number);
  return {
    ...surface,
    normals: normals && finishNormals(normals, surface),
    uvs: uvs?.every(Number.isFinite) ? uvs : undefined,
    warnings: passed.warnings(),
  };
}

/** What is wrong with the numbers of a statement. */
function describeBad(words: readonly string[], needed: number): string {
  if (words.length <= needed) return `has ${words.length - 1} numbers after "${words[0]}" and needs ${needed}`;
  const bad = words.slice(1, 4).find((word) => Number.isNaN(parseDecimal(word)));
  return bad === undefined ? `has a "${words[0]}" without a direction` : `has ${quote(bad)} where a finite number should be`;
}

/** The error for a vertex without a place: its statement is looked for again, so that none has to be kept for all. */
function badVertex(source: TextSource, vertex: number): HandlebodyError {
  let before = 0;
  for (const { text, line } of statements(source)) {
    const words = wordsOf(text);
    if (words[0] === 'v' && before++ === vertex) return lineError(source, line, { format: FORMAT, what: describeBad(words, 3) });
  }
  throw new Error(`no vertex ${vertex}`);
}
