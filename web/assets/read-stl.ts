import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { checkCounts, type FileMesh, makeSurface } from './file-mesh.ts';
import { PassedOver, type ReadOptions } from './file-warnings.ts';
import { NumberList } from './number-list.ts';
import { heldByFloat, lineError, parseDecimal, quote, type TextSource, textLines, wordsOf } from './text-lines.ts';
import { textSource, withoutPadding } from './text-source.ts';
import { type FileBytes, toBytes } from './to-bytes.ts';

const FORMAT = 'STL';
/** A header of 80 bytes that says nothing, and how many triangles follow, of 50 bytes each: normal, three corners, two bytes of whatever. */
const [COUNT_AT, START, ROW, FIRST_CORNER, REST] = [80, 84, 50, 12, 48];

/** What old programs end a text with. */
const CTRL_Z = 0x1a;

/** Corners as they are read: each has a vertex of its own. */
interface Corners {
  readonly positions: Float64Array;
  readonly sizes: Uint32Array;
  readonly badVertex: (vertex: number) => HandlebodyError;
}

/**
 * Reads an STL, text or binary: which it is, its length and its words say, not its first letters, which both kinds may share. The format
 * gives each triangle corners of its own; corners at exactly one place, as floats, become one vertex, so that the mesh is connected, in the
 * order in which they come. All solids of a file become one mesh. Normals are left out, since they are those of the triangles; so are colors
 * in the two bytes behind a triangle.
 *
 * What does not matter for the surface is passed over, with one warning for each kind (`FileWarning`): unknown lines, loops of two corners,
 * facets outside of a solid, bytes behind the last triangle. With `strict` it is refused. Text may be UTF-8 or UTF-16.
 *
 * Throws 'file-invalid' naming the line or the byte, 'file-truncated', 'mesh-too-large' or 'file-not-bytes'. Safe on hostile input: what a
 * binary file announces is checked against its length before anything is allocated.
 *
 * ```ts
 * const { positions, triangles } = readStl(await file.arrayBuffer());
 * const body = await hb.bake({ positions, triangles });
 * ```
 */
export function readStl(bytes: FileBytes, options: ReadOptions = {}): FileMesh {
  const passed = new PassedOver(options);
  const file = toBytes(bytes);
  const { positions, sizes, badVertex } = isBinaryStl(file)
    ? readBinary(file, passed)
    : readText(withoutPadding(textSource(file), passed, FORMAT), passed);
  const surface = makeSurface({
    format: FORMAT,
    positions,
    corners: new Uint32Array(positions.length / 3).map((_, i) => i),
    sizes,
    hasFaces: true,
    passed,
    badVertex,
    join: true,
  });
  return { ...surface, normals: undefined, uvs: undefined, warnings: passed.warnings() };
}

/**
 * Whether an STL is binary: then it has exactly the length that it announces. One that has not, since it was cut off or something follows, is
 * told from a text by letters that no text has, or the words that a text cannot do without.
 */
function isBinaryStl(bytes: Uint8Array): boolean {
  if (isExact(bytes)) return true;
  const { bytes: text, isTranscoded } = textSource(bytes);
  const head = text.subarray(0, 1000);
  if (isTranscoded || /\b(facet|endsolid)\b/i.test(String.fromCharCode(...head))) return false;
  return head.some((letter) => letter < 32 && !(letter >= 9 && letter <= 13) && letter !== CTRL_Z);
}

/** Whether bytes have exactly the length that they announce as a binary STL with triangles. */
export function isExact(bytes: Uint8Array): boolean {
  return bytes.length > START && bytes.length === START + ROW * countOf(bytes);
}

const viewOf = (bytes: Uint8Array) => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
const countOf = (bytes: Uint8Array) => viewOf(bytes).getUint32(COUNT_AT, true);

