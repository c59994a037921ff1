/** What readers and writers of files throw besides the codes of the solver. */
export interface FileErrorCodes {
  /** No GLB, where one was expected. */
  'file-not-glb': true;
  /** No bytes at all were given, but a string, a Blob or a promise. */
  'file-not-bytes': true;
  /** It ends before what it announces. */
  'file-truncated': true;
  /** It contradicts its own format. */
  'file-invalid': true;
  /** Valid, but it needs a feature or an extension that is not read here. */
  'file-unsupported': true;
  /** The network or the file system did not give it. */
  'file-unreadable': true;
  /** A baked body of a format version that this release does not know. */
  'body-version': true;
}

/** Stable names of what can be wrong with a file. */
export type FileErrorCode = keyof FileErrorCodes;

declare module '../../wasm/ts/errors.ts' {
  interface ErrorCodes extends FileErrorCodes {}
}
