/** The data of a PLY, value by value, whichever of its three formats holds it. */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { PlyElement, PlyHeader, PlyType } from './ply-header.ts';
import { plyBytes } from './ply-header.ts';
import { lineError, parseDecimal, quote, textLines } from './text-lines.ts';

/** Reads rows in the file's order. Every read was checked to lie in the file. */
export interface PlyRows {
  /** Goes to the next row; `what` names it for errors. */
  begin(what: string): void;
  read(type: PlyType): number;
  /** Asks that `count` more values of a type can be there, before they are asked for one by one. */
  expect(type: PlyType, count: number): void;
  /** The row is over: text must have no more in it. */
  end(): void;
  /** An error at where the reading is. */
  fail(what: string): HandlebodyError;
}

export function plyRows(bytes: Uint8Array, header: PlyHeader): PlyRows {
  return header.format === 'ascii' ? new TextRows(bytes, header) : new BinaryRows(bytes, header);
}

class TextRows implements PlyRows {
  readonly #bytes: Uint8Array;
  readonly #lines: ReturnType<typeof textLines>;
  #line: number;
  #words: string[] = [];
  #next = 0;

  constructor(bytes: Uint8Array, { start, firstLine }: PlyHeader) {
    this.#bytes = bytes;
    this.#line = firstLine;
    this.#lines = textLines(bytes.subarray(start), firstLine);
  }

  begin(what: string): void {
    for (let line = this.#lines.next(); !line.done; line = this.#lines.next()) {
      this.#line = line.value.number;
      const text = line.value.text.trim();
      if (text === '') continue;
      this.#words = text.split(/\s+/);
      this.#next = 0;
      return;
    }
    throw new HandlebodyError('file-truncated', {
      message: `The PLY file ends before ${what}.`,
      remedy: 'Download or export it again.',
      culprit: { kind: 'byte', index: this.#bytes.length },
    });
  }

  read(type: PlyType): number {
    const word = this.#words[this.#next++];
    if (word === undefined) throw this.fail('ends too early');
    const value = parseDecimal(word);
    // Coordinates that are no numbers are found where they are used: a file may well have them in what is skipped.
    if (type !== 'float' && type !== 'double' && !Number.isInteger(value))
      throw this.fail(`has ${quote(word)} where a whole number should be`);
    return value;
  }

  expect(_: PlyType, count: number): void {
    if (count > this.#words.length - this.#next) throw this.fail('ends too early');
  }

  end(): void {
    if (this.#next < this.#words.length) throw this.fail(`has ${quote(this.#words[this.#next] ?? '')} left over`);
  }

  fail(what: string): HandlebodyError {
    return lineError(this.#bytes, this.#line, { format: 'PLY', what });
  }
}

class BinaryRows implements PlyRows {
  readonly #view: DataView;
  readonly #little: boolean;
  #offset: number;
  #row = '';

  constructor(bytes: Uint8Array, { start, format }: PlyHeader) {
    this.#view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.#little = format === 'binary_little_endian';
    this.#offset = start;
  }

  begin(what: string): void {
    this.#row = what;
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

  expect(type: PlyType, count: number): void {
    if (count * plyBytes(type) > this.#view.byteLength - this.#offset) throw this.#truncated();
  }

  end(): void {}

  fail(what: string): HandlebodyError {
    return new HandlebodyError('file-invalid', {
      message: `The PLY file's ${this.#row}, before byte ${this.#offset}, ${what}.`,
      remedy: 'The file is damaged: download or export it again.',
      culprit: { kind: 'byte', index: this.#offset },
    });
  }

  #truncated(): HandlebodyError {
    return new HandlebodyError('file-truncated', {
      message: `The PLY file ends within ${this.#row}.`,
      remedy: 'Download or export it again.',
      culprit: { kind: 'byte', index: this.#view.byteLength },
    });
  }
}

/** Reads past an element, row by row. */
export function skipElement(rows: PlyRows, { name, count, properties }: PlyElement): void {
  for (let row = 0; row < count; row++) {
    rows.begin(`${quote(name)} ${row}`);
    for (const { type, lengthType } of properties) skipValues(rows, type, lengthType ? listLength(rows, lengthType) : 1);
    rows.end();
  }
}

export function skipValues(rows: PlyRows, type: PlyType, count: number): void {
  rows.expect(type, count);
  for (let i = 0; i < count; i++) rows.read(type);
}

export function listLength(rows: PlyRows, type: PlyType): number {
  const length = rows.read(type);
  if (length < 0) throw rows.fail(`has a list of ${length} numbers`);
  return length;
}
