import { checkCounts, type FileMesh, NumberList, unitRows } from './file-mesh.ts';
import { lineError, parseDecimal, quote, textLines } from './text-lines.ts';

/** Statements of the format that say nothing about the surface's triangles. */
const IGNORED = new Set(
  (
    'vp p l o g s mg usemtl mtllib usemap maplib bevel c_interp d_interp lod shadow_obj trace_obj ctech stech cstype deg bmat step ' +
    'curv curv2 surf parm trim hole scrv sp end con call csh'
  ).split(' '),
);
/** Of these, the ones that carry shapes which are left out. */
const LEFT_OUT: Record<string, string> = { l: 'lines', p: 'points', curv: 'curves', curv2: 'curves', surf: 'free-form surfaces' };

/** A statement is taken apart as a whole: real ones have some hundred letters. */
const MAX_STATEMENT = 1 << 20;

/** Corners of all triangles, as numbers into the lists of the file; 0 stands for none in `uvs` and `normals`. */
interface Corners {
  readonly vertices: NumberList<Uint32Array>;
  readonly uvs: NumberList<Uint32Array>;
  readonly normals: NumberList<Uint32Array>;
}

/**
 * Reads a Wavefront OBJ. Its vertices are the `v` lines, in their order and all of them, so that vertex 0 of the mesh is the first `v` line.
 * Polygons become fans of triangles. Groups and materials are ignored, as are the numbers behind a vertex's third. Normals and texture
 * coordinates are kept where every vertex has only one; where they differ from face to face they are left out, with a warning.
 *
 * Throws 'file-invalid' naming the line, or 'mesh-too-large'. Safe on hostile input: it takes memory by what the file's lines hold.
 *
 * ```ts
 * const { positions, triangles } = readObj(new Uint8Array(await file.arrayBuffer()));
 * const body = await hb.bake({ positions, triangles });
 * ```
 */
export function readObj(bytes: Uint8Array): FileMesh {
  const fail = (line: number, what: string) => lineError(bytes, line, { format: 'OBJ', what });
  const lists = {
    v: new NumberList(new Float32Array()),
    vt: new NumberList(new Float32Array()),
    vn: new NumberList(new Float32Array()),
  };
  const widths = { v: 3, vt: 2, vn: 3 } as const;
  const corners: Corners = {
    vertices: new NumberList(new Uint32Array()),
    uvs: new NumberList(new Uint32Array()),
    normals: new NumberList(new Uint32Array()),
  };
  // Faces may come before their vertices: the largest number asked for, and where, is compared at the end.
  const largest = { v: { number: 0, line: 0 }, vt: { number: 0, line: 0 }, vn: { number: 0, line: 0 } };
  const leftOut = new Set<string>();

  const readNumbers = (name: 'v' | 'vt' | 'vn', words: string[], line: number) => {
    // A texture coordinate may have one number only.
    const needed = name === 'vt' ? 1 : 3;
    if (words.length <= needed) throw fail(line, `has ${words.length - 1} numbers after "${name}" and needs ${needed}`);
    for (let i = 1; i <= widths[name]; i++) {
      const value = i < words.length ? parseDecimal(words[i]) : 0;
      if (Number.isNaN(value)) throw fail(line, `has ${quote(words[i] ?? '')} where a finite number should be`);
      lists[name].push(value);
    }
    if (name === 'v') checkCounts(lists.v.length / 3, 0);
  };

  const resolve = (name: 'v' | 'vt' | 'vn', word: string, line: number): number => {
    const given = /^[+-]?\d{1,15}$/.test(word) ? Number(word) : 0;
    const number = given < 0 ? lists[name].length / widths[name] + 1 + given : given;
    if (number < 1) throw fail(line, `asks for ${name} ${quote(word)}, and there is no such one`);
    if (number > largest[name].number) largest[name] = { number, line };
    return number;
  };

  const readFace = (words: string[], line: number) => {
    if (words.length < 4) throw fail(line, `has a face of ${words.length - 1} corners and needs 3`);
    const face = words.slice(1).map((word) => {
      const [v = '', vt = '', vn = '', ...rest] = word.split('/');
      if (rest.length > 0) throw fail(line, `has ${quote(word)} where a corner such as 1, 1/2, 1//3 or 1/2/3 should be`);
      return [resolve('v', v, line), vt && resolve('vt', vt, line), vn && resolve('vn', vn, line)] as const;
    });
    for (let i = 2; i < face.length; i++) {
      for (const [v, vt, vn] of [face[0], face[i - 1], face[i]] as (typeof face)[number][]) {
        corners.vertices.push(v - 1);
        corners.uvs.push(vt || 0);
        corners.normals.push(vn || 0);
      }
    }
    checkCounts(0, corners.vertices.length / 3);
  };

  for (const { text, line } of statements(bytes)) {
    const words = text.split(/\s+/);
    const keyword = words[0] as string;
    if (keyword === 'v' || keyword === 'vt' || keyword === 'vn') readNumbers(keyword, words, line);
    else if (keyword === 'f' || keyword === 'fo') readFace(words, line);
    else if (!IGNORED.has(keyword)) throw fail(line, `begins with ${quote(keyword)}, which is no OBJ statement`);
    else if (LEFT_OUT[keyword]) leftOut.add(LEFT_OUT[keyword]);
  }

  for (const name of ['v', 'vt', 'vn'] as const) {
    const count = lists[name].length / widths[name];
    const { number, line } = largest[name];
    if (number > count) throw fail(line, `asks for ${name} ${number}, and the file has ${count}`);
  }
  return assemble({ lists, corners, warnings: [...leftOut].map((what) => `The file's ${what} were left out.`) });
}

