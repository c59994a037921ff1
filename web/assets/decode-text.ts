import { endOfText, textSource } from './text-source.ts';

/** Text as `textSource` reads it, without the padding behind it that `endOfText` tells. Bytes that are no text become U+FFFD. */
export function decodeText(file: Uint8Array): string {
  const { bytes } = textSource(file);
  return new TextDecoder().decode(bytes.subarray(0, endOfText(bytes).end));
}
