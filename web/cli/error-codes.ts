/** What the command refuses besides what its files and its solver do. */
interface CommandErrorCodes {
  /** Arguments that cannot be meant. */
  usage: true;
  /** The output file cannot be written. */
  'output-unwritable': true;
  /** A model that is not baked. */
  'body-missing': true;
  /** A model without a pose space. */
  'pose-space-missing': true;
  /** No figure of that name. */
  'unknown-figure': true;
  /** HANDLES.json says something unknown, or not all that it has to. */
  'handles-invalid': true;
}

declare module '../../wasm/ts/errors.ts' {
  interface ErrorCodes extends CommandErrorCodes {}
}

// A module, so that its declarations are merged: it exports nothing.
export {};
