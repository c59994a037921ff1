/** Where the focus goes when item `i` of a list is gone: to the next one, else to the one before, else to what adds others. */
export function focusNeighbor(items: ArrayLike<HTMLElement | undefined>, i: number, adds?: HTMLElement | null): void {
  for (const element of [items[i], items[i - 1], adds]) {
    element?.focus();
    // What is hidden does not take it, and what is disabled loses it soon.
    if (element?.matches(':focus:not(:disabled)')) return;
  }
}
