/**
 * The elements: importing "handlebody/element" defines `<handle-body>`.
 *
 * ```html
 * <script type="module" src="handlebody.standalone.js"></script>
 * <handle-body src="dog.glb" alt="A dog"></handle-body>
 * ```
 */
import { HandleBodyElement } from './handle-body.ts';

export type { HandleChange } from './body-showing.ts';
export type { ElementError } from './element-base.ts';
export { HandleBodyElement } from './handle-body.ts';
export type { AskedHandle } from './handles-text.ts';

declare global {
  interface HTMLElementTagNameMap {
    'handle-body': HandleBodyElement;
  }
}

// Another copy of this package may have come first; on a server there is nothing to define them in.
if (globalThis.customElements && !customElements.get('handle-body')) customElements.define('handle-body', HandleBodyElement);
