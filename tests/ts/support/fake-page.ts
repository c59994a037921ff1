import { FakeElement } from './fake-element.ts';

/** An element with attributes, a shadow and children, of a page where nothing is laid out and nothing comes into view. */
class Tag extends FakeElement {
  readonly #attributes = new Map<string, string>();
  readonly classList = { add: () => {}, remove: () => {}, toggle: () => {} };
  readonly adoptedStyleSheets: unknown[] = [];
  readonly isConnected = false;
  get childElementCount(): number {
    return this.children.length;
  }
  get lastElementChild(): FakeElement | undefined {
    return this.children.at(-1);
  }
  replaceChildren(...now: FakeElement[]): void {
    this.children.splice(0, this.children.length, ...now);
  }
  attachShadow(): Tag {
    return new Tag();
  }
  getAttribute(name: string): string | null {
    return this.#attributes.get(name) ?? null;
  }
  hasAttribute(name: string): boolean {
    return this.#attributes.has(name);
  }
  override setAttribute(name?: string, value?: string): void {
    this.#attributes.set(String(name), String(value));
  }
  override removeAttribute(name?: string): void {
    this.#attributes.delete(String(name));
  }
  override toggleAttribute(name?: string, on?: boolean): void {
    if (on) this.setAttribute(name, '');
    else this.removeAttribute(name);
  }
}

class Observer {
  observe(): void {}
  disconnect(): void {}
}

/** Puts as much of a page in place as the elements and the figures' plots need to be made: call it before they are imported. */
export function fakePage(): void {
  const tag = () => new Tag();
  const found = {
    HTMLElement: Tag,
    CSSStyleSheet: class {
      replaceSync(): void {}
    },
    ResizeObserver: Observer,
    MutationObserver: Observer,
    IntersectionObserver: Observer,
    devicePixelRatio: 1,
    matchMedia: () => Object.assign(new EventTarget(), { matches: false }),
    getComputedStyle: () => ({ colorScheme: 'light' }),
    document: {
      createElement: tag,
      createElementNS: tag,
      documentElement: tag(),
      body: tag(),
      baseURI: 'https://example.org/',
    },
  };
  for (const [name, value] of Object.entries(found)) if (!(name in globalThis)) Object.assign(globalThis, { [name]: value });
}