function readBinary(bytes: Uint8Array, passed: PassedOver): Corners {
  const count = bytes.length < START ? 1 : countOf(bytes);
  const end = START + ROW * count;
  if (end > bytes.length) {
    throw new HandlebodyError('file-truncated', {
      message: `The STL file announces at least ${end} bytes, and has ${bytes.length}.`,
      remedy: 'Download or export it again.',
      culprit: { kind: 'byte', index: bytes.length },
    });
  }
  checkCounts(3 * count, count);
  const fail = (at: number, what: string) =>
    new HandlebodyError('file-invalid', {
      message: `The STL file ${what}, at byte ${at}.`,
      remedy: 'Export the model again.',
      culprit: { kind: 'byte', index: at },
    });
  const view = viewOf(bytes);
  const positions = new Float64Array(9 * count);
  let out = 0;
  for (let start = START; start < end; start += ROW) {
    for (let i = 0; i < 9; i++) {
      positions[out++] = heldByFloat(view.getFloat32(start + FIRST_CORNER + 4 * i, true));
    }
    if (view.getUint16(start + REST, true) !== 0) passed.note('attributes-left-out', () => fail(start + REST, 'has a color'));
  }
  const left = bytes.length - end;
  if (left > 0) passed.note('data-left-over', () => fail(end, `goes on for ${left} bytes behind its last triangle`), left);
  const badVertex = (vertex: number) => {
    const at = START + ROW * Math.floor(vertex / 3) + FIRST_CORNER + 12 * (vertex % 3);
    return fail(at, `has a corner without a finite position in triangle ${Math.floor(vertex / 3)}`);
  };
  return { positions, sizes: new Uint32Array(count).fill(3), badVertex };
}

function readText(source: TextSource, passed: PassedOver): Corners {
  const [positions, sizes] = [new NumberList(new Float64Array()), new NumberList(new Uint32Array())];
  const lines = new NumberList(new Uint32Array());
  const fail = (line: number, what: string) => lineError(source, line, { format: FORMAT, what });
  // Corners of the loop that is being read; −1 outside.
  let [loop, isOpen, last] = [-1, false, 1];
  const closeLoop = () => {
    const [size, line] = [loop, last];
    loop = -1;
    if (size >= 3) {
      sizes.push(size);
      checkCounts(positions.length / 3, positions.length / 3 - 2 * sizes.length);
    } else if (size !== -1) {
      passed.note('faces-degenerate', () => fail(line, `ends a loop of ${size} corners, which needs 3`));
      positions.length -= 3 * size;
      lines.length -= size;
    }
  };
  for (const { text, number } of textLines(source.bytes)) {
    const words = wordsOf(text.trim());
    last = number;
    for (let i = 0; i < words.length; i++) {
      const word = (words[i] as string).toLowerCase();
      if (word === 'vertex') {
        loop = Math.max(loop, 0) + 1;
        for (let k = 1; k <= 3; k++) positions.push(parseDecimal(words[i + k]));
        lines.push(number);
        i += 3;
      } else if (word === 'facet') {
        closeLoop();
        if (!isOpen) passed.note('keyword-missing', () => fail(number, 'begins a facet outside of any solid'));
        // The normal is passed over, whatever its numbers are.
        if (words[i + 1]?.toLowerCase() === 'normal') i += 4;
      } else if (word === 'outer' || word === 'loop' || word === '') continue;
      else if (word === 'endloop' || word === 'endfacet') closeLoop();
      else if (word === 'solid' || word === 'endsolid') {
        closeLoop();
        isOpen = word === 'solid';
        // What follows is a name, of whatever words; some files have all on one line.
        while (i + 1 < words.length && words[i + 1]?.toLowerCase() !== 'facet') i++;
      } else {
        passed.note('statements-unknown', () => fail(number, `has ${quote(words[i] as string)}, which is no word of STL`));
        break;
      }
    }
  }
  if (loop !== -1 || isOpen) {
    throw new HandlebodyError('file-truncated', {
      message: `The STL file ends within a ${loop === -1 ? 'solid' : 'facet'}, at byte ${source.byteOf(source.bytes.length)}.`,
      remedy: 'Download or export it again; where only its last line is missing, add "endsolid".',
      culprit: { kind: 'byte', index: source.byteOf(source.bytes.length) },
    });
  }
  const badVertex = (vertex: number) => fail(lines.at(vertex), 'has a vertex without three finite numbers');
  return { positions: positions.finish(), sizes: sizes.finish(), badVertex };
}
