import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { checkCounts, type FileMesh, finishNormals, makeSurface } from './file-mesh.ts';
import { PassedOver, type ReadOptions } from './file-warnings.ts';
import { NumberList } from './number-list.ts';
import { heldByFloat, lineError, parseDecimal, quote, type TextSource, textLines, wordsOf } from './text-lines.ts';
import { textSource, withoutPadding } from './text-source.ts';
import { type FileBytes, toBytes } from './to-bytes.ts';

const FORMAT = 'OFF';
/** The format's name, with letters before it for what a vertex has besides its position. Some writers part no number from it. */
const KEYWORD = /^((?:ST|C|N|4|n)*)OFF(\d*)$/;

/**
 * Reads an OFF as text, with or without colors (COFF), normals (NOFF) and texture coordinates (STOFF) of its vertices; the numbers of
 * vertices and faces may stand on the first line or behind it. Polygons become triangles, concave ones by ear clipping; a file without faces
 * is a cloud of points. Colors are left out, with a warning. Of vertices with four coordinates (4OFF) the first three are divided by the
 * last.
 *
 * What does not matter for the surface is passed over, with one warning for each kind (`FileWarning`): a missing "OFF" at the beginning,
 * faces of two corners, lines behind the last face, bad vertices that no face uses. With `strict` it is refused. Text may be UTF-8 or UTF-16.
 *
 * Throws 'file-invalid' naming the line, 'file-truncated', 'file-unsupported' for binary files and for vertices of any dimension (nOFF), 'mesh-too-large' or 'file-not-bytes'. Safe on hostile input: it takes memory by what the file's lines hold.
 *
 * ```ts
 * const { positions, triangles } = readOff(await file.arrayBuffer());
 * const body = await hb.bake({ positions, triangles });
 * ```
 */
export function readOff(bytes: FileBytes, options: ReadOptions = {}): FileMesh {
  const passed = new PassedOver(options);
  const source = withoutPadding(textSource(toBytes(bytes)), passed, FORMAT);
  const rows = new Rows(source);
  const kind = readKeyword(rows, passed);
  const { vertices, faces } = readCounts(rows);
  checkCounts(vertices, 0);

  const positions = new NumberList(new Float64Array());
  const normals = kind.includes('N') ? new NumberList(new Float32Array()) : undefined;
  const uvs = kind.includes('ST') ? new NumberList(new Float32Array()) : undefined;
  const size = kind.includes('4') ? 4 : 3;
  const read = size + (normals ? 3 : 0) + (uvs ? 2 : 0);
  const lines = new NumberList(new Uint32Array());
  for (let vertex = 0; vertex < vertices; vertex++) {
    const words = rows.take(read, `vertex ${vertex}`);
    const weight = size === 4 ? parseDecimal(words[3]) : 1;
    for (let k = 0; k < 3; k++) positions.push(heldByFloat(parseDecimal(words[k]) / weight));
    for (let k = size; normals && k < size + 3; k++) normals.push(parseDecimal(words[k]));
    // Behind colors, which may have three numbers or four.
    for (let k = words.length - 2; uvs && k < words.length; k++) uvs.push(parseDecimal(words[k]));
    lines.push(rows.line);
    if (words.length > read) passed.note('attributes-left-out', () => rows.fail('has a color'));
  }

  const [corners, sizes] = [new NumberList(new Uint32Array()), new NumberList(new Uint32Array())];
  for (let face = 0; face < faces; face++) {
    const size = wholeNumber(rows.take(1, `face ${face}`)[0]);
    if (size === undefined) throw rows.fail(`has ${quote(rows.words[0] ?? '')} where the number of a face’s corners should be`);
    const words = rows.more(size + 1, `face ${face}`);
    if (words.length > size + 1) passed.note('attributes-left-out', () => rows.fail('has a color'));
    if (size < 3) {
      passed.note('faces-degenerate', () => rows.fail(`has a face of ${size} corners and needs 3`));
      continue;
    }
    for (let i = 1; i <= size; i++) {
      const vertex = wholeNumber(words[i]);
      if (vertex === undefined || vertex >= vertices)
        throw rows.fail(`asks for vertex ${quote(words[i] as string)} of ${vertices}`);
      corners.push(vertex);
    }
    sizes.push(size);
    checkCounts(0, corners.length - 2 * sizes.length);
  }
  while (rows.next()) {
    const left = rows.words.join(' ');
    passed.note('data-left-over', () => rows.fail(`has ${quote(left)} left over`), left.length);
  }

  const fail = (vertex: number, what: string) => lineError(source, lines.at(vertex), { format: FORMAT, what });
  const surface = makeSurface({
    format: FORMAT,
    positions: positions.finish(),
    corners: corners.finish(),
    sizes: sizes.finish(),
    hasFaces: faces > 0,
    passed,
    badVertex: (vertex) => fail(vertex, 'has a vertex without three finite numbers'),
  });
  const pairs = uvs?.finish();
  const bad = pairs?.findIndex((x) => !Number.isFinite(x)) ?? -1;
  if (bad !== -1) passed.note('uvs-bad', () => fail(bad >> 1, 'has a texture coordinate that is no number'));
  // OFF, as OBJ, counts from the bottom; glTF from the top.
  for (let i = 1; pairs && i < pairs.length; i += 2) pairs[i] = 1 - (pairs[i] as number);
  const onBad = (vertex: number) => passed.note('normals-bad', () => fail(vertex, 'has a normal that is no direction'));
  return {
    ...surface,
    normals: normals && finishNormals(normals.finish(), surface, onBad),
    uvs: bad === -1 ? pairs : undefined,
    warnings: passed.warnings(),
  };
}

