/**
 * How handles look where a page says nothing of them: a ring that is seen on any picture, in light and in dark as the page's `color-scheme`
 * is, in forced colors and by the keyboard's focus; 36 pixels to be hit, 44 by a finger. Its rules weigh nothing (`:where`), so that any
 * selector of the page's, `.handle { … }` or `button { … }`, counts for more; and it is read from four properties:
 *
 * ```css
 * .handle {
 *   --handle-size: 2.5rem;
 *   --handle-fill: gold;
 *   --handle-ring: navy;
 *   --handle-focus: crimson;
 * }
 * ```
 *
 * Overlays adopt it as a constructed style sheet, which a strict content security policy lets through. Where one is kept out, serve the
 * text as a file of your own.
 *
 * ```ts
 * await writeFile('handles.css', HANDLE_STYLE);
 * ```
 */
export const HANDLE_STYLE = `
:where(.handle) {
  box-sizing: border-box;
  display: grid;
  place-items: center;
  width: var(--handle-size, 36px);
  height: var(--handle-size, 36px);
  min-width: 24px;
  min-height: 24px;
  margin: 0;
  padding: 0;
  border: 0;
  border-radius: 50%;
  background: none;
  color: inherit;
  font: inherit;
  cursor: grab;
  pointer-events: auto;
}
:where(.handle)::before {
  content: "";
  box-sizing: border-box;
  width: 50%;
  height: 50%;
  border: 3px solid var(--handle-ring, CanvasText);
  border-radius: 50%;
  background: var(--handle-fill, Canvas);
  box-shadow: 0 0 0 2px var(--handle-fill, Canvas);
}
:where(.handle[aria-current])::before {
  background: var(--handle-ring, CanvasText);
  border-color: var(--handle-fill, Canvas);
  box-shadow: 0 0 0 2px var(--handle-ring, CanvasText);
}
:where(.handle[data-away])::before { opacity: 0.55; }
:where(.handle[data-dragging]) { cursor: grabbing; }
:where(.handle:disabled) { cursor: default; opacity: 0.5; }
:where(.handle:focus-visible) {
  outline: 3px solid var(--handle-focus, Highlight);
  outline-offset: 0;
  box-shadow: inset 0 0 0 2px var(--handle-fill, Canvas);
}
:where(.handle[data-outside]:not(:focus)) { opacity: 0; pointer-events: none; }
:where(.handle)::after {
  content: attr(data-name);
  position: absolute;
  top: 50%;
  left: 100%;
  padding: 0 0.5em;
  translate: 0 -50%;
  border-radius: 4px;
  background: CanvasText;
  color: Canvas;
  font: 0.875rem/1.75 system-ui, sans-serif;
  white-space: nowrap;
  pointer-events: none;
  opacity: 0;
}
:where(.handle:hover, .handle:focus-visible, .handle[data-dragging])::after { opacity: 1; }
:where(.handle[data-right])::after { right: 100%; left: auto; }
@media (pointer: coarse) {
  :where(.handle) { width: var(--handle-size, 44px); height: var(--handle-size, 44px); }
}
@media (forced-colors: active) {
  :where(.handle)::before { border-color: ButtonText; background: ButtonFace; }
  :where(.handle[aria-current])::before { border-color: Highlight; background: Highlight; }
}
`;

/** One sheet a document, made by its own window: a sheet of another document is refused. */
const sheets = new WeakMap<Document, CSSStyleSheet>();

/** Gives the document or shadow root that an element is in the default style, once. False while the element is in none. */
export function adoptHandleStyle(element: HTMLElement): boolean {
  if (!element.isConnected) return false;
  const root = element.getRootNode() as Document | ShadowRoot;
  const { ownerDocument } = element;
  let sheet = sheets.get(ownerDocument);
  if (!sheet) {
    const { CSSStyleSheet } = (ownerDocument.defaultView ?? globalThis) as typeof globalThis;
    sheet = new CSSStyleSheet();
    sheet.replaceSync(HANDLE_STYLE);
    sheets.set(ownerDocument, sheet);
  }
  if (!root.adoptedStyleSheets.includes(sheet)) root.adoptedStyleSheets = [...root.adoptedStyleSheets, sheet];
  return true;
}
