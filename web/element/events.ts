import type { HandleChange } from './body-showing.ts';
import type { ElementError } from './element-base.ts';
import type { PlaceChange } from './pose-showing.ts';

/** What every element tells, by the names of its events. */
export interface ElementEvents {
  /** What was asked for is shown. */
  readonly load: CustomEvent<null>;
  /** Something went wrong, which the element says in place, too. */
  readonly error: CustomEvent<ElementError>;
}

/** What an element tells that shows a model. */
export interface ModelEvents extends ElementEvents {
  /** The part of the model that has come, or of the work on it that is done, 0 to 1; `undefined` where nobody knows. */
  readonly progress: CustomEvent<{ readonly part: number | undefined }>;
}

/** What `<handle-body>` tells. */
export interface HandleBodyEvents extends ModelEvents {
  /** A handle was moved. */
  readonly change: CustomEvent<HandleChange>;
}

/** What `<pose-space>` tells. */
export interface PoseSpaceEvents extends ModelEvents {
  /** Somebody went to a place. */
  readonly change: CustomEvent<PlaceChange>;
}

/** What `<handle-figure>` tells. */
export interface HandleFigureEvents extends ElementEvents {
  /** The figure has come to rest in another state. */
  readonly change: CustomEvent<{ readonly state: string }>;
}
