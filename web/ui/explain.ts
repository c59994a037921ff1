interface Told {
  readonly message: string;
  readonly remedy: string;
  readonly detail?: string;
}

/** Any error as a sentence and a remedy. The library's own errors bring both. */
export function explain(error: unknown): Told {
  if (!(error instanceof Error))
    return { message: `Something went wrong: ${String(error)}.`, remedy: 'Reload the page and try again.' };
  const { code, remedy, culprit } = error as Partial<{ code: string; remedy: string; culprit: { kind: string; index: number } }> &
    Error;
  if (typeof remedy !== 'string') {
    return { message: `Something went wrong: ${error.message}`, remedy: 'Reload the page; if it happens again, please report it.' };
  }
  const where = culprit ? `, ${culprit.kind} ${culprit.index}` : '';
  return { message: error.message, remedy, detail: `${code}${where}` };
}
