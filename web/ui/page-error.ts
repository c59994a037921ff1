/** Troubles of the page itself, told like the library's: a sentence and a remedy. */
export class PageError extends Error {
  override readonly name = 'PageError';
  readonly code: string;
  readonly remedy: string;

  constructor(code: string, message: string, remedy: string) {
    super(message);
    this.code = code;
    this.remedy = remedy;
  }
}
