/** Text files of any size, line by line: no string is longer than a block, since engines bound their strings far below a file's size. */
import { HandlebodyError } from '../../wasm/ts/errors.ts';

const BLOCK = 1 << 20;
const MAX_LINE = 1 << 24;
const [LF, CR] = [10, 13];

/** A text as UTF-8 without a mark, and where its bytes lie in the file. */
export interface TextSource {
  readonly bytes: Uint8Array;
  /** Whether the file's own bytes are others: such a file holds text only. */
  readonly isTranscoded: boolean;
  /** The byte of the file that a byte of the text comes from. */
  byteOf(at: number): number;
}

interface TextLine {
  readonly text: string;
  /** From 1. */
  readonly number: number;
}

/**
 * The lines of a UTF-8 text without their ends, which may be \n, \r\n or \r. `firstLine` is the number of the first.
 *
 * Throws 'file-invalid' for a line of more than 16 MiB, which no text has.
 */
export function* textLines(bytes: Uint8Array, firstLine = 1): Generator<TextLine> {
  const decoder = new TextDecoder();
  let number = firstLine;
  for (let start = 0; start < bytes.length; ) {
    let end = Math.min(start + BLOCK, bytes.length);
    if (end < bytes.length) end = afterLineEnd(bytes, start, end);
    const lines = decoder.decode(bytes.subarray(start, end)).split(/\r\n|\n|\r/);
    // A block that ends with a line's end leaves an empty rest behind it.
    if (lines.at(-1) === '') lines.pop();
    for (const text of lines) yield { text, number: number++ };
    start = end;
  }
}

/** Where a block may be cut: after its last line end, or after the first one behind it. */
function afterLineEnd(bytes: Uint8Array, start: number, end: number): number {
  const isEnd = (at: number) => bytes[at] === LF || (bytes[at] === CR && bytes[at + 1] !== LF);
  for (let at = end - 1; at >= start; at--) if (isEnd(at)) return at + 1;
  for (let at = end; at < bytes.length; at++) {
    if (isEnd(at)) return at + 1;
    if (at - start > MAX_LINE) {
      throw new HandlebodyError('file-invalid', {
        message: `The file has a line of more than ${MAX_LINE / 2 ** 20} MiB from byte ${start}, as no text has.`,
        remedy: 'It is damaged or of another format: export the model again.',
        culprit: { kind: 'byte', index: start },
      });
    }
  }
  return bytes.length;
}

/** Where a line begins, counted as `textLines` does: for errors, so that reading need not keep count. */
function byteOfLine(bytes: Uint8Array, line: number): number {
  let number = 1;
  for (let at = 0; at < bytes.length && number <= line; at++) {
    if (number === line) return at;
    if (bytes[at] === LF || (bytes[at] === CR && bytes[at + 1] !== LF)) number++;
  }
  return bytes.length;
}

/** An error that names a line of a text file. */
export function lineError(source: TextSource, line: number, { format, what }: { format: string; what: string }): HandlebodyError {
  return new HandlebodyError('file-invalid', {
    message: `Line ${line} of the ${format} file ${what}.`,
    remedy: 'Repair that line, or export the model again.',
    culprit: { kind: 'byte', index: source.byteOf(byteOfLine(source.bytes, line)) },
  });
}

/** The words of a line that begins and ends with one. By far the most lines have single blanks between words, at which text is cut fast. */
export function wordsOf(text: string): string[] {
  return /[^\S ]| {2}/.test(text) ? text.split(/\s+/) : text.split(' ');
}

/** Each digit has one place where it can stand: an expression that may cut a row of digits anywhere takes the square of a long one's time. */
const NUMBER = /^[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?$/;

/** A decimal number, or NaN: unlike `Number`, which also takes '', '0x10' and 'Infinity'. Too large for a float is NaN as well. */
export function parseDecimal(token: string | undefined): number {
  const value = token !== undefined && NUMBER.test(token) ? Number(token) : Number.NaN;
  return heldByFloat(value);
}

/** The number, or NaN where a float cannot hold it. */
export function heldByFloat(value: number): number {
  return Number.isFinite(Math.fround(value)) ? value : Number.NaN;
}

/** A word of a file as a message may show it: short, and free of control characters. */
export function quote(word: string): string {
  const printable = word.replace(/[^\x20-\x7e\u00a0-\u{10ffff}]/gu, '\ufffd');
  return `"${printable.length > 40 ? `${printable.slice(0, 40)}…` : printable}"`;
}
