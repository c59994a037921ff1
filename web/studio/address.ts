import { writeAddress } from '../ui/address.ts';

/** What can be shown of a body's inside. */
export const PARTS = ['spheres', 'centers', 'skeleton'] as const;
export type Part = (typeof PARTS)[number];

/** What the page's address remembers: "#spot&inside=spheres,skeleton". */
export class Address {
  /** One of the studio's models; empty for any other. */
  model = '';
  /** Of whatever model is a body. */
  readonly inside = new Set<Part>();

  constructor() {
    this.read();
  }

  read(): void {
    const said = location.hash.slice(1).split('&');
    this.model = said.find((part) => !part.includes('=')) ?? '';
    const named = said.find((part) => part.startsWith('inside='))?.slice('inside='.length) ?? '';
    this.inside.clear();
    for (const part of PARTS) if (named.split(/,|%2C/i).includes(part)) this.inside.add(part);
  }

  write(): void {
    const inside = PARTS.filter((part) => this.inside.has(part));
    const text = [...(this.model ? [this.model] : []), ...(inside.length > 0 ? [`inside=${inside}`] : [])].join('&');
    if (text) writeAddress(text);
    else if (location.hash) history.replaceState(null, '', location.pathname + location.search);
  }
}
