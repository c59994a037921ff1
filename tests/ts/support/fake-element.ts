/** As much of an element as handles need: 100 × 100 pixels, at the page's corner. */
export class FakeElement extends EventTarget {
  readonly style: Record<string, string> = {};
  readonly dataset: Record<string, string> = {};
  readonly children: FakeElement[] = [];
  readonly clientWidth = 100;
  readonly clientHeight = 100;
  id = '';
  textContent = '';
  hidden = false;
  append(...added: FakeElement[]): void {
    this.children.push(...added);
  }
  remove(): void {}
  matches(): boolean {
    return false;
  }
  setAttribute(): void {}
  removeAttribute(): void {}
  toggleAttribute(): void {}
  getBoundingClientRect() {
    return { left: 0, top: 0, width: 100, height: 100 };
  }
}

/** Puts a document in place that makes such elements; gives what takes it away. */
export function fakeDocument(): () => void {
  const before = globalThis.document;
  Object.assign(globalThis, { document: { createElement: () => new FakeElement() } });
  return () => Object.assign(globalThis, { document: before });
}
