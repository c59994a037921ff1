/** Small helpers for elements. */

type Child = Node | string;
type Attributes = Record<string, string | number | boolean | ((event: Event) => void)>;

/** An element with attributes (functions become listeners: `onclick`) and children. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  apply(element, attributes);
  element.append(...children);
  return element;
}

/** A button that does something; `kind`: its classes. */
export function button(words: string, act: () => void, kind = 'button small', attributes: Attributes = {}): HTMLButtonElement {
  return h('button', { type: 'button', class: kind, ...attributes, onclick: act }, words);
}

/** `h`, for SVG. */
export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  apply(element, attributes);
  element.append(...children);
  return element;
}

/** Makes a list hold as many elements as wanted, keeping those it has. */
export function match(list: Element, count: number, make: (i: number) => Element): void {
  while (list.childElementCount > count) list.lastElementChild?.remove();
  while (list.childElementCount < count) list.append(make(list.childElementCount));
}

/** Says a text, where it is another one than before: what has not changed is not touched. */
export function write(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** The element of the page with this id, which the page's own HTML promises. */
export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
  const element = document.getElementById(id);
  if (!element) throw new Error(`the page has no #${id}`);
  return element as T;
}

function apply(element: Element, attributes: Attributes): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(name.replace(/^on/, ''), value);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false) element.setAttribute(name, String(value));
  }
}

/** A number as people read it: a true minus sign, a fixed number of digits (a power of ten where those are too many), no minus zero. */
export function readable(value: number, digits = 2): string {
  const power = value === 0 ? 0 : Math.floor(Math.log10(Math.abs(value)));
  if (Math.max(power, 0) + digits > 12) return shortest(value, Math.min(Math.max(power + digits, 0), 4));
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace('-', '') : text.replace('-', '−');
}

/** 1.5e300 */
function shortest(value: number, digits: number): string {
  const text = value.toExponential(digits).replace(/\.?0*e\+?/, 'e');
  return text === '0e0' ? '0' : text.replaceAll('-', '−');
}
