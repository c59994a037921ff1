/** What makes no shape of an outline or a picture. */
interface ShapeErrorCodes {
  /** Fewer than three points in a ring. */
  'outline-too-few': true;
  /** A coordinate that is not a finite number. */
  'outline-not-finite': true;
  /** Two edges that cross or touch. */
  'outline-crosses': true;
  /** Nothing lies inside. */
  'outline-no-area': true;
  /** Too many points, or gaps too narrow for them. */
  'outline-too-fine': true;
  /** No transparency that would give an outline. */
  'picture-opaque': true;
  /** Nothing but transparency. */
  'picture-empty': true;
}

declare module '../../wasm/ts/errors.ts' {
  interface ErrorCodes extends ShapeErrorCodes {}
}

// A module, so that its declarations are merged: it exports nothing.
export {};
