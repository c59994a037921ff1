/** What readers take: any view of bytes, or the memory itself. */
export type Bytes = ArrayBufferLike | ArrayBufferView;

/** The bytes themselves; the memory is shared, not copied. */
export function asBytes(bytes: Bytes): Uint8Array {
  if (bytes instanceof Uint8Array) return bytes;
  return ArrayBuffer.isView(bytes) ? new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength) : new Uint8Array(bytes);
}
