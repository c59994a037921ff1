import { flag, optional, options as readOptions } from '../../wasm/ts/arguments.ts';
import { adoptHandleStyle } from './handle-style.ts';
import { BareHandles, type BareHandlesOptions, HANDLES_READERS } from './handles.ts';

export interface HandleOverlayOptions extends BareHandlesOptions {
  /** The page styles the handles by itself, from nothing. */
  readonly unstyled?: boolean;
}

/**
 * Handles over a three.js canvas, as `BareHandles` has them, with a style that any rule of the page's overrides: see `HANDLE_STYLE`.
 *
 * Its places are the world's, a solver's targets the object's own: `draggable` does all of this for a baked body.
 *
 * ```ts
 * const handles = new HandleOverlay({
 *   camera,
 *   container,
 *   onMove: (i, place) => object.worldToLocal(place.clone()).toArray(irbf.targets, i * 10),
 * });
 * handles.set([{ name: 'Nose', position: object.localToWorld(new Vector3(0, 1, 2)).toArray() }]);
 * handles.update(); // after each render
 * ```
 */
export class HandleOverlay extends BareHandles {
  readonly #container: HTMLElement;
  #styled: boolean;

  constructor(options: HandleOverlayOptions) {
    const read = readOptions(options, { ...HANDLES_READERS, unstyled: optional(flag) }) as HandleOverlayOptions;
    super(read);
    [this.#container, this.#styled] = [read.container, read.unstyled ?? false];
  }

  override update(): void {
    // Once it is in a document, which it may not be when it is made.
    if (!this.#styled) this.#styled = adoptHandleStyle(this.#container);
    super.update();
  }
}