interface Assembly {
  readonly lists: Record<'v' | 'vt' | 'vn', NumberList<Float32Array>>;
  readonly corners: Corners;
  readonly warnings: string[];
}

function assemble({ lists, corners, warnings }: Assembly): FileMesh {
  const triangles = corners.vertices.finish();
  const vertices = lists.v.length / 3;
  const uvs = perVertex({ list: lists.vt, width: 2, corners: corners.uvs, triangles, vertices });
  const normals = perVertex({ list: lists.vn, width: 3, corners: corners.normals, triangles, vertices });
  if (uvs === 'differ') warnings.push('Texture coordinates that differ between the faces of a vertex were left out.');
  if (normals === 'differ') warnings.push('Normals that differ between the faces of a vertex were replaced by smooth ones.');
  // OBJ counts from the bottom, glTF from the top.
  if (uvs instanceof Float32Array) for (let i = 1; i < uvs.length; i += 2) uvs[i] = 1 - (uvs[i] as number);
  return {
    positions: lists.v.finish(),
    triangles,
    normals: normals instanceof Float32Array ? unitRows(normals) : undefined,
    uvs: uvs instanceof Float32Array ? uvs : undefined,
    warnings,
  };
}

interface Attribute {
  readonly list: NumberList<Float32Array>;
  readonly width: number;
  readonly corners: NumberList<Uint32Array>;
  readonly triangles: Uint32Array;
  readonly vertices: number;
}

/** One row a vertex, from what its corners name. Without any, or with a vertex that no face gives one: undefined. */
function perVertex({ list, width, corners, triangles, vertices }: Attribute): Float32Array | 'differ' | undefined {
  if (list.length === 0 || triangles.length === 0) return undefined;
  const chosen = new Uint32Array(vertices);
  for (let i = 0; i < triangles.length; i++) {
    const [vertex, number] = [triangles[i] as number, corners.at(i)];
    const before = chosen[vertex] as number;
    if (number === 0) return undefined;
    if (before === 0) chosen[vertex] = number;
    else if (before !== number) {
      for (let k = 0; k < width; k++) if (list.at((before - 1) * width + k) !== list.at((number - 1) * width + k)) return 'differ';
    }
  }
  const rows = new Float32Array(vertices * width);
  for (let vertex = 0; vertex < vertices; vertex++) {
    const number = chosen[vertex] as number;
    // A vertex of no face: any unit vector will do for a normal, any place for a texture coordinate.
    for (let k = 0; k < width; k++) rows[vertex * width + k] = number === 0 ? Number(k === 1) : list.at((number - 1) * width + k);
  }
  return rows;
}

/** Statements without comments and blank lines; a backslash at a line's end joins the next one. */
function* statements(bytes: Uint8Array): Generator<{ text: string; line: number }> {
  let [joined, first] = ['', 0];
  for (const { text, number } of textLines(bytes)) {
    const comment = text.indexOf('#');
    const code = (comment === -1 ? text : text.slice(0, comment)).trimEnd();
    if (joined === '') first = number;
    const goesOn = code.endsWith('\\');
    if (goesOn) joined += `${code.slice(0, -1)} `;
    if (joined.length + code.length > MAX_STATEMENT) throw lineError(bytes, first, { format: 'OBJ', what: 'says more than 1 MiB' });
    if (goesOn) continue;
    const statement = (joined + code).trim();
    joined = '';
    if (statement !== '') yield { text: statement, line: first };
  }
  if (joined.trim() !== '') yield { text: joined.trim(), line: first };
}
