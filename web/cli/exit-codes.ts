/** How the command ends. The numbers are part of its interface: `handlebody --help` and README.md in this folder list them. */
import type { ErrorCode } from '../../wasm/ts/errors.ts';

export const EXIT = {
  ok: 0,
  /** A defect of ours, or no WebAssembly. */
  internal: 1,
  /** Arguments that cannot be meant. */
  usage: 2,
  /** An input file that cannot be read, or is not what its format asks for. */
  input: 3,
  /** Sound files whose content is refused: a mesh, a handle, a body that does not fit. */
  refused: 4,
  /** An output file that cannot be written. */
  output: 5,
  /** Ctrl-C, as shells have it: 128 and the signal's number. */
  interrupted: 130,
} as const;

const BY_CODE: Partial<Record<ErrorCode, number>> = {
  internal: EXIT.internal,
  disposed: EXIT.internal,
  'wasm-unavailable': EXIT.internal,
  'wasm-trapped': EXIT.internal,
  usage: EXIT.usage,
  'invalid-option': EXIT.usage,
  'unknown-figure': EXIT.usage,
  'body-invalid': EXIT.input,
  'body-version': EXIT.input,
  'output-unwritable': EXIT.output,
  aborted: EXIT.interrupted,
};

export function exitCodeOf(code: ErrorCode): number {
  return BY_CODE[code] ?? (code.startsWith('file-') ? EXIT.input : EXIT.refused);
}
