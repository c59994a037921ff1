/**
 * The elements: importing "handlebody/element" defines `<handle-body>`, `<pose-space>` and `<handle-figure>`.
 *
 * ```html
 * <script type="module" src="handlebody.standalone.js"></script>
 * <handle-body src="dog.glb" alt="A dog"></handle-body>
 * ```
 */
import { HandleBodyElement } from './handle-body.ts';
import { HandleFigureElement } from './handle-figure.ts';
import { PoseSpaceElement } from './pose-space.ts';

export type { Told } from '../figures/kit/figure.ts';
export type { HandleChange } from './body-showing.ts';
export { ElementBase, type ElementError, PageElement, type Showing } from './element-base.ts';
export type { ElementEvents, HandleBodyEvents, HandleFigureEvents, ModelEvents, PoseSpaceEvents } from './events.ts';
export { HandleBodyElement } from './handle-body.ts';
export { HandleFigureElement } from './handle-figure.ts';
export type { AskedHandle } from './handles-text.ts';
export { ModelElement } from './model-element.ts';
export type { NamedPlace } from './place-text.ts';
export type { PlaceChange } from './pose-showing.ts';
export { PoseSpaceElement } from './pose-space.ts';

declare global {
  interface HTMLElementTagNameMap {
    'handle-body': HandleBodyElement;
    'handle-figure': HandleFigureElement;
    'pose-space': PoseSpaceElement;
  }
}

const ELEMENTS = { 'handle-body': HandleBodyElement, 'handle-figure': HandleFigureElement, 'pose-space': PoseSpaceElement };

// Another copy of this package may have come first; on a server there is nothing to define them in.
for (const [name, element] of Object.entries(ELEMENTS))
  if (globalThis.customElements && !customElements.get(name)) customElements.define(name, element);
