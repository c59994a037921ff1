/** The header of a PLY: which elements follow, of which properties, and that the file is long enough to hold them. */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { PassedOver } from './file-warnings.ts';
import { lineError, quote, type TextSource, textLines } from './text-lines.ts';

/** Bytes of each scalar type, under both of its names. */
const BYTES = {
  char: 1,
  uchar: 1,
  short: 2,
  ushort: 2,
  int: 4,
  uint: 4,
  float: 4,
  double: 8,
} as const;

export type PlyType = keyof typeof BYTES;

const OTHER_NAMES: Record<string, PlyType> = {
  int8: 'char',
  uint8: 'uchar',
  int16: 'short',
  uint16: 'ushort',
  int32: 'int',
  uint32: 'uint',
  float32: 'float',
  float64: 'double',
};

export interface PlyProperty {
  readonly name: string;
  readonly type: PlyType;
  /** Of a list: the type that its length is stored as. */
  readonly lengthType: PlyType | undefined;
}

export interface PlyElement {
  readonly name: string;
  readonly count: number;
  /** Of the header. */
  readonly line: number;
  readonly properties: PlyProperty[];
}

export interface PlyHeader {
  readonly format: 'ascii' | 'binary_little_endian' | 'binary_big_endian';
  readonly elements: readonly PlyElement[];
  /** Where the data begins: byte, and line of a text. */
  readonly start: number;
  readonly firstLine: number;
}

/** Real headers have some hundred bytes. */
const MAX_HEADER = 1 << 16;

/**
 * Throws 'file-invalid' naming the line, 'file-unsupported' for another version, 'file-truncated' when the elements that it announces
 * cannot lie in the bytes that follow.
 */
export function parsePlyHeader(source: TextSource, passed: PassedOver): PlyHeader {
  const { bytes } = source;
  const head = bytes.subarray(0, MAX_HEADER);
  const fail = (line: number, what: string) => lineError(source, line, { format: 'PLY', what });
  let format: PlyHeader['format'] | undefined;
  const elements: PlyElement[] = [];
  for (const { text, number } of textLines(head)) {
    const words = text.trim().split(/\s+/);
    const [keyword = '', ...rest] = words;
    if (number === 1) {
      if (text.trimEnd() !== 'ply') throw fail(1, `is ${quote(text)} and should be "ply"`);
    } else if (keyword === 'format') format = parseFormat(rest, number, (what) => fail(number, what));
    else if (keyword === 'element') {
      const count = Number(rest[1]);
      if (rest.length !== 2 || !/^\d+$/.test(rest[1] ?? '') || !Number.isSafeInteger(count))
        throw fail(number, 'should give the name of an element and how many there are');
      elements.push({ name: rest[0] as string, count, line: number, properties: [] });
    } else if (keyword === 'property') {
      const element = elements.at(-1);
      if (!element) throw fail(number, 'gives a property before any element');
      element.properties.push(parseProperty(rest, (what) => fail(number, what)));
    } else if (keyword === 'end_header') {
      if (!format) throw fail(number, 'ends a header that gives no format');
      if (source.isTranscoded && format !== 'ascii')
        throw fail(number, 'ends a header in UTF-16, in which no binary data can follow');
      const header = { format, elements, start: endOfHeader(head), firstLine: number + 1 };
      checkLength(header, source);
      return header;
    } else if (keyword !== 'comment' && keyword !== 'obj_info' && keyword !== '') {
      passed.note('statements-unknown', () => fail(number, `begins with ${quote(keyword)}, which no PLY header has`));
    }
  }
  throw new HandlebodyError('file-truncated', {
    message: `The PLY file's header does not end within its first ${head.length} bytes.`,
    remedy: 'Download or export it again.',
    culprit: { kind: 'byte', index: source.byteOf(head.length) },
  });
}

type Fail = (what: string) => HandlebodyError;

function parseFormat([name, version]: string[], line: number, fail: Fail): PlyHeader['format'] {
  if (version !== '1.0') {
    throw new HandlebodyError('file-unsupported', {
      message: `Line ${line} of the PLY file names format version ${quote(version ?? '')}; 1.0 is read.`,
      remedy: 'Export the model with a current tool.',
    });
  }
  if (name === 'ascii' || name === 'binary_little_endian' || name === 'binary_big_endian') return name;
  throw fail(`names the format ${quote(name ?? '')}, which is none of PLY's`);
}

function parseProperty(words: string[], fail: Fail): PlyProperty {
  const isList = words[0] === 'list';
  const names = isList ? words.slice(1) : words;
  if (names.length !== (isList ? 3 : 2)) throw fail('should give the type and the name of a property');
  const type = (name: string): PlyType => {
    if (Object.hasOwn(BYTES, name)) return name as PlyType;
    if (Object.hasOwn(OTHER_NAMES, name)) return OTHER_NAMES[name] as PlyType;
    throw fail(`has the type ${quote(name)}, which is none of PLY's`);
  };
  const lengthType = isList ? type(names[0] as string) : undefined;
  if (lengthType === 'float' || lengthType === 'double') throw fail('counts a list in fractions');
  return { name: names.at(-1) as string, type: type(names.at(-2) as string), lengthType };
}

/** Behind the end of the line "end_header". Where lines end in \r alone, a \n that follows is data. */
function endOfHeader(head: Uint8Array): number {
  const text = String.fromCharCode(...head.subarray(0, 5));
  const lineEnd = text.startsWith('ply\r\n') ? 2 : 1;
  const pattern = Array.from('end_header', (letter) => letter.charCodeAt(0));
  for (let at = 1; at < head.length; at++) {
    const before = head[at - 1];
    if ((before !== 10 && before !== 13) || !pattern.every((code, i) => head[at + i] === code)) continue;
    let end = at + pattern.length;
    while (end < head.length && head[end] !== 10 && head[end] !== 13) end++;
    return Math.min(end + (head[end] === 13 && head[end + 1] === 10 ? lineEnd : 1), head.length);
  }
  return head.length;
}

/** The fewest bytes that the announced elements take, against those that are there: before anything is allocated. */
function checkLength({ format, elements, start }: PlyHeader, source: TextSource): void {
  const { length } = source.bytes;
  let needed = start;
  for (const { name, count, line, properties } of elements) {
    if (properties.length === 0 && count > 0) {
      throw new HandlebodyError('file-invalid', {
        message: `The PLY file's element ${quote(name)} (line ${line}) has no properties.`,
        remedy: 'Export the model again.',
      });
    }
    // In text: a digit and what parts it from the next, of which the last may be missing.
    const bytes = properties.reduce((sum, { type, lengthType }) => sum + (format === 'ascii' ? 2 : BYTES[lengthType ?? type]), 0);
    needed += count * bytes;
  }
  if (needed - (format === 'ascii' ? 1 : 0) <= length) return;
  throw new HandlebodyError('file-truncated', {
    message: `The PLY file announces at least ${needed} bytes, and has ${length}.`,
    remedy: 'Download or export it again.',
    culprit: { kind: 'byte', index: source.byteOf(length) },
  });
}

/** Bytes that a property of this type takes. */
export const plyBytes = (type: PlyType): number => BYTES[type];
