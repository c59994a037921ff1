/** How pages go on when their solver has ended, as one does whose memory ran out in the middle of its work. */
import { PageError } from './page-error.ts';

/** A page's solver: loaded when it is first asked for, and anew where it did not come or has ended. */
export function renewed<T extends { readonly usable: boolean }>(load: () => Promise<T>): () => Promise<T> {
  let coming: Promise<T> | undefined;
  let made: T | undefined;
  return () => {
    if (made?.usable === false) [coming, made] = [undefined, undefined];
    coming ??= load();
    coming.then(
      (hb) => {
        made = hb;
      },
      () => {
        coming = undefined;
      },
    );
    return coming;
  };
}

/** Whether the solver has ended by this, and what it made with it. */
export function isEnd(error: unknown): boolean {
  return (error as { code?: unknown } | undefined)?.code === 'wasm-trapped';
}

/**
 * Tells what went wrong. Where the solver has ended by it, what it made stays as it is seen, and `restore` is offered: it is to make that
 * again from its state, by another solver. What `restore` throws is told likewise.
 */
export function tellOf(
  error: unknown,
  tell: (error: unknown, again?: () => void) => void,
  restore: () => void | Promise<void>,
): void {
  if (!isEnd(error)) {
    tell(error);
    return;
  }
  const again = async () => {
    try {
      await restore();
    } catch (next) {
      tellOf(next, tell, restore);
    }
  };
  tell(stopped(), () => void again());
}

function stopped(): PageError {
  const remedy = 'Try again: what is shown is brought back with a fresh solver. If it happens again, please report it.';
  return new PageError('wasm-trapped', 'The solver stopped unexpectedly, perhaps for want of memory.', remedy);
}