/** The words of each line that says something. A row may go over several lines, and its last line may say more. */
class Rows {
  words: string[] = [];
  line = 1;
  readonly #source: TextSource;
  readonly #lines: ReturnType<typeof textLines>;
  #isBack = false;

  constructor(source: TextSource) {
    this.#source = source;
    this.#lines = textLines(source.bytes);
  }

  /** Goes to the next line that says something; false at the end. */
  next(): boolean {
    if (this.#isBack) {
      this.#isBack = false;
      return true;
    }
    for (let line = this.#lines.next(); !line.done; line = this.#lines.next()) {
      // Within a word it begins no comment: "1.#IND" is a number that is none.
      const comment = line.value.text.search(/(?<!\S)#/);
      const text = (comment === -1 ? line.value.text : line.value.text.slice(0, comment)).trim();
      if (text === '') continue;
      this.line = line.value.number;
      this.words = wordsOf(text);
      return true;
    }
    return false;
  }

  /** The present line is the next one again. */
  putBack(): void {
    this.#isBack = true;
  }

  /** A new row of `count` words or more. */
  take(count: number, what: string): string[] {
    if (!this.next()) throw this.#truncated(what);
    return this.more(count, what);
  }

  /** The present row, with `count` words or more. */
  more(count: number, what: string): string[] {
    if (this.words.length >= count) return this.words;
    const words = this.words;
    while (words.length < count) {
      if (!this.next()) throw this.#truncated(what);
      for (const word of this.words) words.push(word);
    }
    this.words = words;
    return words;
  }

  fail(what: string): HandlebodyError {
    return lineError(this.#source, this.line, { format: FORMAT, what });
  }

  #truncated(what: string): HandlebodyError {
    return new HandlebodyError('file-truncated', {
      message: `The OFF file ends after line ${this.line}, before the end of ${what}.`,
      remedy: 'Download or export it again.',
      culprit: { kind: 'byte', index: this.#source.byteOf(this.#source.bytes.length) },
    });
  }
}

/** The letters before "OFF"; leaves in the row what follows it. */
function readKeyword(rows: Rows, passed: PassedOver): string {
  rows.take(1, 'its first line');
  const first = rows.words[0] as string;
  const [, letters, count] = KEYWORD.exec(first) ?? KEYWORD.exec(first.toUpperCase()) ?? [];
  if (letters === undefined) {
    if (wholeNumber(first) === undefined) throw rows.fail(`begins with ${quote(first)} and should begin with "OFF"`);
    passed.note('keyword-missing', () => rows.fail('should begin with "OFF"'));
    return '';
  }
  if (count) rows.words[0] = count;
  else rows.words.shift();
  const isBinary = rows.words[0]?.toUpperCase() === 'BINARY';
  if (!(isBinary || letters.includes('n'))) return letters;
  throw new HandlebodyError('file-unsupported', {
    message: `Line ${rows.line} of the file says that it is ${isBinary ? 'a binary OFF' : `of the kind ${letters}OFF, whose vertices have any number of coordinates`}; OFF, COFF, NOFF, STOFF and 4OFF are read, as text.`,
    remedy: 'Export the model as a plain OFF, PLY or GLB.',
  });
}

/** How many vertices and faces follow. A third number, that of edges, may be left out. */
function readCounts(rows: Rows): { vertices: number; faces: number } {
  const hasRest = rows.words.length > 0;
  const [vertices, faces] = (hasRest ? rows.more(2, 'its counts') : rows.take(2, 'its counts')).map(wholeNumber);
  if (vertices === undefined || faces === undefined) throw rows.fail('should give the numbers of vertices and faces');
  // Where each number has a line of its own, that of the edges is still to come: no vertex has one coordinate.
  const isShort = rows.words.length === 2;
  if (isShort && rows.next() && (rows.words as readonly string[]).length !== 1) rows.putBack();
  return { vertices, faces };
}

function wholeNumber(word: string | undefined): number | undefined {
  return word !== undefined && /^\d{1,15}$/.test(word) ? Number(word) : undefined;
}
