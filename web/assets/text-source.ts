/** Text files of whatever encoding, as UTF-8. */
import type { PassedOver } from './file-warnings.ts';
import { lineError, type TextSource } from './text-lines.ts';

const BLOCK = 1 << 20;

/**
 * A text of UTF-8 or UTF-16, with a byte-order mark or without: that of UTF-16 is told by the zeros beside its first letters. What is not
 * UTF-8, such as an umlaut of Latin-1 in a comment, does no harm.
 */
export function textSource(file: Uint8Array): TextSource {
  if (file[0] === 0xef && file[1] === 0xbb && file[2] === 0xbf)
    return { bytes: file.subarray(3), isTranscoded: false, byteOf: (at) => at + 3 };
  const encoding = utf16Of(file);
  if (!encoding) return { bytes: file, isTranscoded: false, byteOf: (at) => at };
  const bytes = transcode(file, encoding);
  // The decoder takes a mark away.
  const start = file[0] === 0 || file[1] === 0 ? 0 : 2;
  return { bytes, isTranscoded: true, byteOf: (at) => start + 2 * unitsOf(bytes.subarray(0, at)) };
}

function utf16Of(file: Uint8Array): 'utf-16le' | 'utf-16be' | undefined {
  if (file[0] === 0xff && file[1] === 0xfe) return 'utf-16le';
  if (file[0] === 0xfe && file[1] === 0xff) return 'utf-16be';
  const units = Math.min(file.length >> 1, 8);
  const isText = (byte: number | undefined) => byte !== undefined && ((byte >= 32 && byte < 127) || (byte >= 9 && byte <= 13));
  const every = (letter: 0 | 1) =>
    units >= 2 &&
    Array.from({ length: units }, (_, i) => 2 * i).every((at) => isText(file[at + letter]) && file[at + 1 - letter] === 0);
  return every(0) ? 'utf-16le' : every(1) ? 'utf-16be' : undefined;
}

function transcode(file: Uint8Array, encoding: string): Uint8Array {
  const [decoder, encoder] = [new TextDecoder(encoding), new TextEncoder()];
  const parts: Uint8Array[] = [];
  for (let start = 0; start < file.length; start += BLOCK)
    parts.push(encoder.encode(decoder.decode(file.subarray(start, start + BLOCK), { stream: start + BLOCK < file.length })));
  const bytes = new Uint8Array(parts.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}

/** How many units of UTF-16 these bytes of UTF-8 stand for. */
function unitsOf(bytes: Uint8Array): number {
  let units = 0;
  for (const byte of bytes) units += byte >= 0xf0 ? 2 : (byte & 0xc0) === 0x80 ? 0 : 1;
  return units;
}

/** Where a text ends, and how many zeros and Ctrl-Z (0x1A), with which old programs fill its end, are behind it. */
export function endOfText(bytes: Uint8Array): { readonly end: number; readonly padding: number } {
  let [end, padding] = [bytes.length, 0];
  for (; end > 0; end--) {
    const byte = bytes[end - 1] as number;
    if (byte === 0 || byte === 0x1a) padding++;
    else if (byte !== 32 && !(byte >= 9 && byte <= 13)) break;
  }
  return { end, padding };
}

/** The text without its padding, which is told. */
export function withoutPadding(source: TextSource, passed: PassedOver, format: string): TextSource {
  const { bytes } = source;
  const { end, padding } = endOfText(bytes);
  if (padding === 0) return source;
  const text = { ...source, bytes: bytes.subarray(0, end) };
  const line = () => {
    let number = 1;
    for (const byte of text.bytes) if (byte === 10) number++;
    return number;
  };
  passed.note('data-left-over', () => lineError(text, line(), { format, what: 'is followed by bytes that are no text' }), padding);
  return text;
}
