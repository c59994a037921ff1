/** The data of a PLY, value by value, whichever of its three formats holds it. */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { PassedOver } from './file-warnings.ts';
import type { PlyElement, PlyHeader, PlyType } from './ply-header.ts';
import { plyBytes } from './ply-header.ts';
import { lineError, parseDecimal, quote, type TextSource, textLines, wordsOf } from './text-lines.ts';

/** Reads rows in the file's order. Every read was checked to lie in the file. */
export interface PlyRows {
  /** Goes to the next row; `what` and its number name it for errors. */
  begin(what: string, row: number): void;
  /** A number; NaN for a word of a text that is none. */
  read(type: PlyType): number;
  skip(type: PlyType, count: number): void;
  /** Asks that `count` more values of a type can be there, before they are asked for one by one. */
  expect(type: PlyType, count: number): void;
  /** The row is over: what a text has more in it is passed over. */
  end(): void;
  /** All rows are over, and so should be the file. */
  close(): void;
  /** An error at where the reading is. */
  fail(what: string): HandlebodyError;
}

export function plyRows(source: TextSource, header: PlyHeader, passed: PassedOver): PlyRows {
  return header.format === 'ascii' ? new TextRows(source, header, passed) : new BinaryRows(source, header, passed);
}

class TextRows implements PlyRows {
  readonly #source: TextSource;
  readonly #passed: PassedOver;
  readonly #lines: ReturnType<typeof textLines>;
  #line: number;
  #words: string[] = [];
  #next = 0;

  constructor(source: TextSource, { start, firstLine }: PlyHeader, passed: PassedOver) {
    this.#source = source;
    this.#passed = passed;
    this.#line = firstLine;
    this.#lines = textLines(source.bytes.subarray(start), firstLine);
  }

  begin(what: string, row: number): void {
    for (let line = this.#lines.next(); !line.done; line = this.#lines.next()) {
      this.#line = line.value.number;
      const text = line.value.text.trim();
      if (text === '') continue;
      this.#words = wordsOf(text);
      this.#next = 0;
      return;
    }
    throw new HandlebodyError('file-truncated', {
      message: `The PLY file ends after line ${this.#line}, before ${what} ${row}.`,
      remedy: 'Download or export it again.',
      culprit: { kind: 'byte', index: this.#source.byteOf(this.#source.bytes.length) },
    });
  }

  read(type: PlyType): number {
    this.expect(type, 1);
    return parseDecimal(this.#words[this.#next++]);
  }

  skip(type: PlyType, count: number): void {
    this.expect(type, count);
    this.#next += count;
  }

  expect(_: PlyType, count: number): void {
    if (count > this.#words.length - this.#next) throw this.fail('ends too early');
  }

  end(): void {
    if (this.#next < this.#words.length)
      this.#passed.note('numbers-left-over', () => this.fail(`has ${quote(this.#words[this.#next] ?? '')} left over`));
  }

  close(): void {
    for (const { text, number } of this.#lines) {
      const left = text.trim();
      if (left === '') continue;
      this.#line = number;
      this.#passed.note('data-left-over', () => this.fail(`has ${quote(left)} left over`), left.length);
    }
  }

  fail(what: string): HandlebodyError {
    return lineError(this.#source, this.#line, { format: 'PLY', what });
  }
}

class BinaryRows implements PlyRows {
  readonly #view: DataView;
  readonly #little: boolean;
  readonly #passed: PassedOver;
  readonly #byteOf: (at: number) => number;
  #offset: number;
  #what = '';
  #row = 0;

  constructor({ bytes, byteOf }: TextSource, { start, format }: PlyHeader, passed: PassedOver) {
    this.#view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.#little = format === 'binary_little_endian';
    this.#passed = passed;
    this.#byteOf = byteOf;
    this.#offset = start;
  }

  begin(what: string, row: number): void {
    this.#what = what;
    this.#row = row;
  }

  read(type: PlyType): number {
    const [view, at, little] = [this.#view, this.#offset, this.#little];
    const end = at + plyBytes(type);
    if (end > view.byteLength) throw this.#truncated();
    this.#offset = end;
    switch (type) {
      case 'char':
        return view.getInt8(at);
      case 'uchar':
        return view.getUint8(at);
      case 'short':
        return view.getInt16(at, little);
      case 'ushort':
        return view.getUint16(at, little);
      case 'int':
        return view.getInt32(at, little);
      case 'uint':
        return view.getUint32(at, little);
      case 'float':
        return view.getFloat32(at, little);
      case 'double':
        return view.getFloat64(at, little);
    }
  }

  skip(type: PlyType, count: number): void {
    this.expect(type, count);
    this.#offset += count * plyBytes(type);
  }

  expect(type: PlyType, count: number): void {
    if (count * plyBytes(type) > this.#view.byteLength - this.#offset) throw this.#truncated();
  }

  end(): void {}

  close(): void {
    const left = this.#view.byteLength - this.#offset;
    if (left === 0) return;
    this.#passed.note('data-left-over', () => this.fail(`is followed by ${left} bytes`), left);
  }

  fail(what: string): HandlebodyError {
    return new HandlebodyError('file-invalid', {
      message: `The PLY file's ${this.#what} ${this.#row}, before byte ${this.#byteOf(this.#offset)}, ${what}.`,
      remedy: 'The file is damaged: download or export it again.',
      culprit: { kind: 'byte', index: this.#byteOf(this.#offset) },
    });
  }

  #truncated(): HandlebodyError {
    return new HandlebodyError('file-truncated', {
      message: `The PLY file ends within ${this.#what} ${this.#row}, at byte ${this.#byteOf(this.#view.byteLength)}.`,
      remedy: 'Download or export it again.',
      culprit: { kind: 'byte', index: this.#byteOf(this.#view.byteLength) },
    });
  }
}

/** Reads past an element, row by row. */
export function skipElement(rows: PlyRows, { name, count, properties }: PlyElement): void {
  const what = quote(name);
  for (let row = 0; row < count; row++) {
    rows.begin(what, row);
    for (const { type, lengthType } of properties) rows.skip(type, lengthType ? listLength(rows, lengthType) : 1);
    rows.end();
  }
}

export function listLength(rows: PlyRows, type: PlyType): number {
  const length = rows.read(type);
  if (!(Number.isInteger(length) && length >= 0)) throw rows.fail(`has a list of ${length} numbers`);
  return length;
}
