/** GLTFExporter reads its own blobs by the browser's FileReader, which Node has not. */
class BlobReader {
  result: ArrayBuffer | string | null = null;
  onloadend: (() => void) | null = null;

  readAsArrayBuffer(blob: Blob): void {
    void blob.arrayBuffer().then((bytes) => this.#end(bytes));
  }

  readAsDataURL(blob: Blob): void {
    void blob
      .arrayBuffer()
      .then((bytes) => this.#end(`data:application/octet-stream;base64,${Buffer.from(bytes).toString('base64')}`));
  }

  #end(result: ArrayBuffer | string): void {
    this.result = result;
    this.onloadend?.();
  }
}

export function offerFileReader(): void {
  globalThis.FileReader ??= BlobReader as unknown as typeof FileReader;
}
