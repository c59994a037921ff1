/** Something to know about a file that was read all the same: what stands otherwise in the document, or is not in it. */
export interface GltfWarning {
  /**
   * 'decompressed': the data was compressed, and is plain now. 'extension-lost': an unknown extension could not be kept, since it points at
   * other parts of the file by their number, or stands where nothing keeps it.
   */
  readonly code: 'decompressed' | 'extension-lost';
  readonly message: string;
  readonly remedy: string;
}

/** Where readers find what lies outside the file, and whom they tell what they changed. */
export interface GltfReadOptions {
  /**
   * Gives a file that the model names, relative to it: `uri` without percent signs, and where that is not found (undefined, or an error)
   * as it stands in the model. An image that is undefined both times stays a name; a buffer has to be there.
   */
  readonly resource?: ((uri: string, kind: 'buffer' | 'image') => Promise<Uint8Array | ArrayBuffer | undefined>) | undefined;
  readonly onWarning?: ((warning: GltfWarning) => void) | undefined;
}

export function decompressed(by: string): GltfWarning {
  return {
    code: 'decompressed',
    message: `The model was compressed by ${by}; its data is plain now, bit for bit as it was decoded.`,
    remedy: 'Nothing is lost. Compressing it again after baking would change vertices: bake last.',
  };
}
