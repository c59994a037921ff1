/** What the command says: progress, notes and errors on standard error; one result on standard output. */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { exitCodeOf } from './exit-codes.ts';

/** A stream that takes text: standard output, or a test's. */
interface Sink {
  write(text: string): unknown;
  readonly isTTY?: boolean;
}

/** Something to know that is no error: the same shape as an error's, so that programs read both alike. */
interface Warning {
  readonly code: string;
  readonly message: string;
  readonly remedy?: string;
}

/** Between two drawings of a bar, in milliseconds. */
const FRAME = 80;
const BAR = 24;

export class Report {
  json = false;
  quiet = false;
  readonly warnings: Warning[] = [];
  #out: Sink;
  readonly #err: Sink;
  #bar = false;
  #drawn = 0;
  #tenths = -1;

  constructor(out: Sink = process.stdout, err: Sink = process.stderr) {
    this.#out = out;
    this.#err = err;
  }

  /** Standard output is for a model: what is said goes to standard error. */
  leaveStandardOutput(): void {
    this.#out = this.#err;
  }

  /** Progress of a piece of work: a bar on a terminal, a line every tenth elsewhere. */
  progress(what: string): (part: number) => void {
    this.#tenths = -1;
    return (part) => {
      if (this.quiet) return;
      const percent = `${Math.floor(part * 100)}`.padStart(3);
      if (this.#err.isTTY) {
        const now = performance.now();
        if (part < 1 && now - this.#drawn < FRAME) return;
        this.#drawn = now;
        const filled = Math.round(part * BAR);
        this.#err.write(`\r${what} [${'#'.repeat(filled)}${'.'.repeat(BAR - filled)}] ${percent}%${part >= 1 ? '\n' : ''}`);
        this.#bar = part < 1;
      } else if (Math.floor(part * 10) > this.#tenths) {
        this.#tenths = Math.floor(part * 10);
        this.#line(`${what} ${percent}%`);
      }
    };
  }

  note(text: string): void {
    if (!this.quiet) this.#line(text);
  }

  warn(warning: Warning): void {
    this.warnings.push(warning);
    if (!this.quiet) this.#line(`warning: ${sentences(warning)}`);
  }

  /** The result: as one JSON object, or as lines for people. */
  result(json: object, lines: readonly string[]): void {
    if (this.json) this.#out.write(`${JSON.stringify({ ...json, warnings: this.warnings }, null, 2)}\n`);
    else if (!this.quiet) for (const line of lines) this.#out.write(`${printable(line)}\n`);
  }

  /** Says what went wrong, and returns how the command is to end. */
  error(error: unknown): number {
    const known = error instanceof HandlebodyError ? error : defect(error);
    const { code, message, remedy, culprit } = known;
    if (this.json) this.#out.write(`${JSON.stringify({ error: { code, message, remedy, culprit } }, null, 2)}\n`);
    else
      this.#line(
        `error: ${message}\n  ${remedy}\n  (${code}${culprit && culprit.index >= 0 ? `, ${culprit.kind} ${culprit.index}` : ''})`,
      );
    if (code === 'internal' && error instanceof Error && process.env.HANDLEBODY_DEBUG) this.#line(error.stack ?? '');
    return exitCodeOf(code);
  }

  #line(text: string): void {
    if (this.#bar) this.#err.write('\n');
    this.#bar = false;
    this.#err.write(`${printable(text)}\n`);
  }
}

/** A message with its remedy behind it. */
function sentences({ message, remedy }: { readonly message: string; readonly remedy?: string }): string {
  return remedy ? `${message} ${remedy}` : message;
}

/** Names come from files: what would steer a terminal, or turn its text round, is not written to one. */
function printable(text: string): string {
  return text.replace(/[^\n\x20-\x7e\u00a0-\u{10ffff}]|[\u202a-\u202e\u2066-\u2069]/gu, '\ufffd');
}

function defect(error: unknown): HandlebodyError {
  return new HandlebodyError('internal', {
    message: `The command failed: ${error instanceof Error ? error.message : String(error)}`,
    remedy: 'This is a defect: please report it, with the file if you can. HANDLEBODY_DEBUG=1 shows where.',
    cause: error,
  });
}
